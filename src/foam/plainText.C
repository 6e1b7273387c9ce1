/*---------------------------------------------------------------------------*\
SPDX-FileCopyrightText: 2026 The morphFoam authors
SPDX-License-Identifier: GPL-3.0-or-later
\*---------------------------------------------------------------------------*/

#include "plainText.H"

#include <cmath>
#include <cstdio>

// * * * * * * * * * * * * * * * Global Functions  * * * * * * * * * * * * * //

Foam::string Foam::plainText::rounded(const scalar x, const int digits)
{
    const scalar size = std::abs(x);
    char text[64];
    if (size >= std::pow(10.0, digits) && size < 1e6)
    {
        std::snprintf(text, sizeof(text), "%.0f", x);
    }
    else
    {
        std::snprintf(text, sizeof(text), "%.*g", digits, x);
    }
    return text;
}


Foam::string Foam::plainText::counted
(
    const label n,
    const char* thing,
    const char* things
)
{
    const string many(things ? string(things) : string(thing) + 's');
    return std::to_string(n) + ' ' + (n == 1 ? string(thing) : many);
}


// ************************************************************************* //
