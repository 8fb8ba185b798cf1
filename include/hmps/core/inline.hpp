// SPDX-License-Identifier: MIT
#pragma once

/// Inlined whatever the optimiser thinks of it, so that packs of lanes stay in registers: `HMPS_INLINE` before a
/// function, `HMPS_INLINE_LAMBDA` behind the parameters of a lambda. `HMPS_COLD` before what runs only when something
/// is wrong: neither inlined nor optimised for speed.
#if defined(__GNUC__) || defined(__clang__)
#define HMPS_INLINE [[gnu::always_inline]] inline
#define HMPS_INLINE_LAMBDA __attribute__((always_inline))
#define HMPS_COLD [[gnu::cold, gnu::noinline]]
#else
#define HMPS_INLINE inline
#define HMPS_INLINE_LAMBDA
#define HMPS_COLD
#endif
