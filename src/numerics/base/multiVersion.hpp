// SPDX-FileCopyrightText: 2026 The morphFoam authors
// SPDX-License-Identifier: GPL-3.0-or-later

// One binary for every x86-64 machine: marked functions are compiled for
// several instruction sets, and the best is chosen when the library is loaded.

#ifndef morph_multiVersion_hpp
#define morph_multiVersion_hpp

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
    #if __GNUC__ >= 12
        #define MORPH_MULTIVERSION \
            __attribute__(( \
                target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default")))
    #else
        #define MORPH_MULTIVERSION \
            __attribute__((target_clones("avx512f", "avx2", "default")))
    #endif
#else
    #define MORPH_MULTIVERSION
#endif

#endif
