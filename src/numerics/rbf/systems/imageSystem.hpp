// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The system of control points together with their images.

#ifndef morph_imageSystem_hpp
#define morph_imageSystem_hpp

#include "controlSystem.hpp"
#include "blockTriangularFactor.hpp"
#include "imageGroup.hpp"

namespace morph
{

// The system of imageGroup.hpp, of which the Cholesky factor grows by the
// degrees of freedom of the points that are appended: with rotated images the
// kernel is a 3 x 3 matrix, and the directions of a point do not separate as
// they do in GramFactor. Points have to be restricted to what the group allows
// (ImageGroup::restricted).
class ImageSystem : public ControlSystem
{
public:
    ImageSystem(const Kernel& kernel, const ImageGroup& images);

    Choice choose(
        const std::vector<Candidate>& list, Index most, double least,
        double outside) override;

    std::vector<bool> append(
        const std::vector<Candidate>& list,
        const std::vector<Index>& chosen) override;

    void setValues(const std::vector<Vector3>& values) override;

    // The interpolant gets the images as further centres
    void solve(RbfInterpolant& interpolant) override;

private:
    // G of the conditions of a with those of b
    Matrix block(const ControlPoints& a, const ControlPoints& b) const;

    // What is left for a list once the points there are are eliminated;
    // returns the scales of its points' pivots
    std::vector<double> eliminateFrom(const ControlPoints& points);

    Kernel kernel_;
    ImageGroup images_;

    ControlPoints points_;
    BlockTriangularFactor L_;

    // Of the list last chosen from, until something of it is appended: first rows of its points, and the end;
    // L^-1 G_SK, and what is left of G_KK
    std::vector<Index> first_;
    Matrix Y_;
    Matrix W_;
};

} // namespace morph

#endif
