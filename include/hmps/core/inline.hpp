// SPDX-License-Identifier: MIT
#pragma once

/// Forces inlining, so that packs of lanes stay in registers: write `HMPS_INLINE` before a function,
/// `HMPS_INLINE_LAMBDA` after the parameters of a lambda. Without optimisation nothing stays in registers, and nothing
/// is forced: under the sanitizers, clang++ then compiles the sweeps in half the time. Write `HMPS_COLD` before
/// functions that run after an error or in a few steps only: they are neither inlined nor optimised for speed.
#if defined(__OPTIMIZE__) && (defined(__GNUC__) || defined(__clang__))
#define HMPS_INLINE [[gnu::always_inline]] inline
#define HMPS_INLINE_LAMBDA __attribute__((always_inline))
#else
#define HMPS_INLINE inline
#define HMPS_INLINE_LAMBDA
#endif
#if defined(__GNUC__) || defined(__clang__)
#define HMPS_COLD [[gnu::cold, gnu::noinline]]
#else
#define HMPS_COLD
#endif
