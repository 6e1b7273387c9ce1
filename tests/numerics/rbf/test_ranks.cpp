// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Ranks as threads: each has its candidates and they talk through memory.

#include "test_support.hpp"

#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <stdexcept>
#include <thread>

namespace test
{

namespace
{

// Where all ranks meet. If one does not come the others give up instead of
// waiting for ever: then a collective operation was not called by all.
class Meeting
{
public:
    explicit Meeting(int ranks)
    : said(ranks),
      ranks_(ranks)
    {
    }

    void wait()
    {
        std::unique_lock<std::mutex> lock(mutex_);
        const long round = round_;
        if (++arrived_ == ranks_)
        {
            arrived_ = 0;
            ++round_;
            all_.notify_all();
            return;
        }
        const bool complete = all_.wait_for(
            lock, std::chrono::seconds(60), [&] { return round_ != round; });
        if (!complete)
        {
            throw std::runtime_error("a rank is missing in a collective");
        }
    }

    std::vector<std::vector<double>> said;

private:
    int ranks_;
    int arrived_ = 0;
    long round_ = 0;
    std::mutex mutex_;
    std::condition_variable all_;
};


class ThreadCommunicator : public Communicator
{
public:
    ThreadCommunicator(Meeting& meeting, int rank)
    : meeting_(meeting),
      rank_(rank)
    {
    }

    int rank() const override { return rank_; }

    int size() const override { return meeting_.said.size(); }

    std::vector<double> gather(const std::vector<double>& mine) override
    {
        std::vector<double> all;
        for (const std::vector<double>& part : exchange(mine))
        {
            all.insert(all.end(), part.begin(), part.end());
        }
        return all;
    }

    double max(double value) override
    {
        for (const std::vector<double>& part : exchange({value}))
        {
            value = std::max(value, part.at(0));
        }
        return value;
    }

    std::vector<double> sum(const std::vector<double>& mine) override
    {
        std::vector<double> total(mine.size(), 0);
        for (const std::vector<double>& part : exchange(mine))
        {
            for (std::size_t i = 0; i < total.size(); ++i)
            {
                total[i] += part.at(i);
            }
        }
        return total;
    }

private:
    std::vector<std::vector<double>> exchange(const std::vector<double>& mine)
    {
        meeting_.said[rank_] = mine;
        meeting_.wait();
        const std::vector<std::vector<double>> all = meeting_.said;
        meeting_.wait();
        count(mine.size());
        return all;
    }

    Meeting& meeting_;
    int rank_;
};

} // namespace


void onRanks(int ranks, const std::function<void(Communicator&)>& action)
{
    Meeting meeting(ranks);
    std::vector<std::exception_ptr> thrown(ranks);
    std::vector<std::thread> threads;
    for (int rank = 0; rank < ranks; ++rank)
    {
        threads.emplace_back(
            [&, rank]
            {
                ThreadCommunicator communicator(meeting, rank);
                try
                {
                    action(communicator);
                }
                catch (...)
                {
                    thrown[rank] = std::current_exception();
                }
            });
    }
    for (std::thread& thread : threads)
    {
        thread.join();
    }
    for (const std::exception_ptr& exception : thrown)
    {
        if (exception)
        {
            std::rethrow_exception(exception);
        }
    }
}

} // namespace test
