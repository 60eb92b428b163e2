// SPDX-License-Identifier: MIT
#pragma once

/// Before a function whose loops gain by vector instructions: GCC builds it for processors with AVX2 and for all
/// others, and the loader picks. The bits of its results are the same.
#if defined(__x86_64__) && defined(__ELF__) && defined(__GNUC__) && __GNUC__ >= 12 && !defined(__clang__)
#define FRAGMOTION_VECTORISED __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define FRAGMOTION_VECTORISED
#endif
