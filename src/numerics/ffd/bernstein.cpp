// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "bernstein.hpp"

#include <algorithm>

namespace morph
{

void bernsteinRow(Index n, double s, double* row)
{
    row[0] = 1;
    for (Index degree = 1; degree <= n; ++degree)
    {
        double carried = 0;
        for (Index i = 0; i < degree; ++i)
        {
            const double former = row[i];
            row[i] = carried + (1 - s) * former;
            carried = s * former;
        }
        row[degree] = carried;
    }
}


double binomial(Index n, Index i)
{
    double value = 1;
    for (Index k = 1; k <= std::min(i, n - i); ++k)
    {
        value = value * double(n - k + 1) / double(k);
    }
    return value;
}

} // namespace morph
