// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/core/language.hpp"

#include <Eigen/Core>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"

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

namespace hmps::inline HMPS_ABI::detail {

/// Fails to compile for parameters of an integer type: a formula such as 4 / 3 of a modulus would be rounded.
template <class P>
struct RequireReal {
  static_assert(!std::is_integral_v<P>,
                "hmps: a formula is given integers, to which its results would be rounded; write numbers with a "
                "decimal point, such as 7e3 or 0.5");
  static constexpr bool value = true;
};

/// The index of no particle, vertex or triangle.
inline constexpr Index no_index = std::numeric_limits<Index>::max();

}  // namespace hmps::inline HMPS_ABI::detail
