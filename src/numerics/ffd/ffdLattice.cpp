// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "ffdLattice.hpp"

#include "multiVersion.hpp"

#include <cmath>
#include <stdexcept>

namespace morph
{

namespace
{

// Three components and nothing: what one instruction takes
using Four = double __attribute__((vector_size(32), aligned(8)));


// Where the functions that are not zero at a point begin and end
struct Shape
{
    Index length[3];
    Index extended[3];
};

} // namespace


// Sums over the control points that reach each point. Every point by itself,
// so that its displacement depends on nothing but its own rows
MORPH_MULTIVERSION
static void contract(
    const Shape& shape, Index n, const std::int32_t* first, const double* row,
    const double* scale, const double* control, const unsigned char* lineMoves,
    double* displacement)
{
    const Index a = shape.length[0];
    const Index b = shape.length[1];
    const Index c = shape.length[2];

    for (Index point = 0; point < n; ++point)
    {
        Four sum = {0, 0, 0, 0};
        for (Index k = 0; k < c; ++k)
        {
            Four plane = {0, 0, 0, 0};
            for (Index j = 0; j < b; ++j)
            {
                const Index line =
                    first[1] + j + shape.extended[1] * (first[2] + k);
                if (!lineMoves[line])
                {
                    continue;
                }
                const double* d =
                    control + 4 * (first[0] + shape.extended[0] * line);
                Four along = {0, 0, 0, 0};
                for (Index i = 0; i < a; ++i)
                {
                    along += row[i] * reinterpret_cast<const Four*>(d)[i];
                }
                plane += row[a + j] * along;
            }
            sum += row[a + b + k] * plane;
        }
        const double factor = scale ? scale[point] : 1;
        for (int d = 0; d < 3; ++d)
        {
            displacement[d] = factor * sum[d];
        }

        first += 3;
        row += a + b + c;
        displacement += 3;
    }
}


FfdLattice::FfdLattice(
    const std::array<BSpline, 3>& basis, const std::vector<double>& weights)
: basis_(basis),
  weights_(weights)
{
    if (!weights.empty() && Index(weights.size()) != size())
    {
        throw std::invalid_argument("one weight is needed per control point");
    }
    for (const double weight : weights)
    {
        if (!(weight > 0) || !std::isfinite(weight))
        {
            throw std::invalid_argument("weights have to be positive");
        }
    }
}


Index FfdLattice::size() const
{
    return basis_[0].size() * basis_[1].size() * basis_[2].size();
}


Index FfdLattice::number(Index l, Index m, Index n) const
{
    return l + basis_[0].size() * (m + basis_[1].size() * n);
}


double FfdLattice::scale(const std::int32_t* first, const double* row) const
{
    const Index a = basis_[0].degree() + 1;
    const Index b = basis_[1].degree() + 1;
    const Index c = basis_[2].degree() + 1;
    double sum = 0;
    for (Index k = 0; k < c; ++k)
    {
        for (Index j = 0; j < b; ++j)
        {
            for (Index i = 0; i < a; ++i)
            {
                const Index control = number(
                    basis_[0].control(first[0] + i),
                    basis_[1].control(first[1] + j),
                    basis_[2].control(first[2] + k));
                sum += row[i] * row[a + j] * row[a + b + k]
                    * weights_[std::size_t(control)];
            }
        }
    }
    return 1 / sum;
}


LatticeRows FfdLattice::rows(const Vectors& xi) const
{
    LatticeRows rows;
    rows.size = xi.rows();
    Index length = 0;
    for (const BSpline& basis : basis_)
    {
        length += basis.degree() + 1;
    }
    rows.first.resize(std::size_t(3 * xi.rows()));
    rows.values.resize(std::size_t(length * xi.rows()));
    rows.scale.resize(rational() ? std::size_t(xi.rows()) : 0);

    std::int32_t* first = rows.first.data();
    double* row = rows.values.data();
    for (Index point = 0; point < xi.rows(); ++point)
    {
        double* values = row;
        for (int d = 0; d < 3; ++d)
        {
            first[d] = std::int32_t(basis(d).values(xi(point, d), values));
            values += basis(d).degree() + 1;
        }
        if (rational())
        {
            rows.scale[std::size_t(point)] = scale(first, row);
        }
        first += 3;
        row += length;
    }
    return rows;
}


std::vector<double> FfdLattice::extended(const Vectors& control) const
{
    const Index a = basis_[0].extendedSize();
    const Index b = basis_[1].extendedSize();
    const Index c = basis_[2].extendedSize();
    std::vector<double> values(std::size_t(4 * a * b * c), 0.0);
    double* value = values.data();
    for (Index k = 0; k < c; ++k)
    {
        for (Index j = 0; j < b; ++j)
        {
            for (Index i = 0; i < a; ++i)
            {
                const Index from = number(
                    basis_[0].control(i), basis_[1].control(j),
                    basis_[2].control(k));
                const double weight =
                    rational() ? weights_[std::size_t(from)] : 1;
                for (int d = 0; d < 3; ++d)
                {
                    value[d] = weight * control(from, d);
                }
                value += 4;
            }
        }
    }
    return values;
}


Vectors
FfdLattice::displacement(const LatticeRows& rows, const Vectors& control) const
{
    Shape shape;
    for (int d = 0; d < 3; ++d)
    {
        shape.length[d] = basis(d).degree() + 1;
        shape.extended[d] = basis(d).extendedSize();
    }

    const std::vector<double> values = extended(control);
    const Index perLine = 4 * shape.extended[0];
    std::vector<unsigned char> lineMoves;
    for (std::size_t i = 0; i < values.size(); i += std::size_t(perLine))
    {
        bool moves = false;
        for (std::size_t j = i; j < i + std::size_t(perLine); ++j)
        {
            moves = moves || values[j] != 0;
        }
        lineMoves.push_back(moves);
    }

    Vectors displacement(rows.size, 3);
    contract(
        shape, rows.size, rows.first.data(), rows.values.data(),
        rational() ? rows.scale.data() : nullptr, values.data(),
        lineMoves.data(), displacement.data());
    return displacement;
}


Vectors FfdLattice::transposed(const LatticeRows& rows, const Vectors& g) const
{
    const Index a = basis_[0].degree() + 1;
    const Index b = basis_[1].degree() + 1;
    const Index c = basis_[2].degree() + 1;
    Vectors control = Vectors::Zero(size(), 3);
    const std::int32_t* first = rows.first.data();
    const double* row = rows.values.data();
    for (Index point = 0; point < rows.size; ++point)
    {
        const Eigen::RowVector3d scaled =
            (rational() ? rows.scale[std::size_t(point)] : 1) * g.row(point);
        const bool some = !scaled.isZero(0);
        for (Index k = 0; some && k < c; ++k)
        {
            for (Index j = 0; j < b; ++j)
            {
                const double plane = row[a + b + k] * row[a + j];
                for (Index i = 0; i < a; ++i)
                {
                    const Index to = number(
                        basis_[0].control(first[0] + i),
                        basis_[1].control(first[1] + j),
                        basis_[2].control(first[2] + k));
                    const double weight =
                        rational() ? weights_[std::size_t(to)] : 1;
                    control.row(to) += plane * row[i] * weight * scaled;
                }
            }
        }
        first += 3;
        row += a + b + c;
    }
    return control;
}


Vector3
FfdLattice::displacement(const Vector3& xi, const Vectors& control) const
{
    Vectors one(1, 3);
    one.row(0) = xi.transpose();
    return displacement(rows(one), control).row(0).transpose();
}


Eigen::Matrix3d
FfdLattice::gradient(const Vector3& xi, const Vectors& control) const
{
    std::vector<double> value[3], slope[3];
    Index first[3];
    for (int d = 0; d < 3; ++d)
    {
        value[d].resize(std::size_t(basis(d).degree() + 1));
        slope[d].resize(value[d].size());
        first[d] = basis(d).values(xi[d], value[d].data(), slope[d].data());
    }

    // Homogeneous: three components times weight, and the weight; of each the
    // value and three derivatives
    Eigen::Matrix4d sums = Eigen::Matrix4d::Zero();
    for (std::size_t k = 0; k < value[2].size(); ++k)
    {
        for (std::size_t j = 0; j < value[1].size(); ++j)
        {
            for (std::size_t i = 0; i < value[0].size(); ++i)
            {
                const Index from = number(
                    basis_[0].control(first[0] + Index(i)),
                    basis_[1].control(first[1] + Index(j)),
                    basis_[2].control(first[2] + Index(k)));
                const double weight =
                    rational() ? weights_[std::size_t(from)] : 1;
                Eigen::Vector4d d;
                d << weight * control.row(from).transpose(), weight;
                const Eigen::RowVector4d b(
                    value[0][i] * value[1][j] * value[2][k],
                    slope[0][i] * value[1][j] * value[2][k],
                    value[0][i] * slope[1][j] * value[2][k],
                    value[0][i] * value[1][j] * slope[2][k]);
                sums += d * b;
            }
        }
    }
    if (!rational())
    {
        return sums.topRightCorner<3, 3>();
    }
    const double weight = sums(3, 0);
    const Vector3 d = sums.topLeftCorner<3, 1>() / weight;
    return (sums.topRightCorner<3, 3>() - d * sums.bottomRightCorner<1, 3>())
        / weight;
}

} // namespace morph
