// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/direction.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

/// Particles that are held, or have one velocity component prescribed. Call these after each kick: before the
/// drift, and before velocities are read, as for the kinetic energy. For particles with prescribed motion see
/// `ControlRegion`.
namespace hmps::inline HMPS_ABI {

/// Sets the velocities `v` (m/s) of the particles of `held` to zero: a clamp. Throws `InputError` for a set made for
/// another number of particles.
template <class V, int D>
void hold(const VectorView<V, D>& v, const ParticleSet& held) {
  require_size(v, held.scene_size(), "velocities");
  for (const Index i : held)
    for (int c = 0; c < D; ++c) v(i, c) = 0;
}

/// Sets component `c` of the velocities `v` (m/s) of the particles of `held` to `velocity` (m/s): with zero, a plane of
/// symmetry or a frictionless guide perpendicular to that axis. Throws `InputError` for a component that does not
/// exist, a velocity that is not finite and a set made for another number of particles.
///
/// For half of a symmetric body, `MirrorImages` is exact. With this function alone, let the held layer lie on the plane
/// of symmetry and give the bonds volumes, half of l0^D there: half of a bar of five layers that is clamped at both
/// ends then sags 1.5 % more than the whole bar, with whole volumes 2.6 % more, and 6.6 % less if the layer lies half a
/// spacing before the plane. Strain beside the plane is wrong by about a fifth at any spacing, since it has no bonds
/// to the other half.
template <class V, int D>
void hold_component(const VectorView<V, D>& v, const ParticleSet& held, int c, double velocity = 0) {
  require_size(v, held.scene_size(), "velocities");
  detail::require(0 <= c && c < D, "hmps: component ", c, " of a velocity is to be held, but the components are 0 to ",
                  D - 1);
  detail::require(detail::is_finite(velocity), "hmps: component ", c, " of a velocity is to be held at ", velocity,
                  " m/s; give a finite number");
  using S = typename VectorView<V, D>::Scalar;
  for (const Index i : held) v(i, c) = static_cast<S>(velocity);
}

/// Removes the component along `normal` (of any nonzero length) from the velocities `v` (m/s) of the particles of
/// `held`: a plane of symmetry or a frictionless guide at any angle. Throws `InputError` for a normal that is zero or
/// not finite and for a set made for another number of particles.
template <class V, int D, class Derived>
void hold_along(const VectorView<V, D>& v, const ParticleSet& held, const Eigen::MatrixBase<Derived>& normal) {
  require_size(v, held.scene_size(), "velocities");
  const Vector<double, D> given = detail::measurable<double, D>(normal.template cast<double>());
  const double length = given.norm();
  detail::require(detail::is_finite(length) && length > 0, "hmps: velocities are to be held along (", normal,
                  "); give a direction of finite, nonzero length");
  const Vector<double, D> n = given / length;
  for (const Index i : held) {
    const Vector<double, D> own = v[i].template cast<double>();
    v.set(i, Vector<double, D>(own - own.dot(n) * n));
  }
}

/// Explains calls with arrays in place of views.
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> hold(const Arguments&...);
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> hold_component(
    const Arguments&...);

}  // namespace hmps::inline HMPS_ABI
