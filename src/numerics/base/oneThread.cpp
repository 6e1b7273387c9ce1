// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// OpenBLAS on one thread, whichever of its variants is installed.
//
// Each rank is a process of its own: threads of a BLAS would compete for the
// cores of the other ranks, and the bits of a result would depend on how many
// of them there are.

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

// When the library is loaded, before anything is computed
const bool oneThread __attribute__((used)) = useOneThread();

} // namespace
} // namespace morph

#endif
