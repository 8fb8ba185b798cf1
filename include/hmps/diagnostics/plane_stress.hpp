// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"
#include "hmps/laws/law.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The normal stress across a wall as a function of how far the wall is stretched across itself: n . P(F + s n (x) N) N
/// with s without unit. N is the normal of the wall in the reference configuration and n the current one, which does
/// not depend on s. The stress increases with s for every law that is stable against waves across the wall.
template <class Law, int D>
class StressAcross {
 public:
  StressAcross(const Law& law, const Matrix<double, D>& F, const Vector<double, D>& N) : law_(law), F_(F), N_(N) {
    const Vector<double, D> area = cofactor(F) * N;
    area_ = area.norm();
    n_ = area / area_;
  }
  [[nodiscard]] Matrix<double, D> gradient(double s) const { return F_ + s * n_ * N_.transpose(); }
  [[nodiscard]] double operator()(double s) const {
    const Matrix<double, D> F = gradient(s);
    return n_.dot(first_piola_kirchhoff(law_, F) * N_);
  }
  /// The s with the determinant `J`.
  [[nodiscard]] double at_volume(double J) const { return (J - determinant(F_)) / area_; }

 private:
  const Law& law_;
  Matrix<double, D> F_;
  Vector<double, D> N_, n_;
  double area_;  ///< of the wall, current over reference
};

/// The s at which there is no stress across the wall, if there is one between a hundredth and a hundred times the
/// reference volume.
template <class Law, int D>
[[nodiscard]] std::optional<double> without_stress(const StressAcross<Law, D>& stress) {
  // A bracket around s, from the volume at which most laws have no pressure.
  double low = stress.at_volume(1), high = low, J = 1;
  double at_low = stress(low), at_high = at_low;
  while (at_low > 0 && J > 0.01) at_low = stress(low = stress.at_volume(J *= 0.9));
  for (J = 1; at_high < 0 && J < 100;) at_high = stress(high = stress.at_volume(J *= 1.1));
  if (!is_finite(at_low) || !is_finite(at_high) || at_low > 0 || at_high < 0) return std::nullopt;
  // False position; an end that stays twice counts for half (Dowell and Jarratt 1971, "Illinois").
  int stayed = 0;
  double s = low;
  for (int k = 0; k < 200 && at_low < at_high && is_finite(s); ++k) {
    const double before = s;
    s = (low * at_high - high * at_low) / (at_high - at_low);
    const double at = stress(s);
    if (at == 0 || std::abs(s - before) <= 1e-13) break;
    if (at < 0) {
      low = s;
      at_low = at;
      if (stayed == 1) at_high /= 2;
      stayed = 1;
    } else {
      high = s;
      at_high = at;
      if (stayed == -1) at_low /= 2;
      stayed = -1;
    }
  }
  return is_finite(s) ? std::optional(s) : std::nullopt;
}

}  // namespace detail

/// CHANGES the deformation gradients of walls so that no stress acts across them, the plane stress condition of shell
/// theory, for the stress of thin walls:
///
///     recovered_gradients(bonds, x, matrices(F));                      // right along the faces
///     impose_plane_stress(matrices(F), tissue, vectors(normals));      // and across them
///     cauchy_stresses(matrices(F), tissue, matrices(stress));
///
/// F becomes F + s n (x) N, where N is the normal of the wall in the reference configuration, n the current one, and s
/// the number for which n . P(F) N = 0 with P by \paper{7}. What F says of the faces and of shear across the wall
/// stays; the stretch across the wall, which particles of few layers do not determine, follows from the law. So does
/// det F: give the law with the whole bulk modulus of the tissue, not the share that `thin_wall_stabiliser` leaves it.
///
/// In two dimensions the strain across the plane stays zero, as laws have it there; only the wall in the plane is free.
///
/// The condition is right where nothing presses on the wall, or little compared with the stress along it, and wrong
/// where a wall is held, meets another one, or is not thin. docs/fitted.md compares stresses.
///
/// @param F         deformation gradients
/// @param material  a law, or a callable of `OneParticle` that returns the law of each particle
/// @param normals   of the walls in the reference configuration, such as those of `wall_normals`: of length 1 on either
///                  side, or zero for particles whose F does not change
/// Throws `InputError` for views of different sizes, a normal of another length, a deformation gradient that is not
/// finite or that nothing has written, and as `cauchy_stresses` does for the material; and `StateError`, naming the
/// particle, if no stretch across the wall between a hundredth and a hundred times its reference volume leaves it
/// without stress, or if the particle is turned inside out (det F < 0). F is unchanged then.
template <class T, int D, class Material, class N, Executor E = Serial>
void impose_plane_stress(const MatrixView<T, D>& F, const Material& material, const VectorView<N, D>& normals,
                         const E& execute = {}) {
  static_assert(!std::is_const_v<T>, "hmps: the deformation gradients are changed; give a writable view of them");
  require_finite(F, "the deformation gradient");
  detail::require_recorded(F);
  detail::require_material(material, F.size());
  require_size(normals, F.size(), "normals");
  require_apart(F, "deformation gradients", normals, "normals");
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const double length = normals[i].template cast<double>().norm();
    detail::require(detail::is_finite(length) && (length == 0 || std::abs(length - 1) < 1e-3),
                    "hmps: the normal of particle ", i, " has the length ", length,
                    "; give unit vectors, and zero where there is no wall");
  }
  std::vector<Matrix<double, D>> across(F.size());
  std::vector<char> failed(F.size(), 0);
  detail::guarded(execute)(F.size(), [&](std::size_t i) {
    const Vector<double, D> normal = normals[i].template cast<double>();
    across[i] = F[i].template cast<double>();
    if (normal.isZero(0)) return;
    const auto law = detail::value_at(material, OneParticle{i});
    const detail::StressAcross stress(law, across[i], Vector<double, D>(normal.normalized()));
    // A particle that is turned inside out would be turned back, through a state without volume.
    const std::optional<double> stretch = determinant(across[i]) < 0 ? std::nullopt : detail::without_stress(stress);
    if (stretch)
      across[i] = stress.gradient(*stretch);
    else
      failed[i] = 1;
  });
  for (std::size_t i = 0; i < F.size(); ++i) {
    if (!failed[i]) continue;
    const double J = determinant(Matrix<double, D>(F[i].template cast<double>()));
    if (J < 0)
      throw StateError(detail::message("hmps: particle ", i, " of a wall is turned inside out: its determinant is ", J,
                                       "; use a smaller step, or give it the normal zero"));
    throw StateError(detail::message("hmps: no stretch of the wall across itself leaves particle ", i,
                                     " without stress there; its determinant is ", J,
                                     ": give it the normal zero if it is not part of a thin wall"));
  }
  for (std::size_t i = 0; i < F.size(); ++i) F.set(i, across[i]);
}

}  // namespace hmps::inline HMPS_ABI
