// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <functional>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

/// Momenta of a body, summed in double in an order that does not depend on the executor. Elastic and artificial forces
/// conserve both momenta. The viscous force of \paper{21} conserves linear momentum, but damps rigid rotation at free
/// surfaces.
namespace hmps::inline HMPS_ABI {

/// Linear momentum in kg m/s, the sum of density * volume * v.
///
/// @param v        velocities in m/s
/// @param density  in kg/m3, a number or a `ScalarView`
/// @param volume   of a particle in m^D, a number or a `ScalarView`
/// Throws `InputError` for views of different sizes and for a density or a volume that is not positive and finite.
template <class T, int D, PerParticle Rho, PerParticle Vol, Executor E = Serial>
[[nodiscard]] Vector<double, D> linear_momentum(const VectorView<T, D>& v, const Rho& density, const Vol& volume,
                                                const E& execute = {}) {
  require_view(v, "velocities");
  require_positive(density, v.size(), "density", "kg/m3");
  require_positive(volume, v.size(), "volume", detail::unit_of_volume<D>());
  using Sum = Vector<double, D>;
  return reduce(
      v.size(), Sum(Sum::Zero()),
      [&](std::size_t i) -> Sum {
        const double mass = static_cast<double>(at_particle(density, i)) * static_cast<double>(at_particle(volume, i));
        return mass * v[i].template cast<double>();
      },
      [](const Sum& a, const Sum& b) -> Sum { return a + b; }, execute);
}

/// Angular momentum in kg m2/s about the point `about` (m): the sum of (x - about) x m v. Throws as `linear_momentum`
/// does, and for a point that is not finite.
template <class X, class T, int D, PerParticle Rho, PerParticle Vol, Executor E = Serial>
[[nodiscard]] Axial<D> angular_momentum(const VectorView<X, D>& x, const VectorView<T, D>& v, const Rho& density,
                                        const Vol& volume, const Vector<double, D>& about = Vector<double, D>::Zero(),
                                        const E& execute = {}) {
  require_view(x, "positions");
  require_size(v, x.size(), "velocities");
  require_positive(density, v.size(), "density", "kg/m3");
  require_positive(volume, v.size(), "volume", detail::unit_of_volume<D>());
  detail::require(detail::all_finite(about), "hmps: the angular momentum was requested about the point (", about,
                  ") m; give finite numbers");
  using Sum = Axial<D>;
  return reduce(
      v.size(), Sum(Sum::Zero()),
      [&](std::size_t i) -> Sum {
        const double mass = static_cast<double>(at_particle(density, i)) * static_cast<double>(at_particle(volume, i));
        const Vector<double, D> arm = x[i].template cast<double>() - about;
        const Vector<double, D> momentum = mass * v[i].template cast<double>();
        return cross<D>(arm, momentum);
      },
      [](const Sum& a, const Sum& b) -> Sum { return a + b; }, execute);
}

}  // namespace hmps::inline HMPS_ABI
