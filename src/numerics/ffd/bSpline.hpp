// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// B-splines of one variable on [0,1]: clamped or periodic, uniform knots, any
// degree.

#ifndef morph_bSpline_hpp
#define morph_bSpline_hpp

#include "arrays.hpp"

#include <vector>

namespace morph
{

// The basis functions N_i of n control points. Clamped: the first and the last
// knot have multiplicity degree + 1, and the others divide [0,1] evenly; with
// degree n - 1 these are the Bernstein polynomials. Periodic: all knots are
// simple, N_i has its middle at i/n (degree odd; half a knot further otherwise)
// and control point n is control point 0.
class BSpline
{
public:
    enum class Ends
    {
        clamped,
        periodic
    };

    // Bernstein polynomials of this degree
    static BSpline bernstein(Index degree);

    // Throws std::invalid_argument unless 0 <= degree < nPoints
    BSpline(Index nPoints, Index degree, Ends ends = Ends::clamped);

    Index size() const { return size_; }

    Index degree() const { return degree_; }

    bool periodic() const { return periodic_; }

    // Number of knot spans of positive length
    Index spans() const { return spans_; }

    // Where a span begins; spanStart(spans()) is 1
    double spanStart(Index span) const;

    // The span that contains s; s is clamped to [0,1] or wrapped into it
    Index spanOf(double s) const;

    // Values of the degree + 1 functions that are not zero at s (clamped or
    // wrapped), and their derivatives if requested. Returns the extended number
    // of the first one: see control()
    Index values(double s, double* row, double* derivatives = nullptr) const;

    // Number of functions in extended numbering, in which those of a periodic
    // basis that cross the seam are counted again
    Index extendedSize() const;

    // The control point of a function in extended numbering
    Index control(Index extended) const;

    // First function, in extended numbering, that is not zero in a span
    Index firstOf(Index span) const { return span; }

    // Row i: N_(first + i) in the Bernstein basis of the span (Bezier
    // extraction), degree + 1 squared
    Matrix extraction(Index span) const;

private:
    double knot(Index i) const { return knots_[std::size_t(i)]; }

    void coxDeBoor(Index span, double s, Index degree, double* row) const;

    Index size_;

    Index degree_;

    bool periodic_;

    Index spans_;

    // Those of the functions in extended numbering
    std::vector<double> knots_;
};

} // namespace morph

#endif
