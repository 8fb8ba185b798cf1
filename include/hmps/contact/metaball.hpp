// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>

#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

/// The kernel that each particle of a wall contributes, with `s = (r / r_e)^2` in `[0, 1]` (squared, to avoid a root
/// per pair):
/// - `Kernel::radius`: the effective radius in spacings, `r_e / l0`;
/// - `Kernel::value(s)`: c, falling from a positive value at 0 to 0 at 1;
/// - `Kernel::slope(s)`: dc/ds, negative in between.
///
/// Beyond `r_e` the kernel is zero. Models: `PaperMetaball`, `SmoothMetaball`.
template <class Kernel>
concept Metaball = requires(double s) {
  { Kernel::radius } -> std::convertible_to<double>;
  { Kernel::value(s) } -> std::convertible_to<double>;
  { Kernel::slope(s) } -> std::convertible_to<double>;
};

namespace detail {
template <class Kernel>
struct IsMetaball : std::bool_constant<Metaball<Kernel>> {};
/// Fails to compile unless `Kernel` is a `Metaball`; the first line of the message names `Kernel`.
template <class Kernel>
struct RequireMetaball {
  static_assert(IsMetaball<Kernel>::value,
                "hmps: a metaball needs the constant radius in spacings, and value(s) and slope(s), static, of the "
                "squared distance over the squared radius");
  static constexpr bool value = true;
};
}  // namespace detail

/// The paper's kernel, \paper{26}: c = 1 - (r / r_e)^2 with r_e = 1.75 l0; c(0) = 1. The gradient of the sum jumps
/// where a particle enters r_e, so that a flat lattice wall is rough: at contact height its normal tilts by up to atan
/// 0.37.
struct PaperMetaball {
  static constexpr double radius = 1.75;
  template <class S>
  [[nodiscard]] static constexpr S value(S s) {
    return S(1) - s;
  }
  template <class S>
  [[nodiscard]] static constexpr S slope(S) {
    return S(-1);
  }
};

/// A smooth kernel, to replace \paper{26} where friction matters: c = (1 - (r / r_e)^2)^3 with r_e = 2.5 l0. It has two
/// continuous derivatives; over a flat lattice wall the normal tilts by at most atan 0.008 at contact height. It
/// reaches 2.9 times as many particles as the paper's kernel.
struct SmoothMetaball {
  static constexpr double radius = 2.5;
  template <class S>
  [[nodiscard]] static constexpr S value(S s) {
    const S u = S(1) - s;
    return u * u * u;
  }
  template <class S>
  [[nodiscard]] static constexpr S slope(S s) {
    const S u = S(1) - s;
    return S(-3) * u * u;
  }
};

}  // namespace hmps::inline HMPS_ABI
