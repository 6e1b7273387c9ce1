// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "greedySelection.hpp"

#include "imageSystem.hpp"
#include "incrementalSystem.hpp"
#include "memory.hpp"
#include "polynomialNodes.hpp"
#include "schurSystem.hpp"
#include "standardSystem.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

namespace morph
{

namespace
{

// Cell size in units of the distance from the worst candidate to the selected
// points. One candidate per cell: neighbours, which one point corrects
// together, must not fill the list
constexpr double cellFraction = 0.4;

// Length of the list, per point taken from it at most
constexpr Index listFactor = 3;

// Renewed values that do not settle: the error has to halve in this many
// solutions, or the iteration ends
constexpr std::size_t patience = 8;

// What renewed values leave at selected points, in tolerances: so small that
// other candidates are within the tolerance again when a motion comes back
constexpr double settled = 0.1;

// Points taken in one go where every candidate is to be selected
constexpr Index blockOfAll = 256;


// Adds the wall time of its lifetime to a sum
class Stopwatch
{
public:
    explicit Stopwatch(double& sum)
    : sum_(sum),
      start_(std::chrono::steady_clock::now())
    {
    }

    ~Stopwatch()
    {
        sum_ += std::chrono::duration<double>(
                    std::chrono::steady_clock::now() - start_)
                    .count();
    }

private:
    double& sum_;
    std::chrono::steady_clock::time_point start_;
};

// The largest prescribed displacement of all ranks; throws on all of them if
// any of them has one that is not finite
double largestValue(const ControlPoints& candidates, Communicator& communicator)
{
    const double infinite = std::numeric_limits<double>::infinity();
    double largest = 0;
    for (const ControlPoint& p : candidates)
    {
        const bool finite = p.position.allFinite() && p.g().allFinite();
        largest = std::max(largest, finite ? p.g().norm() : infinite);
    }
    largest = communicator.max(largest);
    if (!std::isfinite(largest))
    {
        throw std::invalid_argument(
            "the position or displacement of a control point is not finite");
    }
    return largest;
}

} // namespace


const std::vector<std::pair<Algorithm, std::string>>& algorithmNames()
{
    static const std::vector<std::pair<Algorithm, std::string>> names{
        {Algorithm::incremental, "incremental"},
        {Algorithm::schur, "schur"},
        {Algorithm::standard, "standard"}};
    return names;
}


GreedySelection::GreedySelection(
    const Kernel& kernel, Polynomial polynomial,
    const SelectionSettings& settings, const ImageGroup& images)
: kernel_(kernel),
  polynomial_(polynomial),
  settings_(settings),
  images_(images),
  interpolant_(kernel)
{
    if (!(settings.tolerance >= 0) || settings.maxPoints < 1
        || settings.pointsPerSweep < 0 || !(settings.restartFraction > 0))
    {
        throw std::invalid_argument(
            "selection needs a tolerance >= 0, at least one point, and a "
            "positive restart fraction");
    }
    if (kernel.order() > 0 && polynomial == Polynomial::none)
    {
        throw std::invalid_argument(
            "a conditionally definite kernel needs a linear polynomial");
    }
    if (settings.algorithm != Algorithm::incremental
        && (polynomial != Polynomial::none || settings.all))
    {
        throw std::invalid_argument(
            "algorithms schur and standard know no polynomial and no selection "
            "of all points; algorithm incremental does");
    }
    if (!images.trivial()
        && (settings.algorithm != Algorithm::incremental
            || polynomial != Polynomial::none))
    {
        throw std::invalid_argument(
            "images of control points need algorithm incremental and no "
            "polynomial");
    }
}


void GreedySelection::setTolerances(const SelectionSettings& settings)
{
    settings_.tolerance = settings.tolerance;
    settings_.keep = settings.keep;
    settings_.roughTolerance = settings.roughTolerance;
    settings_.roughPoints = settings.roughPoints;
    settings_.roughShare = settings.roughShare;
}


Vectors GreedySelection::residuals(const ControlPoints& candidates) const
{
    Vectors r(candidates.size(), 3);
    for (std::size_t i = 0; i < candidates.size(); ++i)
    {
        const ControlPoint& p = candidates[i];
        r.row(i) = errors_.residuals.row(i).head(p.k) * p.C().transpose();
    }
    return r;
}


Vectors GreedySelection::weights(const ControlPoints& candidates) const
{
    std::map<Vector3, Index, bool (*)(const Vector3&, const Vector3&)> rowOf(
        before);
    for (Index j = 0; j < interpolant_.centres().rows(); ++j)
    {
        rowOf.emplace(interpolant_.centres().row(j).transpose(), j);
    }
    Vectors gamma = Vectors::Zero(candidates.size(), 3);
    for (const Index i : selected())
    {
        gamma.row(i) =
            interpolant_.weights().row(rowOf.at(candidates[i].position));
    }
    return gamma;
}


std::vector<Index> GreedySelection::selected() const
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


std::vector<Vector3> GreedySelection::selectedPositions() const
{
    return positions_;
}


void GreedySelection::restore(
    const std::vector<Vector3>& positions, const ControlPoints& candidates,
    Communicator& communicator)
{
    largestValue(candidates, communicator);
    std::vector<Candidate> points =
        candidatesAt(candidates, positions, communicator);

    // Those that carry the polynomial are found again
    start(candidates, communicator);
    const auto isNode = [this](const Candidate& entry)
    {
        return std::find(
                   positions_.begin(), positions_.end(), entry.point.position)
            != positions_.end();
    };
    const Index nNodes = positions_.size();
    if (nNodes > 0)
    {
        points.erase(
            std::remove_if(points.begin(), points.end(), isNode), points.end());
    }

    // Prescribed points first: then nothing is ever factorised anew
    std::stable_partition(
        points.begin(), points.end(),
        [](const Candidate& entry) { return !entry.point.slides(); });
    appendBlocks(points, communicator.rank());
    system_->solve(interpolant_);
}


void GreedySelection::appendBlocks(
    const std::vector<Candidate>& points, int rank)
{
    const std::size_t block =
        settings_.algorithm == Algorithm::incremental ? blockOfAll : 1;
    for (std::size_t i = 0; i < points.size(); i += block)
    {
        const std::vector<Candidate> list(
            points.begin() + i,
            points.begin() + std::min(points.size(), i + block));
        std::vector<Index> all(list.size());
        std::iota(all.begin(), all.end(), Index(0));
        const std::vector<bool> in = system_->append(list, all);
        for (std::size_t j = 0; j < list.size(); ++j)
        {
            if (in[j])
            {
                take(list[j], rank);
                continue;
            }

            // Several points are appended together or not at all; one by one,
            // only the singular ones are left out
            const std::vector<bool> alone = system_->append(list, {Index(j)});
            alone[0] ? take(list[j], rank) : reject(list[j], rank);
        }
    }
}


SelectionResult GreedySelection::select(
    const ControlPoints& candidates, Communicator& communicator,
    const Observer& observer)
{
    return run(candidates, communicator, Sweep(), observer);
}


SelectionResult GreedySelection::select(
    ControlPoints& candidates, Communicator& communicator,
    const Renewal& renewal, const Observer& observer)
{
    if (!renewal)
    {
        return run(candidates, communicator, Sweep(), observer);
    }
    const auto renew = [&](const Vectors& s) { renewal(s, candidates); };
    return run(candidates, communicator, renew, observer);
}


SelectionResult GreedySelection::run(
    const ControlPoints& candidates, Communicator& communicator,
    const Sweep& renew, const Observer& observer)
{
    SelectionResult result;
    result.largestDisplacement = largestValue(candidates, communicator);
    const double n = communicator.sum({double(candidates.size())})[0];

    {
        Stopwatch time(result.solveTime);
        if (!started_)
        {
            start(candidates, communicator);
        }
        else
        {
            result.keep = settings_.keep;
            refreshValues(candidates, communicator);
        }
        system_->solve(interpolant_);
    }

    const Index before = origins_.size();
    const bool renewed = bool(renew);
    updateTolerance(n, result);
    std::vector<double> history;

    set_.reset();
    if (samples(renewed) && before == 0)
    {
        std::fill(errors_.norms.begin(), errors_.norms.end(), 0.0);
        nextSet(candidates, communicator, true, result.tolerance);
    }

    // What was selected before meets the new values first
    bool settles = renewed && before > 0;
    bool more = true;
    do
    {
        {
            Stopwatch time(result.sweepTime);
            sweep(candidates, renew);
            ++result.sweeps;
            result.wholeSweeps += set_.whole();
        }
        if (observer)
        {
            result.added = Index(origins_.size()) - before;
            summarise(candidates, communicator, result);
            observer(result);
        }
        settles =
            settles && approach(candidates, communicator, history, result);
        more =
            settles || addPoints(candidates, communicator, renewed, n, result);
        if (samples(renewed))
        {
            more = nextSet(candidates, communicator, more, result.tolerance);
        }
        else if (!more && renewed)
        {
            more = approach(candidates, communicator, history, result);
        }
    } while (more);

    result.added = Index(origins_.size()) - before;
    summarise(candidates, communicator, result);
    return result;
}


bool GreedySelection::addPoints(
    const ControlPoints& candidates, Communicator& communicator, bool renewed,
    double total, SelectionResult& result)
{
    const double least =
        settings_.all ? -1 : set_.coarseness() * result.tolerance;
    std::vector<Candidate> list;
    ControlSystem::Choice choice;
    {
        Stopwatch time(result.listTime);
        double outside = 0;
        list = worstCandidate(candidates, errors_, least, communicator);
        const Index room = settings_.maxPoints - Index(origins_.size());
        if (list.empty() || room <= 0
            || list.front().error <= result.keep * least)
        {
            return false;
        }
        result.keep = 1;
        const Index most = std::min(room, pointsPerSweep());
        if (most > 1)
        {
            list = candidateList(
                candidates, errors_, least,
                settings_.all ? most : listFactor * most,
                settings_.all ? 0 : cellSize(list.front()), list.front().error,
                communicator, outside);
        }
        choice =
            system_->choose(list, most, least, settings_.all ? least : outside);
    }

    Stopwatch time(result.solveTime);
    for (const Index i : choice.singular)
    {
        reject(list[i], communicator.rank());
    }
    const std::vector<bool> in = system_->append(list, choice.taken);
    for (std::size_t i = 0; i < choice.taken.size(); ++i)
    {
        const Candidate& entry = list[choice.taken[i]];
        in[i] ? take(entry, communicator.rank())
              : reject(entry, communicator.rank());
    }
    if (renewed)
    {
        refreshValues(candidates, communicator);
    }
    system_->solve(interpolant_);
    updateTolerance(total, result);
    return true;
}


void GreedySelection::updateTolerance(
    double total, SelectionResult& result) const
{
    const Index n = origins_.size();
    result.rough = settings_.roughTolerance > settings_.tolerance
        && n > settings_.roughPoints && n > settings_.roughShare * total;
    result.tolerance = result.largestDisplacement
        * (result.rough ? settings_.roughTolerance : settings_.tolerance);
}


bool GreedySelection::approach(
    const ControlPoints& candidates, Communicator& communicator,
    std::vector<double>& history, SelectionResult& result)
{
    double largest = 0;
    for (std::size_t i = 0; i < mine_.size(); ++i)
    {
        if (mine_[i])
        {
            largest = std::max(largest, errors_.norms[i]);
        }
    }
    largest = communicator.max(largest);
    history.push_back(largest);
    const std::size_t n = history.size();
    const bool stalls =
        n > patience && largest > 0.5 * history[n - 1 - patience];
    if (largest <= settled * result.tolerance || stalls)
    {
        return false;
    }

    Stopwatch time(result.solveTime);
    ++result.renewals;
    refreshValues(candidates, communicator);
    system_->solve(interpolant_);
    return true;
}


void GreedySelection::start(
    const ControlPoints& candidates, Communicator& communicator)
{
    origins_.clear();
    positions_.clear();
    values_.clear();
    rejected_ = 0;
    const Index n = candidates.size();
    set_ = WorkingSet(candidates, communicator);
    errors_.residuals.resize(n, 3);
    errors_.norms.assign(n, 0);
    errors_.available.assign(n, 1);
    mine_.assign(n, 0);

    makeSystem(candidates, communicator);
    started_ = true;
}


void GreedySelection::makeSystem(
    const ControlPoints& candidates, Communicator& communicator)
{
    switch (settings_.algorithm)
    {
    case Algorithm::standard:
        system_.reset(new StandardSystem(kernel_));
        return;

    case Algorithm::schur:
        system_.reset(new SchurSystem(
            kernel_, settings_.restartFraction, candidates, communicator));
        return;

    case Algorithm::incremental:
        break;
    }

    if (settings_.all)
    {
        // Every rank has the whole factor
        const double n = communicator.sum({double(candidates.size())})[0];
        const double rows = images_.trivial() ? n : 3 * n;
        requireMemory(
            8 * rows * rows,
            "the system of all " + std::to_string(Index(n))
                + " control points, by 'selection all',",
            communicator);
    }

    if (!images_.trivial())
    {
        system_.reset(new ImageSystem(kernel_, images_));
        return;
    }

    std::vector<Candidate> nodes;
    if (polynomial_ == Polynomial::linear)
    {
        nodes = polynomialNodes(
            kernel_, candidates, settings_.maxPoints, communicator);
    }
    Matrix values(nodes.size(), 3);
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
        take(nodes[i], communicator.rank());
        values.row(i) = nodes[i].point.value.transpose();
    }
    system_.reset(new IncrementalSystem(kernel_, positions(nodes), values));
}


std::vector<Vector3> GreedySelection::selectedValues(
    const ControlPoints& candidates, Communicator& communicator) const
{
    std::vector<double> v(3 * origins_.size(), 0.0);
    for (std::size_t i = 0; i < origins_.size(); ++i)
    {
        if (origins_[i].rank == communicator.rank())
        {
            const Vector3& value = candidates[origins_[i].index].value;
            std::copy(value.data(), value.data() + 3, &v[3 * i]);
        }
    }
    v = communicator.sum(v);
    std::vector<Vector3> values(origins_.size());
    for (std::size_t i = 0; i < origins_.size(); ++i)
    {
        values[i] = Eigen::Map<const Vector3>(&v[3 * i]);
    }
    return values;
}


void GreedySelection::refreshValues(
    const ControlPoints& candidates, Communicator& communicator)
{
    values_ = selectedValues(candidates, communicator);
    system_->setValues(values_);
}


std::vector<RbfInterpolant> GreedySelection::interpolants(
    const std::vector<ControlPoints>& sets, Communicator& communicator)
{
    std::vector<RbfInterpolant> result;
    for (const ControlPoints& candidates : sets)
    {
        system_->setValues(selectedValues(candidates, communicator));
        result.emplace_back(kernel_);
        system_->solve(result.back());
    }
    system_->setValues(values_);
    return result;
}


void GreedySelection::sweep(const ControlPoints& candidates, const Sweep& renew)
{
    const Vectors s = system_->evaluate(interpolant_, set_.cloud());
    if (renew)
    {
        renew(s);
    }
    const std::vector<Index>& indices = set_.indices();
    for (Index j = 0; j < s.rows(); ++j)
    {
        const Index i = indices.empty() ? j : indices[j];
        const Vector3 r = candidates[i].residual(s.row(j).transpose());
        errors_.residuals.row(i) = r.transpose();
        errors_.norms[i] = r.norm();
    }
}


bool GreedySelection::samples(bool renewed) const
{
    // Renewed values follow from the displacement of every candidate; and what
    // is there for comparison is to do what its paper says
    return !renewed && !settings_.all
        && settings_.algorithm == Algorithm::incremental;
}


bool GreedySelection::nextSet(
    const ControlPoints& candidates, Communicator& communicator, bool added,
    double tolerance)
{
    if (!added)
    {
        // The sample is met: are all?
        const bool more = !set_.whole();
        set_.takeAll();
        return more;
    }
    if (set_.whole())
    {
        set_.sample(
            candidates, origins_.size(), tolerance, errors_, communicator);
    }
    else
    {
        set_.grow(candidates, origins_.size());
    }
    return true;
}


Index GreedySelection::pointsPerSweep() const
{
    if (settings_.algorithm != Algorithm::incremental)
    {
        return 1;
    }
    if (settings_.all)
    {
        return blockOfAll;
    }
    if (settings_.pointsPerSweep > 0)
    {
        return settings_.pointsPerSweep;
    }

    // A tenth of the points selected so far; less for many points, since the
    // work on a list grows with its square and would exceed that of a sweep
    const Index n = origins_.size();
    return std::max<Index>(4, std::min(n / 10, 25 + n / 20));
}


double GreedySelection::cellSize(const Candidate& worst) const
{
    double nearest = kernel_.supportRadius();
    const Columns& x = interpolant_.centres();
    if (x.rows() > 0)
    {
        nearest = std::sqrt((x.rowwise() - worst.point.position.transpose())
                                .rowwise()
                                .squaredNorm()
                                .minCoeff());
    }
    return cellFraction * nearest;
}


void GreedySelection::take(const Candidate& entry, int rank)
{
    origins_.push_back({entry.rank, entry.index});
    positions_.push_back(entry.point.position);
    values_.push_back(entry.point.value);
    if (entry.rank == rank)
    {
        errors_.available[entry.index] = 0;
        mine_[entry.index] = 1;
    }
}


void GreedySelection::reject(const Candidate& entry, int rank)
{
    ++rejected_;
    if (entry.rank == rank)
    {
        errors_.available[entry.index] = 0;
    }
}


void GreedySelection::summarise(
    const ControlPoints& candidates, Communicator& communicator,
    SelectionResult& result) const
{
    double largest = 0;
    for (const double error : errors_.norms)
    {
        largest = std::max(largest, error);
    }
    result.largestError = communicator.max(largest);
    result.candidates = Index(communicator.sum({double(candidates.size())})[0]);
    result.selected = origins_.size();
    result.rejected = rejected_;
    result.roundOff = std::numeric_limits<double>::epsilon()
        * interpolant_.weights().rowwise().norm().sum();
}

} // namespace morph
