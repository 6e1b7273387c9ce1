// Selection of the control points that carry an interpolant.

#ifndef morph_greedySelection_hpp
#define morph_greedySelection_hpp

#include "communicator.hpp"
#include "controlPoints.hpp"
#include "kernel.hpp"
#include "rbfInterpolant.hpp"

#include <memory>

namespace morph
{

enum class Polynomial
{
    none,
    linear
};

struct SelectionSettings
{
    // Largest error allowed, as a fraction of the largest prescribed
    // displacement of all candidates
    double tolerance = 1e-5;

    // Most points to select
    Index maxPoints = std::numeric_limits<Index>::max();

    // Points appended in one sweep over the candidates; 0: as many as pay
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

    // Expected round-off in the interpolated displacement,
    // machine epsilon x sum |gamma| [m]
    double roundOff = 0;

    // Points that were added by this call, and sweeps over the candidates
    Index added = 0;
    Index sweeps = 0;

    // Wall time of this rank [s]: evaluation of the candidates, choice of
    // points, and linear algebra
    double sweepTime = 0;
    double listTime = 0;
    double solveTime = 0;

    bool converged() const { return largestError <= tolerance; }
};


// A way to choose control points from candidates that are spread over the
// ranks, and to find their weights. What is selected, and the weights, are the
// same on every rank and for every distribution of the candidates.
class GreedySelection
{
public:

    virtual ~GreedySelection() = default;

    // Selects until every candidate, at whose position the interpolant should
    // meet C^T s = g, does so within the tolerance.
    //
    // candidates: those of this rank. Called again, they must be the same but
    // for their values g: then what is selected stays so, and points are added
    // only where the error exceeds the tolerance.
    //
    // Throws std::invalid_argument where the candidates cannot carry the
    // polynomial asked for.
    virtual SelectionResult select
    (
        const ControlPoints& candidates,
        Communicator& communicator
    ) = 0;

    // The outcome of the last selection
    virtual const RbfInterpolant& interpolant() const = 0;

    // |C^T s - g| of this rank's candidates after the last selection [m]
    virtual const std::vector<double>& errors() const = 0;

    // Indices of this rank's candidates that are selected
    virtual std::vector<Index> selected() const = 0;
};

} // namespace morph

#endif
