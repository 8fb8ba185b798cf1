// SPDX-License-Identifier: MIT
// expect: hmps reports errors by exceptions
// flags: -fno-exceptions -Wfatal-errors
#include "hmps/hmps.hpp"
