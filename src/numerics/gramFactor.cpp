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


// The rows in the system of points of a list
std::vector<Index> rowsOf
(
    const std::vector<Index>& points,
    const std::vector<Index>& offset
)
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


// Of a symmetric matrix that has only its lower triangle
Matrix selectSymmetric
(
    const Matrix& a,
    const std::vector<Index>& rows,
    const std::vector<Index>& columns
)
{
    Matrix b(rows.size(), columns.size());
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            b(i, j) = a
            (
                std::max(rows[i], columns[j]),
                std::min(rows[i], columns[j])
            );
        }
    }
    return b;
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
Matrix constrained
(
    const Matrix& t,
    const ControlPoints& rows,
    const ControlPoints& columns,
    bool onlyLower = false
)
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
                   *(c(i, 0)*d[0] + c(i, 1)*d[1] + c(i, 2)*d[2]);
            }
        }
    }
    return e;
}

} // namespace


GramFactor::GramFactor(const Kernel& kernel)
:
    GramFactor(kernel, AffineBasis(), Matrix(0, 3))
{
    if (kernel.order() > 0)
    {
        throw std::invalid_argument
        (
            "a conditionally definite kernel needs a polynomial"
        );
    }
}


GramFactor::GramFactor
(
    const Kernel& kernel,
    const AffineBasis& basis,
    const Matrix& nodeValues
)
:
    kernel_(kernel),
    basis_(basis),
    nodeValues_(nodeValues),
    nodeKernel_(kernelMatrix(kernel, basis.nodes(), basis.nodes())),
    xM_(0, 3),
    xS_(0, 3)
{}


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
        k.noalias() -= la*(kb - lb*nodeKernel_).transpose();
        k.noalias() -= ka*lb.transpose();
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
    return sum*sum*largest;
}


Matrix GramFactor::shift(const Columns& x) const
{
    return basis_.values(x)*nodeValues_;
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
    result.TKK = kernelBlock(x, x);
    subtractSquare(result.TKK, result.Y);
    result.TSK = kernelBlock(xS_, x);

    if (result.scalar)
    {
        result.W = result.TKK;
        for (std::size_t i = 0; i <= list.size(); ++i)
        {
            result.offset.push_back(i);
        }
        return result;
    }

    result.offset = offsets(list);
    if (!sliding_.empty())
    {
        result.TSK.noalias() -= Y_.view().transpose()*result.Y;
    }
    result.Q = R_.solved(constrained(result.TSK, sliding_, list));
    result.W = constrained(result.TKK, list, list, true);
    subtractSquare(result.W, result.Q);
    return result;
}


std::vector<bool> GramFactor::append(const ControlPoints& list)
{
    std::vector<Index> all(list.size());
    std::iota(all.begin(), all.end(), Index(0));
    return append(list, all, residual(list));
}


std::vector<bool> GramFactor::append
(
    const ControlPoints& list,
    const std::vector<Index>& which,
    const Residual& residual
)
{
    std::vector<Index> P, Q;
    ControlPoints prescribed, sliding;
    for (const Index i : which)
    {
        (list[i].slides() ? Q : P).push_back(i);
        (list[i].slides() ? sliding : prescribed).push_back(list[i]);
    }

    Index nextPrescribed = prescribed_.size();
    Index nextSliding = sliding_.size();
    Matrix l;
    const bool prescribedIn = P.empty() || appendPrescribed
    (
        prescribed,
        selectColumns(residual.Y, P),
        selectSymmetric(residual.TKK, P, P),
        selectColumns(residual.TSK, P),
        l
    );

    // What the prescribed ones, if they are in, take from the sliding ones
    Matrix Y = selectColumns(residual.Y, Q);
    Matrix T = selectSymmetric(residual.TKK, Q, Q);
    Matrix TS = selectColumns(residual.TSK, Q);
    if (prescribedIn && !P.empty() && !Q.empty())
    {
        const Index n = nextPrescribed;
        const Index m = P.size();
        const Matrix rows =
            l.triangularView<Eigen::Lower>().solve
            (
                selectSymmetric(residual.TKK, P, Q)
            );
        Y.conservativeResize(n + m, Q.size());
        Y.bottomRows(m) = rows;
        T.noalias() -= rows.transpose()*rows;
        if (nextSliding > 0)
        {
            TS.noalias() -= Y_.view().bottomRows(m).transpose()*rows;
        }
    }
    const bool slidingIn = Q.empty() || appendSliding
    (
        sliding,
        Y,
        T,
        TS,
        prescribedIn && !P.empty()
      ? R_.solved(constrained(TS, sliding_, sliding))
      : selectColumns(residual.Q, rowsOf(Q, residual.offset))
    );

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


bool GramFactor::appendPrescribed
(
    const ControlPoints& points,
    const Matrix& X,
    const Matrix& T,
    const Matrix& TS,
    Matrix& l
)
{
    l = T;
    if (!factorise(l))
    {
        return false;
    }

    const Index n = xM_.rows();
    const Index m = points.size();
    const Index nS = xS_.rows();
    if (nS > 0)
    {
        const Matrix rows =
            l.triangularView<Eigen::Lower>().solve(TS.transpose());
        Matrix TSS = T_.view();
        subtractSquare(TSS, rows);
        Matrix R = constrained(TSS, sliding_, sliding_, true);
        if (!factorise(R))
        {
            return false;
        }
        R_.set(std::move(R));
        T_.view() = TSS;
        Y_.grow(n + m, nS);
        Y_.view().bottomRows(m) = rows;
    }

    L_.append(X.transpose(), l);
    morph::append(xM_, points);
    prescribed_.insert(prescribed_.end(), points.begin(), points.end());
    return true;
}


bool GramFactor::appendSliding
(
    const ControlPoints& points,
    const Matrix& Y,
    const Matrix& T,
    const Matrix& TS,
    const Matrix& X
)
{
    const Index n = xS_.rows();
    const Index m = points.size();
    Matrix D = constrained(T, points, points, true);
    subtractSquare(D, X);
    if (!factorise(D))
    {
        return false;
    }

    R_.append(X.transpose(), D);
    Y_.grow(xM_.rows(), n + m);
    Y_.view().rightCols(m) = Y;
    T_.grow(n + m, n + m);
    T_.view().bottomLeftCorner(m, n) = TS.transpose();
    T_.view().bottomRightCorner(m, m) = T;
    morph::append(xS_, points);
    sliding_.insert(sliding_.end(), points.begin(), points.end());
    return true;
}


void GramFactor::setValues
(
    const std::vector<Vector3>& values,
    const Matrix& nodeValues
)
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
        const Matrix known = Y_.view().transpose()*z + shift(xS_);
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
            const Vector3 weight =
                p.C()*alpha.middleRows(offset[i], p.k);
            gamma.row(r + nM + i) = weight.transpose();
        }
        z.noalias() -= Y_.view()*gamma.bottomRows(nS);
    }
    gamma.middleRows(r, nM) = L_.solvedTransposed(z);

    const Columns x = centres();
    if (r > 0)
    {
        // Side conditions, then the polynomial that makes the nodes exact
        gamma.topRows(r) =
           -basis_.values(x.bottomRows(nM + nS)).transpose()
           *gamma.bottomRows(nM + nS);
        const Matrix p =
            nodeValues_ - kernelMatrix(kernel_, basis_.nodes(), x)*gamma;
        interpolant.setPolynomial
        (
            basis_.nodes().row(0).transpose(),
            p.row(0).transpose(),
            basis_.gradient(p)
        );
    }
    interpolant.set(x, gamma);
}

} // namespace morph
