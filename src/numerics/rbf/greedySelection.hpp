// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Selection of the control points that carry an interpolant.

#ifndef morph_greedySelection_hpp
#define morph_greedySelection_hpp

#include "controlSystem.hpp"
#include "imageGroup.hpp"
#include "kernel.hpp"
#include "rbfInterpolant.hpp"
#include "workingSet.hpp"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace morph
{

enum class Polynomial
{
    none,
    linear
};

enum class Algorithm
{
    incremental,
    schur,
    standard
};

// All algorithms, in the order of the enumeration, with the names users type
const std::vector<std::pair<Algorithm, std::string>>& algorithmNames();

struct SelectionSettings
{
    Algorithm algorithm = Algorithm::incremental;

    // Largest error allowed, as a fraction of the largest prescribed
    // displacement of all candidates
    double tolerance = 1e-5;

    // A selection that is kept from before grows only where an error exceeds
    // so many tolerances, and then to the tolerance: values that change a
    // little do not add points in each step
    double keep = 1;

    // Of a rough field, which most candidates would have to carry: once more
    // than this number and this share of the candidates are selected, the
    // tolerance is the rough one, if that is larger
    double roughTolerance = 0;
    Index roughPoints = 0;
    double roughShare = 1;

    // Most points to select
    Index maxPoints = std::numeric_limits<Index>::max();

    // Of algorithm schur: N_res as a fraction of the current subset
    double restartFraction = 0.1;

    // Of algorithm incremental: points appended in one sweep over the
    // candidates; 0: as many as pay. The other algorithms append one
    Index pointsPerSweep = 0;

    // Take every candidate, whatever its error
    bool all = false;
};

struct SelectionResult
{
    // Of all ranks
    Index candidates = 0;
    Index selected = 0;

    // Candidates that cannot be selected because the system would be singular
    // to round-off with them; their errors count in largestError
    Index rejected = 0;

    // [m]
    double largestDisplacement = 0;
    double largestError = 0;
    double tolerance = 0;

    // Is it the rough one?
    bool rough = false;

    // Expected round-off in the interpolated displacement,
    // machine epsilon x sum |gamma| [m]
    double roundOff = 0;

    // Points that were added by this call, sweeps, those of them that were over
    // all candidates and not a sample (workingSet.hpp), and how often the system
    // was solved again for renewed values alone
    Index added = 0;
    Index renewals = 0;
    Index sweeps = 0;
    Index wholeSweeps = 0;

    // Wall time of this rank [s]: evaluation of the candidates, choice of
    // points, and linear algebra
    double sweepTime = 0;
    double listTime = 0;
    double solveTime = 0;

    // Tolerances that the error may reach before points are added
    double keep = 1;

    bool converged() const { return largestError <= keep * tolerance; }
};


// Chooses control points from candidates that are spread over the ranks, and
// finds their weights: the candidate with the largest error is added until none
// exceeds the tolerance. The algorithms differ in how they solve the system
// (standardSystem.hpp, schurSystem.hpp, incrementalSystem.hpp); the last can
// take points in blocks. What is selected, and the weights, are the same on
// every rank and for every distribution of the candidates.
//
// Errors are evaluated from the weights in every sweep and never updated:
// updated residuals drift and report convergence that is not there.
class GreedySelection
{
public:
    // Called after every sweep with the result so far; its largest error is
    // that of the candidates in the sweep
    using Observer = std::function<void(const SelectionResult&)>;

    // Given the displacements (n x 3) at this rank's candidates after a sweep,
    // sets new values g of those candidates for which they follow from where
    // the point has got to, as on a curved surface (slidingCondition.hpp)
    using Renewal = std::function<void(const Vectors&, ControlPoints&)>;

    // images: of the control points, which have to be restricted to what the
    // group allows; for algorithm incremental without a polynomial alone.
    // Throws std::invalid_argument for settings that contradict each other
    GreedySelection(
        const Kernel& kernel, Polynomial polynomial,
        const SelectionSettings& settings,
        const ImageGroup& images = ImageGroup());

    // Selects until every candidate, at whose position the interpolant should
    // meet C^T s = g, does so within the tolerance.
    //
    // candidates: those of this rank. Called again, they must be the same but
    // for their values g: then what is selected stays so, and points are added
    // only where the error exceeds the tolerance.
    //
    // Throws std::invalid_argument where a value is not finite or the candidates
    // cannot carry the polynomial asked for, std::runtime_error where memory
    // does not suffice; on all ranks alike.
    //
    // An observer must be given on all ranks or on none.
    SelectionResult select(
        const ControlPoints& candidates, Communicator& communicator,
        const Observer& observer = Observer());

    // The same for values that depend on the displacement: ends when, with the
    // values renewed after every sweep, no error of any candidate, selected or
    // not, exceeds the tolerance; or when it does not get smaller any more. The
    // tolerance is of the values that the candidates have at the start.
    //
    // The renewal must be given on all ranks or on none
    SelectionResult select(
        ControlPoints& candidates, Communicator& communicator,
        const Renewal& renewal, const Observer& observer = Observer());

    // Positions of the selected points in the order of the system, the same on
    // every rank
    std::vector<Vector3> selectedPositions() const;

    // Makes the system anew with the points at the given positions, each that
    // of a candidate, and nothing else, and solves it. Which points there are
    // and in which order decides every bit of the result; not how they were
    // selected, nor the distribution of the candidates. Hence
    // restore(selectedPositions()) brings a selection into the state that a
    // new one has after restore() with the same positions.
    //
    // Throws as select() does, and std::invalid_argument where there is no
    // candidate at a position; on all ranks alike. Collective.
    void restore(
        const std::vector<Vector3>& positions, const ControlPoints& candidates,
        Communicator& communicator);

    // Of selections to come. Tolerances alone may differ from those before
    void setTolerances(const SelectionSettings& settings);

    // The outcome of the last selection
    const RbfInterpolant& interpolant() const { return interpolant_; }

    // Interpolants of other values of the same candidates, several sets of
    // them, by the points that are selected and the factors that are there. As
    // the interpolant is linear in the values, with their derivatives it is the
    // derivative. Collective.
    std::vector<RbfInterpolant> interpolants(
        const std::vector<ControlPoints>& sets, Communicator& communicator);

    // |C^T s - g| of this rank's candidates after the last selection [m]
    const std::vector<double>& errors() const { return errors_.norms; }

    // C (g - C^T s) of this rank's candidates, which must be those of the last
    // selection: n x 3 [m]
    Vectors residuals(const ControlPoints& candidates) const;

    // gamma of this rank's candidates, zero for those not selected: n x 3 [m]
    Vectors weights(const ControlPoints& candidates) const;

    // Indices of this rank's candidates that are selected
    std::vector<Index> selected() const;

private:
    // Where a selected point lives
    struct Origin
    {
        int rank;
        Index index;
    };

    // Called between the displacements of a sweep and its errors
    using Sweep = std::function<void(const Vectors&)>;

    SelectionResult
    run(const ControlPoints& candidates, Communicator& communicator,
        const Sweep& renew, const Observer& observer);
    void start(const ControlPoints& candidates, Communicator& communicator);
    void makeSystem(const ControlPoints& candidates, Communicator& c);
    std::vector<Vector3>
    selectedValues(const ControlPoints& candidates, Communicator& c) const;
    void refreshValues(const ControlPoints& candidates, Communicator& c);
    void sweep(const ControlPoints& candidates, const Sweep& renew);
    bool samples(bool renewed) const;
    bool nextSet(
        const ControlPoints& candidates, Communicator& communicator, bool added,
        double tolerance);
    // total: of the candidates of all ranks
    void updateTolerance(double total, SelectionResult& result) const;
    void appendBlocks(const std::vector<Candidate>& points, int rank);
    bool addPoints(
        const ControlPoints& candidates, Communicator& communicator,
        bool renewed, double total, SelectionResult& result);
    bool approach(
        const ControlPoints& candidates, Communicator& communicator,
        std::vector<double>& history, SelectionResult& result);
    Index pointsPerSweep() const;
    double cellSize(const Candidate& worst) const;
    void take(const Candidate& entry, int rank);
    void reject(const Candidate& entry, int rank);
    void summarise(
        const ControlPoints& candidates, Communicator& communicator,
        SelectionResult& result) const;

    Kernel kernel_;
    Polynomial polynomial_;
    SelectionSettings settings_;
    ImageGroup images_;

    bool started_ = false;
    WorkingSet set_;
    std::unique_ptr<ControlSystem> system_;
    RbfInterpolant interpolant_;

    // What is selected, in the order of the system
    std::vector<Origin> origins_;
    std::vector<Vector3> positions_;
    std::vector<Vector3> values_;

    Errors errors_;
    std::vector<char> mine_;
    Index rejected_ = 0;
};

} // namespace morph

#endif
