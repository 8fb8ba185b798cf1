// SPDX-License-Identifier: MIT
#pragma once

// Reports in one line what the compiler would otherwise report in pages.
#if defined(_MSVC_LANG) ? _MSVC_LANG < 202002L : __cplusplus < 201709L
#error "hmps needs C++20: compile with -std=c++20 (or target_compile_features(... cxx_std_20) in CMake)"
#endif
#if !defined(__cpp_exceptions) && !defined(_CPPUNWIND)
#error "hmps reports errors by exceptions: compile without -fno-exceptions"
#endif
