// SPDX-License-Identifier: MIT
// expect: hmps reports errors by exceptions
// flags: -fno-exceptions
#include "hmps/hmps.hpp"
