// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Refuses what does not fit into memory.

#ifndef morph_memory_hpp
#define morph_memory_hpp

#include "communicator.hpp"

#include <string>

namespace morph
{

// Memory that is available without swapping [B]
double availableMemory();

// Throws std::runtime_error on all ranks if the bytes requested by all ranks
// are not available. what: name of the data, for the message. Collective.
void requireMemory(
    double bytes, const std::string& what, Communicator& communicator);

} // namespace morph

#endif
