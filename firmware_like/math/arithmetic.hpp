// Refuses a build whose arithmetic would give other bits than everybody else's. The target liana_core brings the
// options that are right (firmware_like/CMakeLists.txt); this is for builds that use the sources without it. What no
// macro shows (-ffp-contract, on processors that always have fused operations) ./dev bits finds in the disassembly.
#pragma once

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || __FINITE_MATH_ONLY__
#error \
    "Liana's core: -ffast-math and its parts change bits and lose NaN; build without (docs/explanation/determinism.md)"
#endif

#if __FLT_EVAL_METHOD__ == 2 || __FLT_EVAL_METHOD__ < 0
#error "Liana's core: x87 arithmetic rounds twice; build it with -msse2 -mfpmath=sse (docs/explanation/determinism.md)"
#endif

// g++ fuses in spite of -ffp-contract=off, and has fused operations from AVX-512 even with -mno-fma; clang++ has none
// there.
#if defined(__FMA__) || defined(__FMA4__) || (defined(__AVX512F__) && !defined(__clang__))
#error "Liana's core: no fused operations; add -mno-fma -mno-fma4 -mno-avx512f (docs/explanation/determinism.md)"
#endif
