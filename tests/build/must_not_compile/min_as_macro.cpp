// SPDX-License-Identifier: MIT
// expect: define NOMINMAX
#include <Eigen/Core>
#include <sstream>
#define min(a, b) ((a) < (b) ? (a) : (b))
#include "hmps/core/error.hpp"
