// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs OpenBLAS on one thread, whichever variant is installed.
//
// Each rank is a process: BLAS threads would compete for the cores of other
// ranks, and results would depend on their number to the last bits.

#ifdef EIGEN_USE_BLAS

// Null where the BLAS is another one
extern "C" void openblas_set_num_threads(int) __attribute__((weak));

namespace morph
{
namespace
{

bool useOneThread()
{
    if (openblas_set_num_threads)
    {
        openblas_set_num_threads(1);
    }
    return true;
}

// Runs when the library is loaded, before anything is computed
const bool oneThread __attribute__((used)) = useOneThread();

} // namespace
} // namespace morph

#endif
