// The surface correction of candidates that are spread over the ranks.

#ifndef morph_exactSurface_hpp
#define morph_exactSurface_hpp

#include "communicator.hpp"
#include "controlPoints.hpp"
#include "surfaceCorrection.hpp"

#include <memory>

namespace morph
{

// Lets a displacement field that meets the conditions of control points but for
// some residuals meet them exactly (surfaceCorrection.hpp). Every rank gets the
// positions and residuals of all control points: 48 B for each.
class ExactSurface
{
public:

    // Largest radius of the hierarchy [m]
    explicit ExactSurface(double radius) : radius_(radius) {}

    // residuals: C (g - C^T s) at the control points of this rank: n x 3 [m].
    // Adds to the displacements at points what is missing: m x 3 [m] each.
    // Called again, the control points must be the same. Collective.
    void add
    (
        const ControlPoints& controlPoints,
        const Vectors& residuals,
        Communicator& communicator,
        const Vectors& points,
        Vectors& displacements
    );

private:

    double radius_;
    std::unique_ptr<SurfaceCorrection> correction_;
};

} // namespace morph

#endif
