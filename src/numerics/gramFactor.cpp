#include "gramFactor.hpp"

#include "kernelSum.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
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
    const Matrix YK = solved(L_.view(), kernelBlock(xM_, x));
    Matrix TKK = kernelBlock(x, x);
    TKK.noalias() -= YK.transpose()*YK;

    if (result.scalar)
    {
        result.W = std::move(TKK);
        for (std::size_t i = 0; i <= list.size(); ++i)
        {
            result.offset.push_back(i);
        }
        return result;
    }

    result.offset = offsets(list);
    result.W = constrained(TKK, list, list);
    if (!sliding_.empty())
    {
        Matrix TSK = kernelBlock(xS_, x);
        TSK.noalias() -= Y_.view().transpose()*YK;
        const Matrix Q = solved(R_.view(), constrained(TSK, sliding_, list));
        result.W.noalias() -= Q.transpose()*Q;
    }
    return result;
}


std::vector<bool> GramFactor::append(const ControlPoints& points)
{
    ControlPoints prescribed, sliding;
    for (const ControlPoint& p : points)
    {
        (p.slides() ? sliding : prescribed).push_back(p);
    }

    Index nextPrescribed = prescribed_.size();
    Index nextSliding = sliding_.size();
    const bool prescribedIn =
        prescribed.empty() || appendPrescribed(prescribed);
    const bool slidingIn = sliding.empty() || appendSliding(sliding);

    std::vector<bool> in;
    for (const ControlPoint& p : points)
    {
        in.push_back(p.slides() ? slidingIn : prescribedIn);
        if (in.back())
        {
            Index& next = p.slides() ? nextSliding : nextPrescribed;
            entries_.push_back({p.slides(), next++});
        }
    }
    return in;
}


bool GramFactor::appendPrescribed(const ControlPoints& points)
{
    const Columns x = positions(points);
    const Matrix X = solved(L_.view(), kernelBlock(xM_, x));
    Matrix D = kernelBlock(x, x);
    D.noalias() -= X.transpose()*X;
    Matrix l;
    if (!cholesky(D, l))
    {
        return false;
    }

    const Index n = xM_.rows();
    const Index m = x.rows();
    const Index nS = xS_.rows();
    if (nS > 0)
    {
        Matrix rows = kernelBlock(x, xS_);
        rows.noalias() -= X.transpose()*Y_.view();
        rows = solved(l, rows);
        Matrix T = T_.view();
        T.noalias() -= rows.transpose()*rows;
        Matrix R;
        if (!cholesky(constrained(T, sliding_, sliding_), R))
        {
            return false;
        }
        R_.view() = R;
        T_.view() = T;
        Y_.grow(n + m, nS);
        Y_.view().bottomRows(m) = rows;
    }

    appendLower(L_, X.transpose(), l);
    morph::append(xM_, points);
    prescribed_.insert(prescribed_.end(), points.begin(), points.end());
    return true;
}


bool GramFactor::appendSliding(const ControlPoints& points)
{
    const Index n = xS_.rows();
    const Index m = points.size();
    const Columns x = positions(points);
    const Matrix Y = solved(L_.view(), kernelBlock(xM_, x));
    Matrix TSQ = kernelBlock(xS_, x);
    if (n > 0)
    {
        TSQ.noalias() -= Y_.view().transpose()*Y;
    }
    Matrix TQQ = kernelBlock(x, x);
    TQQ.noalias() -= Y.transpose()*Y;

    const Matrix X = solved(R_.view(), constrained(TSQ, sliding_, points));
    Matrix D = constrained(TQQ, points, points);
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
    T_.view().topRightCorner(n, m) = TSQ;
    T_.view().bottomLeftCorner(m, n) = TSQ.transpose();
    T_.view().bottomRightCorner(m, m) = TQQ;
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
