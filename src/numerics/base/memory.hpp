// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Refusing what would not fit into memory.

#ifndef morph_memory_hpp
#define morph_memory_hpp

#include "communicator.hpp"

#include <string>

namespace morph
{

// Memory that a program may still take without others being thrown out [B]
double availableMemory();

// Throws std::runtime_error on all ranks if the bytes that the ranks ask for on
// this rank's node are not there. Collective. what: "<thing>", for the message.
void requireMemory
(
    double bytes,
    const std::string& what,
    Communicator& communicator
);

} // namespace morph

#endif
