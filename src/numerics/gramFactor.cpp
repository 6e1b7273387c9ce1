#include "gramFactor.hpp"

#include "kernelSum.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace morph
{

namespace
{

// Grows [A] to [A 0; B D] with D lower triangular
void appendLower(GrowingMatrix& a, const Matrix& b, const Matrix& d)
{
    const Index n = a.rows();
    const Index m = d.rows();
    a.grow(n + m, n + m);
    a.view().topRightCorner(n, m).setZero();
    a.view().bottomLeftCorner(m, n) = b;
    a.view().bottomRightCorner(m, m) = d;
}


void append(Columns& x, const ControlPoints& points)
{
    const Index n = x.rows();
    x.conservativeResize(n + points.size(), 3);
    x.bottomRows(points.size()) = positions(points);
}


// Cholesky factor; false where the matrix is not positive definite
bool cholesky(const Matrix& a, Matrix& lower)
{
    const Eigen::LLT<Matrix> llt(a);
    lower = llt.matrixL();
    return llt.info() == Eigen::Success && lower.allFinite();
}


// L^-1 B, where only the lower triangle of L is looked at
template<class Lower>
Matrix solved(const Lower& L, Matrix b)
{
    if (L.rows() > 0)
    {
        L.template triangularView<Eigen::Lower>().solveInPlace(b);
    }
    return b;
}


// L^-T B
template<class Lower>
Matrix solvedTransposed(const Lower& L, Matrix b)
{
    if (L.rows() > 0)
    {
        L.transpose().template triangularView<Eigen::Upper>().solveInPlace(b);
    }
    return b;
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


Matrix select
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
            b(i, j) = a(rows[i], columns[j]);
        }
    }
    return b;
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


Matrix GramFactor::directions(const ControlPoints& points) const
{
    const std::vector<Index> offset = offsets(points);
    Matrix c(offset.back(), 3);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
        c.middleRows(offset[i], points[i].k) = points[i].C().transpose();
    }
    return c;
}


Matrix GramFactor::expand
(
    const Matrix& scalar,
    const ControlPoints& rows,
    const ControlPoints& columns
)
{
    const std::vector<Index> row = offsets(rows);
    const std::vector<Index> column = offsets(columns);
    Matrix e(row.back(), column.back());
    for (std::size_t j = 0; j < columns.size(); ++j)
    {
        for (Index c = column[j]; c < column[j + 1]; ++c)
        {
            for (std::size_t i = 0; i < rows.size(); ++i)
            {
                for (Index r = row[i]; r < row[i + 1]; ++r)
                {
                    e(r, c) = scalar(i, j);
                }
            }
        }
    }
    return e;
}


Matrix GramFactor::constrained
(
    const Matrix& scalar,
    const ControlPoints& rows,
    const ControlPoints& columns
) const
{
    return expand(scalar, rows, columns).cwiseProduct
    (
        directions(rows)*directions(columns).transpose()
    );
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
    result.Y = solved(L_.view(), kernelBlock(xM_, x));
    result.TKK = kernelBlock(x, x);
    result.TKK.noalias() -= result.Y.transpose()*result.Y;
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
    result.W = constrained(result.TKK, list, list);
    if (!sliding_.empty())
    {
        result.TSK.noalias() -= Y_.view().transpose()*result.Y;
        const Matrix Q =
            solved(R_.view(), constrained(result.TSK, sliding_, list));
        result.W.noalias() -= Q.transpose()*Q;
    }
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
    const bool prescribedIn = P.empty() || appendPrescribed
    (
        prescribed,
        selectColumns(residual.Y, P),
        select(residual.TKK, P, P),
        selectColumns(residual.TSK, P)
    );

    // What the prescribed ones, if they are in, take from the sliding ones
    Matrix Y = selectColumns(residual.Y, Q);
    Matrix T = select(residual.TKK, Q, Q);
    Matrix TS = selectColumns(residual.TSK, Q);
    if (prescribedIn && !P.empty() && !Q.empty())
    {
        const Index n = nextPrescribed;
        const Index m = P.size();
        const Matrix rows = solved
        (
            L_.view().bottomRightCorner(m, m), select(residual.TKK, P, Q)
        );
        Y.conservativeResize(n + m, Q.size());
        Y.bottomRows(m) = rows;
        T.noalias() -= rows.transpose()*rows;
        if (nextSliding > 0)
        {
            TS.noalias() -= Y_.view().bottomRows(m).transpose()*rows;
        }
    }
    const bool slidingIn = Q.empty() || appendSliding(sliding, Y, T, TS);

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
    const Matrix& TS
)
{
    Matrix l;
    if (!cholesky(T, l))
    {
        return false;
    }

    const Index n = xM_.rows();
    const Index m = points.size();
    const Index nS = xS_.rows();
    if (nS > 0)
    {
        const Matrix rows = solved(l, TS.transpose());
        Matrix TSS = T_.view();
        TSS.noalias() -= rows.transpose()*rows;
        Matrix R;
        if (!cholesky(constrained(TSS, sliding_, sliding_), R))
        {
            return false;
        }
        R_.view() = R;
        T_.view() = TSS;
        Y_.grow(n + m, nS);
        Y_.view().bottomRows(m) = rows;
    }

    appendLower(L_, X.transpose(), l);
    morph::append(xM_, points);
    prescribed_.insert(prescribed_.end(), points.begin(), points.end());
    return true;
}


bool GramFactor::appendSliding
(
    const ControlPoints& points,
    const Matrix& Y,
    const Matrix& T,
    const Matrix& TS
)
{
    const Index n = xS_.rows();
    const Index m = points.size();
    const Matrix X = solved(R_.view(), constrained(TS, sliding_, points));
    Matrix D = constrained(T, points, points);
    D.noalias() -= X.transpose()*X;
    Matrix r;
    if (!cholesky(D, r))
    {
        return false;
    }

    appendLower(R_, X.transpose(), r);
    Y_.grow(xM_.rows(), n + m);
    Y_.view().rightCols(m) = Y;
    T_.grow(n + m, n + m);
    T_.view().topRightCorner(n, m) = TS;
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
    Matrix z = solved(L_.view(), d);

    Columns gamma = Columns::Zero(r + nM + nS, 3);
    if (nS > 0)
    {
        const Matrix known = Y_.view().transpose()*z + shift(xS_);
        const std::vector<Index> offset = offsets(sliding_);
        Matrix g(offset.back(), 1);
        for (Index i = 0; i < nS; ++i)
        {
            const ControlPoint& p = sliding_[i];
            g.middleRows(offset[i], p.k) =
                p.residual(known.row(i).transpose()).head(p.k);
        }
        const Matrix alpha = solvedTransposed(R_.view(), solved(R_.view(), g));
        for (Index i = 0; i < nS; ++i)
        {
            const ControlPoint& p = sliding_[i];
            const Vector3 weight =
                p.C()*alpha.middleRows(offset[i], p.k);
            gamma.row(r + nM + i) = weight.transpose();
        }
        z.noalias() -= Y_.view()*gamma.bottomRows(nS);
    }
    gamma.middleRows(r, nM) = solvedTransposed(L_.view(), z);

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
