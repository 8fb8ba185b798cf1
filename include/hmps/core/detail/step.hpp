// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` unless `dt` (s) is positive and finite.
inline void require_step(double dt) {
  require(detail::is_finite(dt) && dt > 0, "hmps: the time step is ", dt,
          " s; it must be positive and finite (stable_step estimates the largest stable one)");
}
/// Adds the kick by the force density `f` to one component of the velocity of one particle: v + f dt / rho.
template <class T, class U, class Rho>
void kick(T& v, U f, Rho rho, double dt) {
  using Real = std::common_type_t<T, U>;
  v = static_cast<T>(static_cast<Real>(v) + static_cast<Real>(dt / static_cast<double>(rho)) * static_cast<Real>(f));
}
}  // namespace hmps::inline HMPS_ABI::detail
