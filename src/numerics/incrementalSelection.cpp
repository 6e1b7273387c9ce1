#include "incrementalSelection.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace morph
{

namespace
{

// A pivot below this fraction of its scale is round-off
constexpr double leastPivot = 1e-12;

// In units of the distance from the worst candidate to what is selected: one
// candidate per cell keeps neighbours, which one point corrects together, from
// filling the list
constexpr double cellFraction = 0.4;

// Points taken in one go where every candidate is to be selected
constexpr Index blockOfAll = 256;


// Adds the wall time of its life to a sum
class Stopwatch
{
public:

    explicit Stopwatch(double& sum)
    :
        sum_(sum),
        start_(std::chrono::steady_clock::now())
    {}

    ~Stopwatch()
    {
        sum_ += std::chrono::duration<double>
            (std::chrono::steady_clock::now() - start_).count();
    }

private:

    double& sum_;
    std::chrono::steady_clock::time_point start_;
};

} // namespace


IncrementalSelection::IncrementalSelection
(
    const Kernel& kernel,
    Polynomial polynomial,
    const SelectionSettings& settings
)
:
    kernel_(kernel),
    polynomial_(polynomial),
    settings_(settings),
    interpolant_(kernel)
{
    if (!(settings.tolerance >= 0) || settings.maxPoints < 1)
    {
        throw std::invalid_argument
        (
            "selection needs a tolerance >= 0 and at least one point"
        );
    }
    if (kernel.order() > 0 && polynomial == Polynomial::none)
    {
        throw std::invalid_argument
        (
            "a conditionally definite kernel needs a linear polynomial"
        );
    }
}


std::vector<Index> IncrementalSelection::selected() const
{
    std::vector<Index> indices;
    for (std::size_t i = 0; i < mine_.size(); ++i)
    {
        if (mine_[i])
        {
            indices.push_back(i);
        }
    }
    return indices;
}


SelectionResult IncrementalSelection::select
(
    const ControlPoints& candidates,
    Communicator& communicator
)
{
    SelectionResult result;

    double largest = 0;
    for (const ControlPoint& p : candidates)
    {
        largest = std::max(largest, p.g().norm());
    }
    result.largestDisplacement = communicator.max(largest);
    result.tolerance = settings_.tolerance*result.largestDisplacement;

    {
        Stopwatch time(result.solveTime);
        if (!started_)
        {
            start(candidates, communicator);
        }
        else
        {
            refreshValues(candidates, communicator);
        }
        factor_->solve(interpolant_);
    }

    const double least = settings_.all ? -1 : result.tolerance;
    const Index before = origins_.size();
    while (true)
    {
        {
            Stopwatch time(result.sweepTime);
            sweep(candidates);
            ++result.sweeps;
        }

        std::vector<Listed> list;
        Choice choice;
        {
            Stopwatch time(result.listTime);
            double outside = 0;
            list = candidateList
            (
                candidates, errors_, least, 1, 0, communicator, outside
            );
            const Index room = settings_.maxPoints - Index(origins_.size());
            if (list.empty() || room <= 0)
            {
                break;
            }
            const Index most = std::min(room, listLength());
            if (most > 1)
            {
                list = candidateList
                (
                    candidates,
                    errors_,
                    least,
                    settings_.all ? most : 3*most,
                    settings_.all ? 0 : cellSize(list.front()),
                    communicator,
                    outside
                );
            }
            choice = choose
            (
                list, most, least, settings_.all ? least : outside
            );
        }

        Stopwatch time(result.solveTime);
        for (const Index i : choice.singular)
        {
            reject(list[i], communicator.rank());
        }
        append(list, choice.taken, communicator.rank());
        factor_->solve(interpolant_);
    }

    result.added = Index(origins_.size()) - before;
    summarise(candidates, communicator, result);
    return result;
}


void IncrementalSelection::start
(
    const ControlPoints& candidates,
    Communicator& communicator
)
{
    origins_.clear();
    values_.clear();
    const Index n = candidates.size();
    Vectors x(n, 3);
    for (Index i = 0; i < n; ++i)
    {
        x.row(i) = candidates[i].position.transpose();
    }
    cloud_.reset(new PointCloud(x));
    errors_.residuals.resize(n, 3);
    errors_.norms.resize(n);
    errors_.available.assign(n, 1);
    mine_.assign(n, 0);

    if (polynomial_ == Polynomial::linear)
    {
        chooseNodes(candidates, communicator);
    }
    else
    {
        factor_.reset(new GramFactor(kernel_));
    }
    started_ = true;
}


void IncrementalSelection::chooseNodes
(
    const ControlPoints& candidates,
    Communicator& communicator
)
{
    // The errors stand for distances here: the first node is the first by
    // position, each further one that farthest from the span of the others
    Errors far = errors_;
    far.residuals.setZero();
    AffineBasis basis;
    Columns nodes(0, 3);
    double span = 0;
    double outside = 0;
    const auto farthest = [&](bool slidingToo)
    {
        for (std::size_t i = 0; i < candidates.size(); ++i)
        {
            const ControlPoint& p = candidates[i];
            far.available[i] = slidingToo || !p.slides();
            far.norms[i] =
                basis.size() > 0 ? basis.distance(p.position) : 1.0;
        }
        return candidateList(candidates, far, 0, 1, 0, communicator, outside);
    };

    while (nodes.rows() < std::min<Index>(4, settings_.maxPoints))
    {
        const std::vector<Listed> next = farthest(false);
        if (next.empty() || next[0].error <= 1e-6*span)
        {
            break;
        }
        if (nodes.rows() > 0)
        {
            span = std::max(span, next[0].error);
        }
        take(next[0], communicator.rank());
        nodes.conservativeResize(nodes.rows() + 1, 3);
        nodes.bottomRows(1) = next[0].point.position.transpose();
        basis = AffineBasis(nodes);
    }
    nNodes_ = nodes.rows();

    if (nNodes_ == 0)
    {
        throw std::invalid_argument
        (
            "a linear polynomial needs moving or fixed control points, "
            "but all of them slide"
        );
    }
    if (kernel_.order() > 1)
    {
        const std::vector<Listed> off = farthest(true);
        if (!off.empty() && off[0].error > 1e-6*std::max(span, 1e-300))
        {
            throw std::invalid_argument
            (
                "thinPlate needs moving or fixed control points that do not "
                "all lie in one plane (in 2D: on one line)"
            );
        }
    }

    factor_.reset(new GramFactor(kernel_, basis, nodeValues()));
}


Matrix IncrementalSelection::nodeValues() const
{
    Matrix v(nNodes_, 3);
    for (Index i = 0; i < nNodes_; ++i)
    {
        v.row(i) = values_[i].transpose();
    }
    return v;
}


void IncrementalSelection::refreshValues
(
    const ControlPoints& candidates,
    Communicator& communicator
)
{
    std::vector<double> v(3*origins_.size(), 0.0);
    for (std::size_t i = 0; i < origins_.size(); ++i)
    {
        if (origins_[i].rank == communicator.rank())
        {
            const Vector3& value = candidates[origins_[i].index].value;
            std::copy(value.data(), value.data() + 3, &v[3*i]);
        }
    }
    v = communicator.sum(v);
    for (std::size_t i = 0; i < origins_.size(); ++i)
    {
        values_[i] = Eigen::Map<const Vector3>(&v[3*i]);
    }

    factor_->setValues
    (
        std::vector<Vector3>(values_.begin() + nNodes_, values_.end()),
        nodeValues()
    );
}


void IncrementalSelection::sweep(const ControlPoints& candidates)
{
    const Vectors s = interpolant_(*cloud_);
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        const Vector3 r = candidates[i].residual(s.row(i).transpose());
        errors_.residuals.row(i) = r.transpose();
        errors_.norms[i] = r.norm();
    }
}


Index IncrementalSelection::listLength() const
{
    if (settings_.all)
    {
        return blockOfAll;
    }
    return settings_.pointsPerSweep > 0
      ? settings_.pointsPerSweep
      : std::max<Index>(4, origins_.size()/10);
}


double IncrementalSelection::cellSize(const Listed& worst) const
{
    double nearest = kernel_.supportRadius();
    const Columns& x = interpolant_.centres();
    if (x.rows() > 0)
    {
        nearest = std::sqrt
        (
            (x.rowwise() - worst.point.position.transpose())
           .rowwise().squaredNorm().minCoeff()
        );
    }
    return cellFraction*nearest;
}


IncrementalSelection::Choice IncrementalSelection::choose
(
    const std::vector<Listed>& list,
    Index most,
    double least,
    double outside
)
{
    // The greedy algorithm on the list: a Cholesky factorisation of its Schur
    // complement, block by block, each pivot the point with the largest error
    // left
    ControlPoints points;
    for (const Listed& entry : list)
    {
        points.push_back(entry.point);
    }
    const GramFactor::Residual system = factor_->residual(points);
    const std::vector<Index>& first = system.offset;
    const Index n = list.size();

    Matrix r(first.back(), system.scalar ? 3 : 1);
    for (Index p = 0; p < n; ++p)
    {
        if (system.scalar)
        {
            r.row(p) = list[p].residual.transpose();
        }
        else
        {
            const Index k = points[p].k;
            r.middleRows(first[p], k) = list[p].residual.head(k);
        }
    }

    const Index width = system.scalar ? 1 : 3;
    Matrix V(first.back(), std::min(most, n)*width);
    Index columns = 0;
    std::vector<char> usable(n, 1);
    Choice choice;
    while (Index(choice.taken.size()) < std::min(most, n))
    {
        Index p = -1;

        // The first of the list is tried in any case: round-off here may differ
        // from that in the sweep, and without progress there is no end
        double worst =
            !choice.taken.empty() ? std::max(least, outside)
          : choice.singular.empty() ? -1
          : least;
        for (Index i = 0; i < n; ++i)
        {
            const double error =
                r.middleRows(first[i], first[i + 1] - first[i]).norm();
            if (usable[i] && error > worst)
            {
                worst = error;
                p = i;
            }
        }
        if (p < 0)
        {
            break;
        }
        usable[p] = 0;

        const Index k = first[p + 1] - first[p];
        Matrix v = system.W.middleCols(first[p], k);
        v.noalias() -=
            V.leftCols(columns)*V.block(first[p], 0, k, columns).transpose();
        const Eigen::LLT<Matrix> pivot(v.middleRows(first[p], k));
        const Matrix l = pivot.matrixL();
        const double scale = factor_->pivotScale(points[p].position);
        if
        (
            pivot.info() != Eigen::Success
         || !(l.diagonal().cwiseAbs2().minCoeff() > leastPivot*scale)
        )
        {
            // Nor can it be later: pivots only shrink as points are added
            choice.singular.push_back(p);
            continue;
        }

        l.transpose().triangularView<Eigen::Upper>()
            .solveInPlace<Eigen::OnTheRight>(v);
        const Matrix c =
            l.triangularView<Eigen::Lower>().solve(r.middleRows(first[p], k));
        r.noalias() -= v*c;
        V.middleCols(columns, k) = v;
        columns += k;
        choice.taken.push_back(p);
    }
    return choice;
}


void IncrementalSelection::append
(
    const std::vector<Listed>& list,
    const std::vector<Index>& chosen,
    int rank
)
{
    ControlPoints points;
    for (const Index i : chosen)
    {
        points.push_back(list[i].point);
    }

    const std::vector<bool> in = factor_->append(points);
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
        if (in[i])
        {
            take(list[chosen[i]], rank);
        }
        else
        {
            reject(list[chosen[i]], rank);
        }
    }
}


void IncrementalSelection::take(const Listed& entry, int rank)
{
    origins_.push_back({entry.rank, entry.index});
    values_.push_back(entry.point.value);
    if (entry.rank == rank)
    {
        errors_.available[entry.index] = 0;
        mine_[entry.index] = 1;
    }
}


void IncrementalSelection::reject(const Listed& entry, int rank)
{
    ++rejected_;
    if (entry.rank == rank)
    {
        errors_.available[entry.index] = 0;
    }
}


void IncrementalSelection::summarise
(
    const ControlPoints& candidates,
    Communicator& communicator,
    SelectionResult& result
)
{
    double largest = 0;
    for (const double error : errors_.norms)
    {
        largest = std::max(largest, error);
    }
    result.largestError = communicator.max(largest);
    result.candidates =
        Index(communicator.sum({double(candidates.size())})[0]);
    result.selected = origins_.size();
    result.rejected = rejected_;
    result.roundOff =
        std::numeric_limits<double>::epsilon()
       *interpolant_.weights().rowwise().norm().sum();
}

} // namespace morph
