// Greedy selection on a factorisation that grows.

#ifndef morph_incrementalSelection_hpp
#define morph_incrementalSelection_hpp

#include "candidateList.hpp"
#include "gramFactor.hpp"
#include "greedySelection.hpp"

namespace morph
{

// One point a sweep gives the set of the standard greedy algorithm (Aubert et
// al. 2017, doi:10.1016/j.proeng.2017.09.819): the candidate with the largest
// error is added until none exceeds the tolerance. In blocks, a sweep makes a
// short list of bad candidates and runs that algorithm on the list alone, with
// the Schur complement of the list (GramFactor::residual) in place of the
// system: a point chosen there takes its influence on the others of the list
// with it, so that about as many points are selected in a tenth of the sweeps.
//
// Errors are evaluated from the weights in every sweep and never updated:
// updated residuals drift and report convergence that is not there.
class IncrementalSelection
:
    public GreedySelection
{
public:

    IncrementalSelection
    (
        const Kernel& kernel,
        Polynomial polynomial,
        const SelectionSettings& settings
    );

    SelectionResult select
    (
        const ControlPoints& candidates,
        Communicator& communicator
    ) override;

    const RbfInterpolant& interpolant() const override { return interpolant_; }

    const std::vector<double>& errors() const override
    {
        return errors_.norms;
    }

    std::vector<Index> selected() const override;

private:

    // Where a selected point lives
    struct Origin
    {
        int rank;
        Index index;
    };

    // Indices into a list of candidates
    struct Choice
    {
        std::vector<Index> taken;
        std::vector<Index> singular;
    };

    void start(const ControlPoints& candidates, Communicator& communicator);
    void chooseNodes(const ControlPoints& candidates, Communicator& c);
    void refreshValues(const ControlPoints& candidates, Communicator& c);
    Matrix nodeValues() const;
    void sweep(const ControlPoints& candidates);
    Index listLength() const;
    double cellSize(const Listed& worst) const;
    Choice choose
    (
        const std::vector<Listed>& list,
        Index most,
        double least,
        double outside
    );
    void append
    (
        const std::vector<Listed>& list,
        const std::vector<Index>& chosen,
        int rank
    );
    void take(const Listed& entry, int rank);
    void reject(const Listed& entry, int rank);
    void summarise
    (
        const ControlPoints& candidates,
        Communicator& communicator,
        SelectionResult& result
    );

    Kernel kernel_;
    Polynomial polynomial_;
    SelectionSettings settings_;

    bool started_ = false;
    std::unique_ptr<PointCloud> cloud_;
    std::unique_ptr<GramFactor> factor_;
    RbfInterpolant interpolant_;

    // Nodes of the polynomial first, then the points in the factor
    Index nNodes_ = 0;
    std::vector<Origin> origins_;
    std::vector<Vector3> values_;

    Errors errors_;
    std::vector<char> mine_;
    Index rejected_ = 0;
};

} // namespace morph

#endif
