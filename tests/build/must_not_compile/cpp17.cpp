// SPDX-License-Identifier: MIT
// expect: hmps needs C++20
// flags: -std=c++17 -Wfatal-errors
#include "hmps/hmps.hpp"
