// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/language.hpp"

#include <Eigen/Core>
#include <cstdint>

/// Particle mechanics for soft tissue by the Hamiltonian MPS method. SI units everywhere.
namespace hmps {

/// Index of a particle in the user's arrays. 32 bits, because lists of bonds dominate memory.
using Index = std::uint32_t;

/// A vector of `D` components. Unaligned, so that its layout does not depend on the instruction set and Eigen's
/// alignment settings of a translation unit.
template <class T, int D>
using Vector = Eigen::Matrix<T, D, 1, Eigen::DontAlign>;

/// A `D` by `D` tensor, column-major, unaligned for the same reason as `Vector`.
template <class T, int D>
using Matrix = Eigen::Matrix<T, D, D, Eigen::DontAlign>;

}  // namespace hmps
