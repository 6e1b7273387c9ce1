// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The candidates whose errors a sweep of the selection evaluates.

#ifndef morph_workingSet_hpp
#define morph_workingSet_hpp

#include "candidateList.hpp"
#include "communicator.hpp"
#include "pointCloud.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace morph
{

// A sweep over a million candidates costs as much as all else that adds a block
// of control points, and most of them say what their neighbours say. A sample
// of them stands for all until it is met; then all are evaluated, and those
// that exceed the tolerance join the sample, until none of all does. The sample
// holds a fixed share of the candidates, each chosen by the bits of its
// position: the same whatever the distribution over the ranks.
class WorkingSet
{
public:
    WorkingSet() = default;

    // Of this rank's candidates, all of them at first. Collective
    WorkingSet(const ControlPoints& candidates, Communicator& communicator);

    // Are all candidates in it?
    bool whole() const { return whole_; }

    // Take all candidates; forget also which ones an error took in
    void takeAll() { whole_ = true; }
    void reset();

    // Take the sample for so many selected points, and the candidates whose
    // error is, or ever was, near to `least` or above. Errors of the others are
    // set to zero, so that none of them is selected. All stay in where that would
    // be too many to save time. Collective
    void sample(
        const ControlPoints& candidates, Index selected, double least,
        Errors& errors, Communicator& communicator);

    // What the set is to be met to, in tolerances: a sample alone only roughly,
    // for it is better to take the last points where the errors of all say
    double coarseness() const;

    // Enlarge a sample that is too small for so many selected points
    void grow(const ControlPoints& candidates, Index selected);

    // Positions of what is in it, and the index of each at this rank; empty: the
    // index itself
    const PointCloud& cloud() const { return whole_ ? *all_ : *part_; }
    const std::vector<Index>& indices() const
    {
        return whole_ ? none_ : indices_;
    }

private:
    // The share of all candidates, a power of 1/2, that serves for n points
    double share(Index selected) const;
    bool has(Index i) const { return taken_[i] || lots_[i] < share_; }
    void makePart(const ControlPoints& candidates);

    bool whole_ = true;
    bool alone_ = false; // a sample without any that an error took in
    double total_ = 0;   // candidates of all ranks
    double share_ = 0;
    std::shared_ptr<const PointCloud> all_;
    std::shared_ptr<const PointCloud> part_;
    std::vector<Index> indices_;
    std::vector<Index> none_;

    // Of each candidate: a number from [0, 1) that its position decides, and
    // whether an error took it into the set
    std::vector<float> lots_;
    std::vector<char> taken_;
};

} // namespace morph

#endif
