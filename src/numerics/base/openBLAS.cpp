// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// Runs OpenBLAS, whichever variant is installed, on one thread and with loops
// for this processor.
//
// Each rank is a process: BLAS threads would compete for the cores of other
// ranks, and results would depend on their number to the last bits.
//
// OpenBLAS knows processors by their model numbers and takes its oldest loops,
// without AVX, for one that came after it: a selection of 3,700 points then
// spends 40 % of its time in matrix products that could be 2.5 times faster.
// The processor itself says what it can do.

#ifdef EIGEN_USE_BLAS

    #include <cstdlib>
    #include <cstring>

// Null where the BLAS is another one, or has loops for one processor alone
extern "C"
{
    void openblas_set_num_threads(int) __attribute__((weak));
    char* openblas_get_corename() __attribute__((weak));
    void gotoblas_dynamic_init() __attribute__((weak));
    void gotoblas_dynamic_quit() __attribute__((weak));
}

namespace morph
{
namespace
{

void useLoopsOfThisProcessor()
{
    #ifdef __x86_64__
    const char* variable = "OPENBLAS_CORETYPE";
    if (!gotoblas_dynamic_init || !gotoblas_dynamic_quit
        || !openblas_get_corename || std::getenv(variable)
        || std::strcmp(openblas_get_corename(), "Prescott") != 0)
    {
        return;
    }
    const char* core = __builtin_cpu_supports("avx512vl")
            && __builtin_cpu_supports("avx512bw")
            && __builtin_cpu_supports("avx512dq")
        ? "SkylakeX"
        : __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")
        ? "Haswell"
        : nullptr;
    if (core)
    {
        // What OpenBLAS does itself when it is loaded
        setenv(variable, core, 0);
        gotoblas_dynamic_quit();
        gotoblas_dynamic_init();
        unsetenv(variable);
    }
    #endif
}


bool setUp()
{
    if (openblas_set_num_threads)
    {
        openblas_set_num_threads(1);
    }
    useLoopsOfThisProcessor();
    return true;
}

// Runs when the library is loaded, before anything is computed
const bool ready __attribute__((used)) = setUp();

} // namespace
} // namespace morph

#endif
