// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/language.hpp"  // before anything that an older standard does not know

/// The inline namespace in which the library lies: one name for each kind of object code that must not be mixed. Inline
/// functions that two translation units share are linked once; were one compiled by g++ and the other by clang++, which
/// lay out the captures of a closure in another order, or one with -ffast-math, which drops checks, one of the two
/// would run code that does not fit its data. With names of their own, each keeps its own. A function of yours that
/// takes types of the library therefore links only among translation units of one kind; small vectors and matrices,
/// which are Eigen's, and exceptions are the same in all. Flags such as -mavx2 may differ: they change no layout.
#if defined(__clang__)
#define HMPS_ABI_COMPILER clang
#elif defined(__GNUC__)
#define HMPS_ABI_COMPILER gnu
#else
#define HMPS_ABI_COMPILER other
#endif
#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#define HMPS_ABI_MATH _fast_math
#else
#define HMPS_ABI_MATH
#endif
#define HMPS_ABI_JOIN(a, b) a##b
#define HMPS_ABI_NAME(a, b) HMPS_ABI_JOIN(a, b)
#define HMPS_ABI HMPS_ABI_NAME(HMPS_ABI_COMPILER, HMPS_ABI_MATH)
