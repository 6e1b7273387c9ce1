// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The collective operations that selection needs. Candidates stay on the rank
// that has them; what is selected is known to all.

#ifndef morph_communicator_hpp
#define morph_communicator_hpp

#include <vector>

namespace morph
{

// All operations are collective: every rank calls them in the same order, also
// a rank without points.
class Communicator
{
public:

    virtual ~Communicator() = default;

    virtual int rank() const = 0;

    virtual int size() const = 0;

    // The values of all ranks, in the order of the ranks
    virtual std::vector<double> gather(const std::vector<double>& mine) = 0;

    // The largest value of all ranks
    virtual double max(double value) = 0;

    // The sum over all ranks of each entry; the lists have one length
    virtual std::vector<double> sum(const std::vector<double>& mine) = 0;

    // How many collective operations there were, and how many bytes this rank
    // received by them
    long operations() const { return operations_; }
    double bytes() const { return bytes_; }

protected:

    void count(std::size_t values)
    {
        ++operations_;
        bytes_ += double(values*sizeof(double));
    }

private:

    long operations_ = 0;
    double bytes_ = 0;
};


// One rank
class SerialCommunicator
:
    public Communicator
{
public:

    int rank() const override { return 0; }

    int size() const override { return 1; }

    std::vector<double> gather(const std::vector<double>& mine) override
    {
        return mine;
    }

    double max(double value) override { return value; }

    std::vector<double> sum(const std::vector<double>& mine) override
    {
        return mine;
    }
};

} // namespace morph

#endif
