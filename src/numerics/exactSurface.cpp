#include "exactSurface.hpp"

#include <algorithm>
#include <array>

namespace morph
{

namespace
{

// Position and residual
using Row = std::array<double, 6>;

} // namespace


void ExactSurface::add
(
    const ControlPoints& controlPoints,
    const Vectors& residuals,
    Communicator& communicator,
    const Vectors& points,
    Vectors& displacements
)
{
    std::vector<double> mine;
    for (std::size_t i = 0; i < controlPoints.size(); ++i)
    {
        const Vector3& x = controlPoints[i].position;
        const Vector3 r = residuals.row(i).transpose();
        mine.insert(mine.end(), x.data(), x.data() + 3);
        mine.insert(mine.end(), r.data(), r.data() + 3);
    }
    const std::vector<double> all = communicator.gather(mine);

    // One order, and one of several at a place, whichever rank they are from
    std::vector<Row> rows(all.size()/6);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        std::copy_n(&all[6*i], 6, rows[i].begin());
    }
    std::sort(rows.begin(), rows.end());
    const auto last = std::unique
    (
        rows.begin(),
        rows.end(),
        [](const Row& a, const Row& b)
        {
            return std::equal(a.begin(), a.begin() + 3, b.begin());
        }
    );
    rows.erase(last, rows.end());

    Columns centres(rows.size(), 3);
    Vectors open(rows.size(), 3);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        centres.row(i) << rows[i][0], rows[i][1], rows[i][2];
        open.row(i) << rows[i][3], rows[i][4], rows[i][5];
    }
    if (!correction_)
    {
        correction_.reset(new SurfaceCorrection(centres, radius_));
    }
    correction_->set(open);
    correction_->add(points, displacements);
}

} // namespace morph
