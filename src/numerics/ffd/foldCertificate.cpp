// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "foldCertificate.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace morph
{

namespace
{

// Halvings after which the answer is no
const int mostHalvings = 4000;

// And the operations that they may take altogether
const double mostOperations = 1e10;


// Of a polynomial of high degree fewer, each of which is dear
int mostHalvingsOf(const TensorPolynomial& polynomial)
{
    double cost = 1;
    double degree = 1;
    for (const Index n : polynomial.degrees())
    {
        cost *= double(n + 1);
        degree = std::max(degree, double(n));
    }
    return int(std::min(
        std::max(mostOperations / (cost * degree), 20.0),
        double(mostHalvings)));
}


// Relative to the determinant at rest: below this it is zero
const double roundOff = 1e-12;

const double never = std::numeric_limits<double>::infinity();


// The first t in [from, to] at which a cubic may be no longer positive, from
// below; c: its Bernstein coefficients there
double firstRoot(const std::array<double, 4>& c, double from, double to)
{
    if (*std::min_element(c.begin(), c.end()) > 0)
    {
        return never;
    }
    if (c[0] <= 0 || to - from < 1e-9)
    {
        return from;
    }
    const double ab = 0.5 * (c[0] + c[1]);
    const double bc = 0.5 * (c[1] + c[2]);
    const double cd = 0.5 * (c[2] + c[3]);
    const double abc = 0.5 * (ab + bc);
    const double bcd = 0.5 * (bc + cd);
    const double middle = 0.5 * (abc + bcd);
    const double half = 0.5 * (from + to);
    const double first = firstRoot({{c[0], ab, abc, middle}}, from, half);
    return first < never ? first
                         : firstRoot({{middle, bcd, cd, c[3]}}, half, to);
}


// Bernstein coefficients in t of the cubic with these values at 0, 1/3, 2/3, 1
std::array<TensorPolynomial, 4> cubic(std::array<TensorPolynomial, 4> f)
{
    TensorPolynomial::Degrees degrees{{0, 0, 0}};
    for (const TensorPolynomial& value : f)
    {
        for (std::size_t d = 0; d < 3; ++d)
        {
            degrees[d] = std::max(degrees[d], value.degrees()[d]);
        }
    }
    for (TensorPolynomial& value : f)
    {
        value = value.elevated(degrees);
    }
    const TensorPolynomial c1 =
        (-5.0 / 6) * f[0] + 3.0 * f[1] + (-1.5) * f[2] + (1.0 / 3) * f[3];
    const TensorPolynomial c2 =
        (1.0 / 3) * f[0] + (-1.5) * f[1] + 3.0 * f[2] + (-5.0 / 6) * f[3];
    return {{f[0], c1, c2, f[3]}};
}


// The direction in which halving helps most
int steepest(const TensorPolynomial& polynomial)
{
    int direction = 0;
    for (int d = 1; d < 3; ++d)
    {
        if (polynomial.variation(d) > polynomial.variation(direction))
        {
            direction = d;
        }
    }
    return direction;
}


Vector3 cornerOf(int number, const Vector3& low, const Vector3& high)
{
    Vector3 x;
    for (int d = 0; d < 3; ++d)
    {
        x[d] = number & (1 << d) ? high[d] : low[d];
    }
    return x;
}


using Columns3 = std::array<std::array<TensorPolynomial, 3>, 3>;

TensorPolynomial determinantOf(const Columns3& m)
{
    const auto minor = [&](int i, int j)
    {
        return m[1][std::size_t(i)] * m[2][std::size_t(j)]
            + (-1.0) * (m[1][std::size_t(j)] * m[2][std::size_t(i)]);
    };
    return m[0][0] * minor(1, 2) + m[0][1] * minor(2, 0)
        + m[0][2] * minor(0, 1);
}

} // namespace


FoldCertificate::FoldCertificate(
    const FfdFrame& frame, const FfdLattice& lattice, const Vectors& control)
: frame_(frame),
  lattice_(lattice),
  control_(control),
  where_(Vector3::Constant(0.5))
{
}


TensorPolynomial FoldCertificate::inSpan(
    const Vectors& control, const std::array<Index, 3>& number,
    int component) const
{
    TensorPolynomial::Degrees n;
    std::array<Matrix, 3> extraction;
    for (std::size_t d = 0; d < 3; ++d)
    {
        const BSpline& basis = lattice_.basis(int(d));
        n[d] = basis.degree();
        extraction[d] = basis.extraction(number[d]);
    }

    // The control points that reach here, one matrix (s,t) for each of p
    std::vector<Matrix> planes;
    for (Index k = 0; k <= n[2]; ++k)
    {
        Matrix plane(n[0] + 1, n[1] + 1);
        for (Index j = 0; j <= n[1]; ++j)
        {
            for (Index i = 0; i <= n[0]; ++i)
            {
                const Index from = lattice_.number(
                    lattice_.basis(0).control(number[0] + i),
                    lattice_.basis(1).control(number[1] + j),
                    lattice_.basis(2).control(number[2] + k));
                const double weight = lattice_.rational()
                    ? lattice_.weights()[std::size_t(from)]
                    : 1;
                plane(i, j) =
                    component == 3 ? weight : weight * control(from, component);
            }
        }
        planes.push_back(extraction[0].transpose() * plane * extraction[1]);
    }

    std::vector<double> coefficients;
    for (Index k = 0; k <= n[2]; ++k)
    {
        Matrix plane = Matrix::Zero(n[0] + 1, n[1] + 1);
        for (Index j = 0; j <= n[2]; ++j)
        {
            plane += extraction[2](j, k) * planes[std::size_t(j)];
        }
        coefficients.insert(
            coefficients.end(), plane.data(), plane.data() + plane.size());
    }
    return TensorPolynomial(n, coefficients);
}


FoldCertificate::Span
FoldCertificate::span(const std::array<Index, 3>& number) const
{
    Span span;
    for (int d = 0; d < 3; ++d)
    {
        const Index i = number[std::size_t(d)];
        span.low[d] = lattice_.basis(d).spanStart(i);
        span.high[d] = lattice_.basis(d).spanStart(i + 1);
    }

    std::array<std::vector<double>, 3> corners;
    for (int corner = 0; corner < 8; ++corner)
    {
        const Vector3 x =
            frame_.frameCoordinates(cornerOf(corner, span.low, span.high));
        for (int c = 0; c < 3; ++c)
        {
            corners[std::size_t(c)].push_back(x[c]);
        }
    }
    span.moves = false;
    for (int c = 0; c < 3; ++c)
    {
        const std::size_t i = std::size_t(c);
        span.rest[i] = frame_.controlPoints()
            ? inSpan(*frame_.controlPoints(), number, c)
            : TensorPolynomial({{1, 1, 1}}, corners[i]);
        span.moved[i] = inSpan(control_, number, c);
        span.moves = span.moves || !span.moved[i].isZero();
    }
    span.weight =
        lattice_.rational() ? inSpan(control_, number, 3) : TensorPolynomial(1);
    return span;
}


std::vector<FoldCertificate::Span> FoldCertificate::spans() const
{
    std::vector<Span> spans;
    for (Index k = 0; k < lattice_.basis(2).spans(); ++k)
    {
        for (Index j = 0; j < lattice_.basis(1).spans(); ++j)
        {
            for (Index i = 0; i < lattice_.basis(0).spans(); ++i)
            {
                const Span one = span({{i, j, k}});
                if (one.moves)
                {
                    spans.push_back(one);
                }
            }
        }
    }
    return spans;
}


TensorPolynomial FoldCertificate::expanded(const Span& span, double scale) const
{
    // The determinant is linear in each row: those of the box at rest are of low
    // degree, and those of the motion have few coefficients
    TensorPolynomial sum(0);
    for (std::size_t which = 0; which < 8; ++which)
    {
        Columns3 m;
        bool zero = false;
        for (std::size_t i = 0; i < 3; ++i)
        {
            const bool moves = which & (std::size_t(1) << i);
            zero = zero || (moves && (scale == 0 || span.moved[i].isZero()));
            for (int d = 0; d < 3; ++d)
            {
                m[i][std::size_t(d)] = moves
                    ? scale * span.moved[i].derivative(d)
                    : span.rest[i].derivative(d);
            }
        }
        if (!zero)
        {
            sum += determinantOf(m);
        }
    }
    return sum;
}


TensorPolynomial
FoldCertificate::determinant(const Span& span, double scale) const
{
    if (!lattice_.rational())
    {
        return expanded(span, scale);
    }

    // Rows: components; columns: directions
    Columns3 m;
    for (std::size_t i = 0; i < 3; ++i)
    {
        for (int d = 0; d < 3; ++d)
        {
            m[i][std::size_t(d)] = span.weight * span.rest[i].derivative(d)
                + scale * span.moved[i].derivative(d);
        }
    }
    // Expanded by the column [W, t N]
    TensorPolynomial sum = span.weight * determinantOf(m);
    for (std::size_t i = 0; i < 3; ++i)
    {
        Columns3 replaced = m;
        for (int d = 0; d < 3; ++d)
        {
            replaced[i][std::size_t(d)] = span.weight.derivative(d);
        }
        sum += (-scale) * (span.moved[i] * determinantOf(replaced));
    }
    return sum;
}


TensorPolynomial FoldCertificate::radius(const Span& span, double scale) const
{
    const TensorPolynomial r =
        span.weight * span.rest[0] + scale * span.moved[0];
    if (frame_.frameCoordinates(span.low)[0] > 0)
    {
        return r;
    }

    // At the axis it is zero: what counts is the radius divided by s
    TensorPolynomial::Degrees n = r.degrees();
    std::vector<double> coefficients;
    for (std::size_t i = 0; i < r.coefficients().size(); ++i)
    {
        const Index along = Index(i) % (n[0] + 1);
        if (along > 0)
        {
            coefficients.push_back(
                r.coefficients()[i] * double(n[0]) / double(along));
        }
    }
    n[0] -= 1;
    return TensorPolynomial(n, coefficients);
}


bool FoldCertificate::positive(
    const TensorPolynomial& polynomial, const Vector3& low, const Vector3& high)
{
    struct Part
    {
        TensorPolynomial polynomial;
        Vector3 low;
        Vector3 high;
    };

    const double zero = roundOff * std::max(polynomial.largest(), 0.0);
    std::vector<Part> open(1, Part{polynomial, low, high});
    const int most = mostHalvingsOf(polynomial);
    int halvings = 0;
    while (!open.empty())
    {
        const Part part = open.back();
        open.pop_back();
        if (part.polynomial.smallest() > zero)
        {
            continue;
        }
        for (int corner = 0; corner < 8; ++corner)
        {
            if (!(part.polynomial.corner(corner) > zero))
            {
                where_ = cornerOf(corner, part.low, part.high);
                return false;
            }
        }
        const int d = steepest(part.polynomial);
        const double middle = 0.5 * (part.low[d] + part.high[d]);
        if (++halvings > most)
        {
            where_ = 0.5 * (part.low + part.high);
            return false;
        }
        auto halves = part.polynomial.halves(d);
        Part lower{std::move(halves.first), part.low, part.high};
        Part upper{std::move(halves.second), part.low, part.high};
        lower.high[d] = middle;
        upper.low[d] = middle;
        open.push_back(std::move(upper));
        open.push_back(std::move(lower));
    }
    return true;
}


bool FoldCertificate::valid(double scale)
{
    for (const Span& span : spans())
    {
        if (!positive(determinant(span, scale), span.low, span.high)
            || (frame_.radial()
                && !positive(radius(span, scale), span.low, span.high)))
        {
            return false;
        }
    }
    return true;
}


std::vector<FoldCertificate::Piece> FoldCertificate::pieces() const
{
    std::vector<Piece> pieces;
    for (const Span& span : spans())
    {
        Piece piece;
        piece.low = span.low;
        piece.high = span.high;
        piece.safe = 0;
        for (std::size_t i = 0; i < 4; ++i)
        {
            piece.inScale[i] = determinant(span, double(i) / 3);
        }
        piece.inScale = cubic(piece.inScale);
        pieces.push_back(piece);
        if (frame_.radial())
        {
            for (std::size_t i = 0; i < 4; ++i)
            {
                piece.inScale[i] = radius(span, double(i) / 3);
            }
            piece.inScale = cubic(piece.inScale);
            pieces.push_back(piece);
        }
    }
    return pieces;
}


// Branch and bound. Each coefficient in xi is a cubic in t, and until the first
// root of any of them the determinant is positive: a bound from below. That at a
// corner is the determinant itself: its root is a bound from above
double FoldCertificate::safeScale(double tolerance)
{
    const auto later = [](const Piece& a, const Piece& b)
    { return a.safe > b.safe; };
    std::priority_queue<Piece, std::vector<Piece>, decltype(later)> open(later);
    double reached = never;

    const auto add = [&](Piece&& piece)
    {
        piece.safe = never;
        const std::size_t n = piece.inScale[0].coefficients().size();
        for (std::size_t c = 0; c < n; ++c)
        {
            std::array<double, 4> cubic;
            for (std::size_t i = 0; i < 4; ++i)
            {
                cubic[i] = piece.inScale[i].coefficients()[c];
            }
            piece.safe = std::min(piece.safe, firstRoot(cubic, 0, 1));
        }
        for (int corner = 0; corner < 8; ++corner)
        {
            std::array<double, 4> there;
            for (std::size_t i = 0; i < 4; ++i)
            {
                there[i] = piece.inScale[i].corner(corner);
            }
            const double root = firstRoot(there, 0, 1);
            if (root < reached)
            {
                reached = root;
                where_ = cornerOf(corner, piece.low, piece.high);
            }
        }
        if (piece.safe < never)
        {
            open.push(std::move(piece));
        }
    };

    for (Piece& piece : pieces())
    {
        add(std::move(piece));
    }
    const int most = open.empty() ? 0 : mostHalvingsOf(open.top().inScale[0]);
    for (int halvings = 0; !open.empty() && halvings < most; ++halvings)
    {
        const Piece piece = open.top();
        if (std::min(reached, 1.0) - piece.safe <= tolerance)
        {
            break;
        }
        open.pop();
        const int d = steepest(piece.inScale[3]);
        const double middle = 0.5 * (piece.low[d] + piece.high[d]);
        Piece lower(piece);
        Piece upper(piece);
        lower.high[d] = middle;
        upper.low[d] = middle;
        for (std::size_t i = 0; i < 4; ++i)
        {
            auto halves = piece.inScale[i].halves(d);
            lower.inScale[i] = std::move(halves.first);
            upper.inScale[i] = std::move(halves.second);
        }
        add(std::move(lower));
        add(std::move(upper));
    }
    return open.empty() ? 1.0 : std::min(open.top().safe, 1.0);
}

} // namespace morph
