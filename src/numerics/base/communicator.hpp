// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// The collective operations that selection needs. Candidates stay on their
// rank; selected points are known to all ranks.

#ifndef morph_communicator_hpp
#define morph_communicator_hpp

#include <vector>

namespace morph
{

// All operations are collective: every rank, also one without points, calls
// them in the same order.
class Communicator
{
public:
    virtual ~Communicator() = default;

    virtual int rank() const = 0;

    virtual int size() const = 0;

    // The values of all ranks, in rank order
    virtual std::vector<double> gather(const std::vector<double>& mine) = 0;

    // The largest value of all ranks
    virtual double max(double value) = 0;

    // The sum over all ranks of each entry; all lists have the same length
    virtual std::vector<double> sum(const std::vector<double>& mine) = 0;

    // Number of collective operations so far, and bytes that this rank received
    long operations() const { return operations_; }
    double bytes() const { return bytes_; }

protected:
    void count(std::size_t values)
    {
        ++operations_;
        bytes_ += double(values * sizeof(double));
    }

private:
    long operations_ = 0;
    double bytes_ = 0;
};


// One rank
class SerialCommunicator : public Communicator
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
