// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "memory.hpp"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace morph
{

double availableMemory()
{
    std::ifstream info("/proc/meminfo");
    std::string key, unit;
    double value;
    while (info >> key >> value)
    {
        std::getline(info, unit);
        if (key == "MemAvailable:")
        {
            return 1024 * value;
        }
    }
    return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
}


void requireMemory(
    double bytes, const std::string& what, Communicator& communicator)
{
    // Ranks may share a node; assume that all of them do
    const double needed = communicator.sum({bytes})[0];
    const double available = -communicator.max(-availableMemory());
    if (needed > 0.9 * available)
    {
        std::ostringstream message;
        message.precision(3);
        message << what << " would take " << needed * 1e-9 << " GB, but "
                << available * 1e-9 << " GB are available";
        throw std::runtime_error(message.str());
    }
}

} // namespace morph
