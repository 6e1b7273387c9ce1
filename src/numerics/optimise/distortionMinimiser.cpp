// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "distortionMinimiser.hpp"

#include "reproducibleSum.hpp"

#include <algorithm>
#include <cmath>

namespace morph
{

namespace
{

// Pairs that L-BFGS keeps
const std::size_t memory = 8;

// The Laplacian follows the stiffness of the cells after so many iterations
const int renewal = 25;

// Armijo's constant, and most halvings of a step
const double enough = 1e-4;
const int halvings = 16;

// Converged where so many iterations win less than this share
const int patience = 10;
const double little = 1e-5;

// A derivative so small against the stiffness is round-off
const double roundOff = 1e-11;

} // namespace


DistortionMinimiser::DistortionMinimiser(
    const SimplexMesh& mesh, PointMotion& motion, Communicator& communicator)
: mesh_(mesh),
  motion_(motion),
  communicator_(communicator),
  laplacian_(
      mesh, motion.free(), [&motion](Vectors& v) { motion.exchange(v); }),
  nSimplices_(communicator.sum({double(mesh.nSimplices())})[0])
{
}


double DistortionMinimiser::dot(const Vectors& a, const Vectors& b)
{
    return reproducibleDot(
        a.data(), b.data(), 3 * mesh_.nOwned(), communicator_);
}


double DistortionMinimiser::epsilonSquared(double leastDeterminant) const
{
    const double folded = std::min(leastDeterminant, 0.0);
    return 1e-12 + 0.04 * folded * folded;
}


void DistortionMinimiser::evaluate(
    const Vectors& x, SimplexMesh::Result& result)
{
    mesh_.evaluate(x, settings_, communicator_, result);
    ++evaluations_;
}


// As much as the worst simplex needs
void DistortionMinimiser::soften(const Vectors& x, SimplexMesh::Result& result)
{
    const double now = epsilonSquared(result.leastDeterminant);
    if (now != settings_.simplex.epsilonSquared)
    {
        settings_.simplex.epsilonSquared = now;
        evaluate(x, result);
    }
}


void DistortionMinimiser::precondition(const Vectors& x)
{
    laplacian_.setStiffness(mesh_.cellState(x, settings_).stiffness);
    pairs_.clear();
}


Vectors
DistortionMinimiser::direction(const Vectors& x, const Vectors& gradient)
{
    Vectors q = gradient;
    std::vector<double> alpha(pairs_.size());
    for (std::size_t i = pairs_.size(); i-- > 0;)
    {
        alpha[i] = dot(pairs_[i].s, q) / pairs_[i].sy;
        q -= alpha[i] * pairs_[i].y;
    }
    laplacian_.solve(q);
    motion_.project(x, q);
    q.conservativeResize(mesh_.nOwned(), 3);
    for (std::size_t i = 0; i < pairs_.size(); ++i)
    {
        const double beta = dot(pairs_[i].y, q) / pairs_[i].sy;
        q += (alpha[i] - beta) * pairs_[i].s;
    }
    return -q;
}


bool DistortionMinimiser::search(
    const Vectors& d, double slope, Vectors& x, SimplexMesh::Result& result)
{
    const double former = result.distortion;
    double part = 1;
    Vectors next(x.rows(), 3);
    SimplexMesh::Result found;
    for (int i = 0; i < halvings; ++i)
    {
        next = x;
        next.topRows(mesh_.nOwned()) += part * d;
        motion_.exchange(next);
        motion_.retract(next);
        evaluate(next, found);
        if (found.distortion <= former + enough * part * slope)
        {
            x.swap(next);
            std::swap(result, found);
            return true;
        }
        part *= 0.5;
    }
    return false;
}


int DistortionMinimiser::run(
    const Stage& stage, Vectors& x, const Report& report)
{
    settings_.power = stage.power;
    settings_.simplex.sizeWeight = stage.sizeWeight;
    SimplexMesh::Result result;
    settings_.simplex.epsilonSquared = epsilonSquared(0);
    evaluate(x, result);
    soften(x, result);
    precondition(x);
    Vectors gradient = result.derivative;
    motion_.project(x, gradient);
    std::vector<double> history;

    int sinceRenewal = 0;
    int iteration = 0;
    for (; iteration < stage.iterations; ++iteration)
    {
        report(
            {iteration, result.distortion / nSimplices_,
             result.leastDeterminant});
        history.push_back(result.distortion);
        const std::size_t n = history.size();
        const bool still = n > std::size_t(patience)
            && history[n - 1 - patience] - history[n - 1]
                < little * history[n - 1];
        if (still && result.leastDeterminant > 0)
        {
            break;
        }

        Vectors d = direction(x, gradient);
        double slope = dot(d, gradient);
        if (!(slope < 0) && !pairs_.empty())
        {
            pairs_.clear();
            d = direction(x, gradient);
            slope = dot(d, gradient);
        }

        // The square of a length in cells
        if (!(-slope > roundOff * roundOff * result.distortion))
        {
            break;
        }

        const Vectors before = x.topRows(mesh_.nOwned());
        if (!search(d, slope, x, result))
        {
            if (sinceRenewal == 0)
            {
                break;
            }
            precondition(x);
            sinceRenewal = 0;
            continue;
        }

        Vectors next = result.derivative;
        motion_.project(x, next);
        Pair pair{x.topRows(mesh_.nOwned()) - before, next - gradient, 0};
        pair.sy = dot(pair.s, pair.y);
        if (pair.sy > 1e-14 * std::abs(slope))
        {
            pairs_.push_back(std::move(pair));
        }
        if (pairs_.size() > memory)
        {
            pairs_.pop_front();
        }

        // A softer energy, or a new Laplacian, is another problem
        const double epsilon = epsilonSquared(result.leastDeterminant);
        const double former = settings_.simplex.epsilonSquared;
        if (epsilon < 0.5 * former || epsilon > 2 * former)
        {
            soften(x, result);
            next = result.derivative;
            motion_.project(x, next);
            history.clear();
            precondition(x);
            sinceRenewal = 0;
        }
        else if (++sinceRenewal >= renewal)
        {
            precondition(x);
            sinceRenewal = 0;
        }
        gradient.swap(next);
    }
    return iteration;
}

} // namespace morph
