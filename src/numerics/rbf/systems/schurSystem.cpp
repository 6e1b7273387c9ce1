// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "schurSystem.hpp"

#include "kernelSum.hpp"
#include "memory.hpp"
#include "referenceSystem.hpp"

#include <Eigen/Dense>

namespace morph
{

SchurSystem::SchurSystem(
    const Kernel& kernel, double restartFraction,
    const ControlPoints& candidates, Communicator& communicator)
: kernel_(kernel),
  restartFraction_(restartFraction)
{
    const std::vector<double> sizes =
        communicator.gather({double(candidates.size())});
    firstOfRank_.assign(1, 0);
    for (const double n : sizes)
    {
        firstOfRank_.push_back(firstOfRank_.back() + Index(n));
    }
    const Index all = firstOfRank_.back();

    requireMemory(
        8.0 * double(all) * double(candidates.size()),
        "the matrix of all pairs of " + std::to_string(all)
            + " control points, which algorithm schur assembles,",
        communicator);

    const Columns mine = positions(candidates);
    const std::vector<double> x = communicator.gather(
        std::vector<double>(mine.data(), mine.data() + mine.size()));
    Columns others(all, 3);
    for (std::size_t r = 0; r < sizes.size(); ++r)
    {
        const Index n = Index(sizes[r]);
        others.middleRows(firstOfRank_[r], n) =
            Eigen::Map<const Columns>(&x[3 * firstOfRank_[r]], n, 3);
    }
    phi_ = kernelMatrix(kernel, mine, others);
}


std::vector<bool> SchurSystem::append(
    const std::vector<Candidate>& list, const std::vector<Index>& chosen)
{
    std::vector<bool> in;
    for (const Index i : chosen)
    {
        const Candidate& entry = list[i];
        added_.push_back(entry.point);
        const bool solved = solveBlocks();
        in.push_back(solved);
        if (!solved)
        {
            added_.pop_back();
            solveBlocks();
            continue;
        }
        column_.push_back(firstOfRank_[entry.rank] + entry.index);
        if (double(added_.size()) >= restartFraction_ * double(kept_.size()))
        {
            restart();
        }
    }
    return in;
}


bool SchurSystem::restart()
{
    ControlPoints all(kept_);
    all.insert(all.end(), added_.begin(), added_.end());
    if (all.empty())
    {
        return true;
    }
    const Eigen::PartialPivLU<Matrix> lu(
        referenceSystem(kernel_, all, all, true));
    if (singular(lu))
    {
        // Nearly so: the blocks, which could be solved, stay
        return false;
    }
    lu_ = lu;
    kept_ = all;
    added_.clear();
    keptAlone_ = lu_.solve(paperValues(kept_));
    gamma_ = keptAlone_;
    return true;
}


bool SchurSystem::solveBlocks()
{
    if (added_.empty())
    {
        gamma_ = keptAlone_;
        return true;
    }
    const Matrix own = referenceSystem(kernel_, added_, added_, true);
    if (kept_.empty())
    {
        const Eigen::PartialPivLU<Matrix> lu(own);
        if (singular(lu))
        {
            return false;
        }
        gamma_ = lu.solve(paperValues(added_));
        return true;
    }

    // (24)-(29)
    const Matrix down = referenceSystem(kernel_, added_, kept_, false);
    const Matrix across = referenceSystem(kernel_, kept_, added_, false);
    const Matrix M = lu_.solve(across);
    const Eigen::PartialPivLU<Matrix> schur(own - down * M);
    if (singular(schur))
    {
        return false;
    }
    const Matrix gammaA = schur.solve(paperValues(added_) - down * keptAlone_);
    const Matrix gammaG = lu_.solve(paperValues(kept_) - across * gammaA);

    gamma_.resize(gammaG.rows() + gammaA.rows(), 1);
    gamma_ << gammaG, gammaA;
    return true;
}


void SchurSystem::setValues(const std::vector<Vector3>& values)
{
    for (std::size_t i = 0; i < values.size(); ++i)
    {
        const std::size_t n = kept_.size();
        (i < n ? kept_[i] : added_[i - n]).value = values[i];
    }
    if (!kept_.empty())
    {
        keptAlone_ = lu_.solve(paperValues(kept_));
    }
    solveBlocks();
}


void SchurSystem::solve(RbfInterpolant& interpolant)
{
    ControlPoints all(kept_);
    all.insert(all.end(), added_.begin(), added_.end());
    interpolant.set(positions(all), paperWeights(gamma_));
}


Vectors SchurSystem::evaluate(
    const RbfInterpolant& interpolant, const PointCloud&) const
{
    // The columns of Phi^c that belong to what is selected, times the weights
    Columns s = Columns::Zero(phi_.rows(), 3);
    for (std::size_t j = 0; j < column_.size(); ++j)
    {
        s.noalias() += phi_.col(column_[j]) * interpolant.weights().row(j);
    }
    return s;
}

} // namespace morph
