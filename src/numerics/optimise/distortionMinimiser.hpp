// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Moves the points of a mesh so that the distortion of its cells gets less, and
// folded cells unfold: L-BFGS (Nocedal 1980, doi:10.1090/S0025-5718-1980-0572855-7),
// preconditioned by the Laplacian of the mesh's edges.

#ifndef morph_distortionMinimiser_hpp
#define morph_distortionMinimiser_hpp

#include "edgeLaplacian.hpp"
#include "simplexMesh.hpp"

#include <deque>
#include <functional>
#include <vector>

namespace morph
{

// What points may do. All are collective
class PointMotion
{
public:
    virtual ~PointMotion() = default;

    // Give points of other ranks the values that they have there
    virtual void exchange(Vectors& v) = 0;

    // May a point move at all?
    virtual std::vector<bool> free() = 0;

    // Of vectors on the points of this rank, what is left for motion: an
    // orthogonal projection
    virtual void project(const Vectors& x, Vectors& v) = 0;

    // Put points where they may be: of this rank and, after, of others
    virtual void retract(Vectors& x) = 0;
};


class DistortionMinimiser
{
public:
    // Keeps references
    DistortionMinimiser(
        const SimplexMesh& mesh, PointMotion& motion,
        Communicator& communicator);

    struct Stage
    {
        int power = 1;
        double sizeWeight = 1;
        int iterations = 100;
    };

    struct Progress
    {
        int iteration;

        // Mean distortion of a simplex, and the smallest D
        double distortion;
        double leastDeterminant;
    };

    using Report = std::function<void(const Progress&)>;

    // Fewer iterations where it converges earlier; returns how many. Collective
    int run(const Stage& stage, Vectors& x, const Report& report);

    // Energy and derivative were evaluated so often
    int evaluations() const { return evaluations_; }

private:
    struct Pair
    {
        Vectors s;
        Vectors y;
        double sy;
    };

    double dot(const Vectors& a, const Vectors& b);
    double epsilonSquared(double leastDeterminant) const;
    void evaluate(const Vectors& x, SimplexMesh::Result& result);
    void soften(const Vectors& x, SimplexMesh::Result& result);
    void precondition(const Vectors& x);
    Vectors direction(const Vectors& x, const Vectors& gradient);

    // Along d; false where nothing gets better
    bool search(
        const Vectors& d, double slope, Vectors& x,
        SimplexMesh::Result& result);

    const SimplexMesh& mesh_;
    PointMotion& motion_;
    Communicator& communicator_;
    EdgeLaplacian laplacian_;
    SimplexMesh::Settings settings_;
    std::deque<Pair> pairs_;
    double nSimplices_;
    int evaluations_ = 0;
};

} // namespace morph

#endif
