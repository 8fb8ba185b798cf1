// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/detail/staging.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// A term of `internal_force` without a force: the first sweep writes the deformation gradient of every particle to the
/// user's array, for contact and diagnostics.
template <class T, int D>
struct Record {
  MatrixView<T, D> target;

  /// Throws `InputError` unless `target` holds `size` particles.
  void check(std::size_t size) const { require_size(target, size, "deformation gradients to record"); }

  template <class K>
  HMPS_INLINE void couple(const BlockOfParticles<K, D>& particles, Coupling<K, D>&) const {
    const auto& F = particles.deformation_gradient;
    detail::deliver(particles.blocks(), particles.block(), target, [&](int k) { return F(k % D, k / D); });
  }

  /// Zero: this term exerts no force.
  template <class Particle>
  [[nodiscard]] double energy(const Particle&) const {
    return 0;
  }
  /// Zero: this term exerts no force.
  template <class Particle>
  [[nodiscard]] Matrix<double, Particle::dimension> stress(const Particle&) const {
    return Matrix<double, Particle::dimension>::Zero();
  }
};

/// Writes deformation gradients to `target`, one per particle of the bonds; `internal_force` throws `InputError` for
/// any other size.
template <class T, int D>
[[nodiscard]] Record<T, D> record(const MatrixView<T, D>& target) {
  return {target};
}

/// Explains calls with arrays in place of views.
template <class... Arguments>
requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> record(const Arguments&...);

}  // namespace hmps::inline HMPS_ABI
