// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The surface correction of candidates that are spread over the ranks.

#ifndef morph_exactSurface_hpp
#define morph_exactSurface_hpp

#include "communicator.hpp"
#include "controlPoints.hpp"
#include "imageGroup.hpp"
#include "surfaceCorrection.hpp"

#include <memory>

namespace morph
{

// Makes a displacement field meet the conditions of all control points exactly,
// given their residuals (surfaceCorrection.hpp). Every rank receives the
// positions of all control points once, and their residuals each time: 24 B
// each. Which points reach which is computed once.
class ExactSurface
{
public:
    // radius: the largest of the hierarchy [m]; images: those that the field
    // has, and with it the correction, with a reach of at least 3 radii
    explicit ExactSurface(
        double radius, const ImageGroup& images = ImageGroup())
    : radius_(radius),
      images_(images)
    {
    }

    // residuals: C (g - C^T s) at the control points of this rank: n x 3 [m].
    // Adds to the displacements at points what is missing: m x 3 [m] each.
    // Called again, the control points and the points must be the same.
    // Collective.
    void
    add(const ControlPoints& controlPoints, const Vectors& residuals,
        Communicator& communicator, const Vectors& points,
        Vectors& displacements);

private:
    void start(
        const ControlPoints& controlPoints, Communicator& communicator,
        const Vectors& points);

    // Images of the centres, appended to them; of each centre its family
    std::vector<Index> addImages(Columns& centres);

    double radius_;
    ImageGroup images_;
    std::unique_ptr<SurfaceCorrection> correction_;
    SurfaceCorrection::Reach reach_;

    // Of the control points of all ranks, as they are gathered, which centre
    // they are: several may be at one place
    std::vector<Index> centre_;
    Index nCentres_ = 0;

    // Those beyond them, by the centre and the map
    std::vector<ImageGroup::Replica> replicas_;
};

} // namespace morph

#endif
