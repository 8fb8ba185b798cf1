// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/language.hpp"  // first, before code that an older standard rejects

/// The inline namespace of the library, with a different name for each kind of object code that must not be mixed. The
/// linker keeps one copy of an inline function that several translation units share. If one of them was compiled by g++
/// and another by clang++, which lay out the captures of closures differently, or if -ffast-math removed checks from
/// one, some callers would run code that does not fit their data. Different names keep the copies apart. Consequently,
/// a function of yours that takes types of the library links only between translation units of one kind. The types of
/// small vectors and matrices (Eigen's) and of exceptions are the same in all kinds. Flags such as -mavx2 may differ:
/// no layout depends on them.
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
