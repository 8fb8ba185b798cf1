// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"

/// Time integration of the equation of motion, \paper{1}: symplectic Euler with a separate kick for contact,
/// \paper{2, 3, 4}, as functions to compose:
///
///     force(x, v, f);               kick(v, f, rho, dt);     // v* of Eq. (2)
///     set_zero(f);
///     contact.add(x, v, F, f, dt);  kick(v, f, rho, dt);     // Eq. (3)
///     drift(x, v, dt);                                       // Eq. (4)
///
/// The order of the calls defines the scheme. The functions know nothing about forces. Every particle moves; forced
/// displacements prescribe velocities between the last kick and the drift.
namespace hmps::inline HMPS_ABI {

/// Changes the velocities by the force densities over the time `dt`, \paper{2} and \paper{3}: v <- v + f dt / rho. The
/// mass cancels.
///
/// @param v    velocities in m/s, changed
/// @param f    force densities in N/m3
/// @param rho  density in kg/m3: a number, a `ScalarView` with one per particle, or a callable (`PerParticle`)
/// @param dt   time step in s, positive
/// Throws `InputError` for views of different sizes, and for a density or a step that is not positive.
template <class T, class U, int D, PerParticle Rho, Executor E = Serial>
void kick(const VectorView<T, D>& v, const VectorView<U, D>& f, const Rho& rho, double dt, const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: kick changes the velocities; give it a writable view of them");
  require_view(v, "velocities");
  require_size(f, v.size(), "force densities");
  require_apart(v, "velocities", f, "force densities");
  require_positive(rho, v.size(), "density", "kg/m3");
  detail::require_step(dt);
  detail::guarded(execute)(v.size(), [&](std::size_t i) {
    for (int c = 0; c < D; ++c) detail::kick(v(i, c), f(i, c), at_particle(rho, i), dt);
  });
}

/// Changes the positions by the velocities over the time `dt`, \paper{4}: x <- x + v dt.
///
/// In float, the increment v dt of a small step is only a few units in the last place of x, and rounding errors
/// accumulate. Use the compensated `drift` below, or positions in double, for long runs.
///
/// @param x   positions in m, changed
/// @param v   velocities in m/s
/// @param dt  time step in s, positive
/// Throws `InputError` for views of different sizes, and for a step that is not positive.
template <class T, class U, int D, Executor E = Serial>
void drift(const VectorView<T, D>& x, const VectorView<U, D>& v, double dt, const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: drift changes the positions; give it a writable view of them");
  using Real = std::common_type_t<T, std::remove_const_t<U>>;
  require_view(x, "positions");
  require_size(v, x.size(), "velocities");
  require_apart(x, "positions", v, "velocities");
  detail::require_step(dt);
  detail::guarded(execute)(x.size(), [&](std::size_t i) {
    for (int c = 0; c < D; ++c)
      x(i, c) = static_cast<T>(static_cast<Real>(x(i, c)) + static_cast<Real>(v(i, c)) * static_cast<Real>(dt));
  });
}

namespace detail {
/// Throws `InputError` unless the carries of 64 particles, spread over all, are small compared with the positions and
/// their change, as rounding errors are. Leaves positions and velocities that are not finite to `check_state`.
template <class T, class U, int D>
void require_carry(const VectorView<T, D>& x, const VectorView<U, D>& v, const VectorView<T, D>& carry, double dt) {
  constexpr std::size_t most_samples = 64;
  const std::size_t n = x.size(), samples = std::min(n, most_samples);
  double reach = 0, largest = 0;
  std::size_t worst = 0;
  for (std::size_t k = 0; k < samples; ++k)
    for (int c = 0; c < D; ++c) {
      const std::size_t i = k * n / samples;
      const double length = std::abs(static_cast<double>(x(i, c))) + std::abs(static_cast<double>(v(i, c))) * dt;
      const double kept = std::abs(static_cast<double>(carry(i, c)));
      if (!is_finite(length)) return;
      reach = std::max(reach, length);
      if (is_finite(largest) && (!is_finite(kept) || kept > largest)) {
        largest = kept;
        worst = i;
      }
    }
  // Far above rounding, so that positions may be moved closer to the origin during a run.
  const double most = std::sqrt(static_cast<double>(std::numeric_limits<T>::epsilon())) * reach;
  require(
      is_finite(largest) && largest <= most, "hmps: the carry of particle ", worst, " is ", largest,
      " m, but a carry is what rounding has dropped from a position; set carries to zero at the start, and keep them "
      "from step to step");
}
}  // namespace detail

/// `drift` with compensated summation (Kahan): `carry` stores what rounding dropped, for the next step. The error of x
/// thus stays at about one rounding of x, plus one rounding of the distance travelled, after any number of steps.
///
/// @param carry  in m, the excess of x over the exact sum; zero at the start, kept by the caller from step to step, and
///               part of a checkpoint
/// A translation unit compiled with -ffast-math loses the compensation. Throws `InputError` as `drift` above does, and
/// for carries larger than a rounding error, such as those of an uninitialised array.
template <class T, class U, int D, Executor E = Serial>
void drift(const VectorView<T, D>& x, const VectorView<U, D>& v, const VectorView<T, D>& carry, double dt,
           const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: drift changes the positions; give it a writable view of them");
  require_view(x, "positions");
  require_size(v, x.size(), "velocities");
  require_apart(x, "positions", v, "velocities");
  require_apart(carry, "carries", x, "positions");
  require_apart(carry, "carries", v, "velocities");
  require_size(carry, x.size(), "carries");
  detail::require_step(dt);
  detail::require_carry(x, v, carry, dt);
  detail::guarded(execute)(x.size(), [&](std::size_t i) {
    for (int c = 0; c < D; ++c) {
      const T old = x(i, c);
      const T increment = static_cast<T>(static_cast<double>(v(i, c)) * dt - static_cast<double>(carry(i, c)));
      const T moved = old + increment;
      carry(i, c) = (moved - old) - increment;
      x(i, c) = moved;
    }
  });
}

/// Explains calls with arrays in place of views.
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> kick(const Arguments&...);
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> drift(const Arguments&...);

}  // namespace hmps::inline HMPS_ABI
