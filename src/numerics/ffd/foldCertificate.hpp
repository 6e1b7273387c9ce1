// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Does the map of a control lattice fold, and up to which scale does it not?

#ifndef morph_foldCertificate_hpp
#define morph_foldCertificate_hpp

#include "ffdFrame.hpp"
#include "ffdLattice.hpp"
#include "tensorPolynomial.hpp"

#include <vector>

namespace morph
{

// The map is xi -> X(xi) + t d(xi), with X the box and d the displacement of
// the lattice, both in coordinates of the frame. Its Jacobian determinant is,
// in each knot span, a Bernstein polynomial in xi and of third degree in the
// scale t. Positive coefficients certify that it is positive; where they do not
// decide, the span is halved. With weights the map is X + t N/W, and W^4 times
// its determinant is that of the matrix of four rows [W, grad W] and [t N_i, W
// grad X_i + t grad N_i]. In cylindrical boxes the radius must remain positive
// as well.
class FoldCertificate
{
public:
    // control: displacements of the control points in coordinates of the frame.
    // Keeps references to frame and lattice
    FoldCertificate(
        const FfdFrame& frame, const FfdLattice& lattice,
        const Vectors& control);

    // Is the determinant positive everywhere at this scale? If not, where() is
    // a place at which it is not (or, within round-off of zero, not certainly)
    bool valid(double scale = 1);

    // The largest t <= 1 up to which every scale is valid, found to within the
    // tolerance from below
    double safeScale(double tolerance = 1e-4);

    // Box coordinates at which the last question was decided
    const Vector3& where() const { return where_; }

private:
    // A polynomial of third degree in t, by its Bernstein coefficients in t
    // on [0,1], on part of the box
    struct Piece
    {
        std::array<TensorPolynomial, 4> inScale;
        Vector3 low;
        Vector3 high;

        // Below this t it is positive
        double safe;
    };

    // Part of the box between knots
    struct Span
    {
        Vector3 low;
        Vector3 high;

        // The box and the control points times weight, in Bernstein form
        std::array<TensorPolynomial, 3> rest;
        std::array<TensorPolynomial, 3> moved;
        TensorPolynomial weight;
        bool moves;
    };

    // All spans in which something moves
    std::vector<Span> spans() const;

    Span span(const std::array<Index, 3>& number) const;

    // A component of vectors of the control points in a span, times weight; 3
    // is weight
    TensorPolynomial inSpan(
        const Vectors& control, const std::array<Index, 3>& number,
        int component) const;

    TensorPolynomial expanded(const Span& span, double scale) const;

    TensorPolynomial determinant(const Span& span, double scale) const;

    TensorPolynomial radius(const Span& span, double scale) const;

    // Is it positive everywhere between the two corners?
    bool positive(
        const TensorPolynomial& polynomial, const Vector3& low,
        const Vector3& high);

    std::vector<Piece> pieces() const;

    const FfdFrame& frame_;

    const FfdLattice& lattice_;

    const Vectors control_;

    Vector3 where_;
};

} // namespace morph

#endif
