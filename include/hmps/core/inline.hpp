// SPDX-License-Identifier: MIT
#pragma once

/// Inlined whatever the optimiser thinks of it, so that packs of lanes stay in registers: `HMPS_INLINE` before a
/// function, `HMPS_INLINE_LAMBDA` behind the parameters of a lambda.
#if defined(__GNUC__) || defined(__clang__)
#define HMPS_INLINE [[gnu::always_inline]] inline
#define HMPS_INLINE_LAMBDA __attribute__((always_inline))
#else
#define HMPS_INLINE inline
#define HMPS_INLINE_LAMBDA
#endif
