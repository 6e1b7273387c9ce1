// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Selections that sweep a sample of many candidates: the tolerance is that of
// every candidate, whatever the sample.

#include "test_support.hpp"

#include <cmath>

using namespace test;

namespace
{

ControlPoints waved(ControlPoints points)
{
    for (ControlPoint& p : points)
    {
        const Vector3& x = p.position;
        const Vector3 s(
            std::sin(5 * x.x()), std::cos(4 * x.y()), x.x() * x.y());
        p.value.head(p.k) = p.C().transpose() * s;
    }
    return points;
}


// |C^T s - g| by the interpolant, which does not know what was swept
double largestError(const GreedySelection& selection, const ControlPoints& x)
{
    const Vectors s = selection.interpolant()(positionRows(x));
    double largest = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
    {
        const Vector3 r = x[i].residual(s.row(i).transpose());
        largest = std::max(largest, r.head(x[i].k).norm());
    }
    return largest;
}

} // namespace


TEST(WorkingSet, everyCandidateIsMetBySweepsOverFewOfThem)
{
    const ControlPoints points = waved(manyControlPoints());
    SerialCommunicator communicator;
    SelectionSettings settings;
    settings.tolerance = 1e-3;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settings);
    const SelectionResult result = selection.select(points, communicator);

    EXPECT_TRUE(result.converged());
    EXPECT_LE(largestError(selection, points), result.tolerance * (1 + 1e-9));
    EXPECT_GE(result.wholeSweeps, 1);
    EXPECT_LT(3 * result.wholeSweeps, result.sweeps);
}


TEST(WorkingSet, candidatesUnlikeTheirNeighboursAreFound)
{
    ControlPoints points = waved(manyControlPoints());
    for (std::size_t i = 400; i < points.size(); i += 4001)
    {
        points[i] = ControlPoint::prescribed(
            points[i].position, Vector3(1.1, -0.3, 0.7));
    }
    SerialCommunicator communicator;
    SelectionSettings settings;
    settings.tolerance = 5e-2;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 0.1), Polynomial::none, settings);
    const SelectionResult result = selection.select(points, communicator);

    EXPECT_TRUE(result.converged());
    EXPECT_LE(largestError(selection, points), result.tolerance * (1 + 1e-9));
    EXPECT_GT(result.wholeSweeps, 1);
}


TEST(WorkingSet, otherValuesOfTheSameCandidatesAreMet)
{
    ControlPoints points = waved(manyControlPoints());
    SerialCommunicator communicator;
    SelectionSettings settings;
    settings.tolerance = 1e-3;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settings);
    selection.select(points, communicator);

    // Of twice the displacement nothing is to be added, and one sweep says so
    for (ControlPoint& p : points)
    {
        p.value *= 2;
    }
    const SelectionResult again = selection.select(points, communicator);
    EXPECT_EQ(again.added, 0);
    EXPECT_EQ(again.sweeps, 1);
    EXPECT_TRUE(again.converged());

    for (ControlPoint& p : points)
    {
        p.value.head(p.k) =
            p.C().transpose() * Vector3(0, 0, std::sin(9 * p.position.x()));
    }
    const SelectionResult other = selection.select(points, communicator);
    EXPECT_GT(other.added, 0);
    EXPECT_TRUE(other.converged());
    EXPECT_LE(largestError(selection, points), other.tolerance * (1 + 1e-9));
}


TEST(WorkingSet, theMostPointsAreNotExceeded)
{
    const ControlPoints points = waved(manyControlPoints());
    SerialCommunicator communicator;
    SelectionSettings settings;
    settings.tolerance = 1e-6;
    settings.maxPoints = 50;
    GreedySelection selection(
        Kernel(KernelType::wendlandC2, 0.8), Polynomial::none, settings);
    const SelectionResult result = selection.select(points, communicator);

    // The error that is reported is that of all candidates
    EXPECT_EQ(result.selected, 50);
    EXPECT_FALSE(result.converged());
    EXPECT_NEAR(
        largestError(selection, points), result.largestError,
        1e-9 * result.largestError);
}
