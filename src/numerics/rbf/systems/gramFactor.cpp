// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "gramFactor.hpp"

#include "kernelSum.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace morph
{

namespace
{

void append(Columns& x, const ControlPoints& points)
{
    const Index n = x.rows();
    x.conservativeResize(n + points.size(), 3);
    x.bottomRows(points.size()) = positions(points);
}


// Replaces the lower triangle by its Cholesky factor, without a copy; false where
// the matrix is not positive definite
bool factorise(Matrix& a)
{
    const Eigen::LLT<Eigen::Ref<Matrix>> llt(a);
    bool finite = llt.info() == Eigen::Success;
    for (Index j = 0; finite && j < a.cols(); ++j)
    {
        finite = a.col(j).tail(a.rows() - j).allFinite();
    }
    return finite;
}


Matrix selectColumns(const Matrix& a, const std::vector<Index>& columns)
{
    Matrix b(a.rows(), columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
        b.col(j) = a.col(columns[j]);
    }
    return b;
}


ControlPoints
selectPoints(const ControlPoints& list, const std::vector<Index>& which)
{
    ControlPoints points;
    for (const Index i : which)
    {
        points.push_back(list[i]);
    }
    return points;
}


// The rows in the system of points of a list
std::vector<Index>
rowsOf(const std::vector<Index>& points, const std::vector<Index>& offset)
{
    std::vector<Index> rows;
    for (const Index i : points)
    {
        for (Index r = offset[i]; r < offset[i + 1]; ++r)
        {
            rows.push_back(r);
        }
    }
    return rows;
}


// a -= x^T x, in the lower triangle
void subtractSquare(Matrix& a, const Matrix& x)
{
    if (x.rows() > 0)
    {
        a.selfadjointView<Eigen::Lower>().rankUpdate(x.transpose(), -1);
    }
}


std::vector<Index> offsets(const ControlPoints& points)
{
    std::vector<Index> offset(1, 0);
    for (const ControlPoint& p : points)
    {
        offset.push_back(offset.back() + p.k);
    }
    return offset;
}


// t_ij C_i^T C_j
Matrix constrained(
    const Matrix& t, const ControlPoints& rows, const ControlPoints& columns,
    bool onlyLower = false)
{
    // The directions of all rows, and whose they are
    std::vector<Index> point;
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        point.insert(point.end(), rows[i].k, i);
    }
    const Index n = point.size();
    Columns c(n, 3);
    const std::vector<Index> first = offsets(rows);
    for (std::size_t i = 0; i < rows.size(); ++i)
    {
        c.middleRows(first[i], rows[i].k) = rows[i].C().transpose();
    }

    Matrix e(n, offsets(columns).back());
    Index column = 0;
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
        for (int k = 0; k < columns[j].k; ++k, ++column)
        {
            const Vector3 d = columns[j].directions.col(k);
            for (Index i = onlyLower ? column : 0; i < n; ++i)
            {
                e(i, column) = t(point[i], j)
                    * (c(i, 0) * d[0] + c(i, 1) * d[1] + c(i, 2) * d[2]);
            }
        }
    }
    return e;
}

} // namespace


GramFactor::GramFactor(const Kernel& kernel)
: GramFactor(kernel, AffineBasis(), Matrix(0, 3))
{
    if (kernel.order() > 0)
    {
        throw std::invalid_argument(
            "a conditionally definite kernel needs a polynomial");
    }
}


GramFactor::GramFactor(
    const Kernel& kernel, const AffineBasis& basis, const Matrix& nodeValues)
: kernel_(kernel),
  basis_(basis),
  nodeValues_(nodeValues),
  nodeKernel_(kernelMatrix(kernel, basis.nodes(), basis.nodes())),
  xM_(0, 3),
  xS_(0, 3)
{
}


Columns GramFactor::centres() const
{
    Columns x(basis_.size() + xM_.rows() + xS_.rows(), 3);
    x << basis_.nodes(), xM_, xS_;
    return x;
}


Matrix GramFactor::kernelBlock(const Columns& a, const Columns& b) const
{
    Matrix k = kernelMatrix(kernel_, a, b);
    if (basis_.size() > 0)
    {
        const Matrix la = basis_.values(a);
        const Matrix lb = basis_.values(b);
        const Matrix ka = kernelMatrix(kernel_, a, basis_.nodes());
        const Matrix kb = kernelMatrix(kernel_, b, basis_.nodes());
        k.noalias() -= la * (kb - lb * nodeKernel_).transpose();
        k.noalias() -= ka * lb.transpose();
    }
    return k;
}


double GramFactor::pivotScale(const Vector3& x) const
{
    const Columns p = x.transpose();
    double largest = std::abs(kernel_(0));
    if (basis_.size() > 0)
    {
        const Matrix k = kernelMatrix(kernel_, p, basis_.nodes());
        largest = std::max(largest, k.cwiseAbs().maxCoeff());
        largest = std::max(largest, nodeKernel_.cwiseAbs().maxCoeff());
    }
    const double sum = 1 + basis_.values(p).cwiseAbs().sum();
    return sum * sum * largest;
}


Matrix GramFactor::shift(const Columns& x) const
{
    return basis_.values(x) * nodeValues_;
}


Matrix GramFactor::besideSliding(const Columns& x, const Matrix& Y) const
{
    Matrix t = kernelBlock(xS_, x);
    if (t.size() > 0)
    {
        Y_.subtractTransposedTimes(Y, t);
    }
    return t;
}


GramFactor::Residual GramFactor::residual(const ControlPoints& list) const
{
    Residual result;
    result.scalar = sliding_.empty();
    for (const ControlPoint& p : list)
    {
        result.scalar = result.scalar && !p.slides();
    }

    const Columns x = positions(list);
    result.Y = L_.solved(kernelBlock(xM_, x));
    if (result.scalar)
    {
        result.offset.resize(list.size() + 1);
        std::iota(result.offset.begin(), result.offset.end(), Index(0));
        return result;
    }
    result.offset = offsets(list);
    result.Q =
        R_.solved(constrained(besideSliding(x, result.Y), sliding_, list));
    return result;
}


Matrix GramFactor::columns(
    const ControlPoints& list, const Residual& residual,
    const std::vector<Index>& which) const
{
    const ControlPoints some = selectPoints(list, which);
    Matrix t = kernelBlock(positions(list), positions(some));
    if (residual.Y.rows() > 0)
    {
        t.noalias() -=
            residual.Y.transpose() * selectColumns(residual.Y, which);
    }
    if (residual.scalar)
    {
        return t;
    }
    Matrix w = constrained(t, list, some);
    if (residual.Q.rows() > 0)
    {
        w.noalias() -= residual.Q.transpose()
            * selectColumns(residual.Q, rowsOf(which, residual.offset));
    }
    return w;
}


std::vector<bool> GramFactor::append(const ControlPoints& list)
{
    std::vector<Index> all(list.size());
    std::iota(all.begin(), all.end(), Index(0));
    return append(list, all, residual(list));
}


std::vector<bool> GramFactor::append(
    const ControlPoints& list, const std::vector<Index>& which,
    Residual&& residual)
{
    std::vector<Index> P, S;
    for (const Index i : which)
    {
        (list[i].slides() ? S : P).push_back(i);
    }
    const Matrix YP = selectColumns(residual.Y, P);
    Matrix YS = selectColumns(residual.Y, S);
    Matrix Q = residual.scalar
        ? Matrix()
        : selectColumns(residual.Q, rowsOf(S, residual.offset));
    residual = Residual();

    Index nextPrescribed = prescribed_.size();
    Index nextSliding = sliding_.size();
    const ControlPoints prescribed = selectPoints(list, P);
    const ControlPoints sliding = selectPoints(list, S);
    Matrix l;
    const bool prescribedIn = P.empty() || appendPrescribed(prescribed, YP, l);

    if (prescribedIn && !P.empty() && !S.empty())
    {
        // What the prescribed ones take from the sliding ones
        const Columns x = positions(sliding);
        Matrix rows = kernelBlock(positions(prescribed), x);
        rows.noalias() -= YP.transpose() * YS;
        l.triangularView<Eigen::Lower>().solveInPlace(rows);
        YS.conservativeResize(YS.rows() + rows.rows(), S.size());
        YS.bottomRows(rows.rows()) = rows;
        Q = R_.solved(constrained(besideSliding(x, YS), sliding_, sliding));
    }
    const bool slidingIn = S.empty() || appendSliding(sliding, YS, Q);

    std::vector<bool> in;
    for (const Index i : which)
    {
        const bool slides = list[i].slides();
        in.push_back(slides ? slidingIn : prescribedIn);
        if (in.back())
        {
            Index& next = slides ? nextSliding : nextPrescribed;
            entries_.push_back({slides, next++});
        }
    }
    return in;
}


bool GramFactor::appendPrescribed(
    const ControlPoints& points, const Matrix& Y, Matrix& l)
{
    const Columns x = positions(points);
    l = kernelBlock(x, x);
    subtractSquare(l, Y);
    if (!factorise(l))
    {
        return false;
    }

    Matrix rows = besideSliding(x, Y).transpose();
    if (rows.cols() > 0)
    {
        l.triangularView<Eigen::Lower>().solveInPlace(rows);
        Matrix T = T_;
        subtractSquare(T, rows);
        Matrix R = constrained(T, sliding_, sliding_, true);
        if (!factorise(R))
        {
            return false;
        }
        R_.set(R);
        T_.swap(T);
    }
    Y_.appendRows(rows);

    L_.append(Y, l);
    morph::append(xM_, points);
    prescribed_.insert(prescribed_.end(), points.begin(), points.end());
    return true;
}


bool GramFactor::appendSliding(
    const ControlPoints& points, const Matrix& Y, const Matrix& Q)
{
    const Columns x = positions(points);
    Matrix T = kernelBlock(x, x);
    subtractSquare(T, Y);
    Matrix D = constrained(T, points, points, true);
    subtractSquare(D, Q);
    if (!factorise(D))
    {
        return false;
    }

    const Matrix beside = besideSliding(x, Y);
    const Index n = xS_.rows();
    const Index m = x.rows();
    R_.append(Q, D);
    Y_.appendColumns(Y);
    T_.conservativeResize(n + m, n + m);
    T_.bottomLeftCorner(m, n) = beside.transpose();
    T_.bottomRightCorner(m, m) = T;
    morph::append(xS_, points);
    sliding_.insert(sliding_.end(), points.begin(), points.end());
    return true;
}


void GramFactor::setValues(
    const std::vector<Vector3>& values, const Matrix& nodeValues)
{
    nodeValues_ = nodeValues;
    for (std::size_t i = 0; i < entries_.size(); ++i)
    {
        const Entry& e = entries_[i];
        (e.slides ? sliding_ : prescribed_)[e.index].value = values[i];
    }
}


void GramFactor::solve(RbfInterpolant& interpolant) const
{
    const Index r = basis_.size();
    const Index nM = xM_.rows();
    const Index nS = xS_.rows();

    // What the polynomial through the nodes leaves of the data
    Matrix d = -shift(xM_);
    for (Index i = 0; i < nM; ++i)
    {
        d.row(i) += prescribed_[i].value.transpose();
    }
    Matrix z = L_.solved(d);

    Columns gamma = Columns::Zero(r + nM + nS, 3);
    if (nS > 0)
    {
        Matrix known = shift(xS_);
        Y_.subtractTransposedTimes(-z, known);
        const std::vector<Index> offset = offsets(sliding_);
        Matrix g(offset.back(), 1);
        for (Index i = 0; i < nS; ++i)
        {
            const ControlPoint& p = sliding_[i];
            const Vector3 rest = p.residual(known.row(i).transpose());
            for (int a = 0; a < p.k; ++a)
            {
                g(offset[i] + a, 0) = rest[a];
            }
        }
        const Matrix alpha = R_.solvedTransposed(R_.solved(g));
        for (Index i = 0; i < nS; ++i)
        {
            const ControlPoint& p = sliding_[i];
            const Vector3 weight = p.C() * alpha.middleRows(offset[i], p.k);
            gamma.row(r + nM + i) = weight.transpose();
        }
        z -= Y_.times(gamma.bottomRows(nS));
    }
    gamma.middleRows(r, nM) = L_.solvedTransposed(z);

    const Columns x = centres();
    if (r > 0)
    {
        // Side conditions, then the polynomial that makes the nodes exact
        gamma.topRows(r) = -basis_.values(x.bottomRows(nM + nS)).transpose()
            * gamma.bottomRows(nM + nS);
        const Matrix p =
            nodeValues_ - kernelMatrix(kernel_, basis_.nodes(), x) * gamma;
        interpolant.setPolynomial(
            basis_.nodes().row(0).transpose(), p.row(0).transpose(),
            basis_.gradient(p));
    }
    interpolant.set(x, gamma);
}

} // namespace morph
