// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"
#include "hmps/diagnostics/energy.hpp"
#include "hmps/force/detail/force_stress.hpp"
#include "hmps/laws/law.hpp"

/// Stress for output, from deformation gradients and the law: `cauchy_stress` and `von_mises_stress` for one particle,
/// the same names in the plural for all particles. The first Piola-Kirchhoff stress of one particle is
/// `first_piola_kirchhoff`. It is the stress of the law alone. **In a force with `mean_dilatation`, most of the
/// pressure is missing**, because the law has only its own share of the bulk modulus: use
/// `InternalForce::cauchy_stresses`, which adds the rest. The von Mises stress does not depend on pressure. For thin
/// walls see `impose_plane_stress`. References:
/// Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed. 2008, chapter 5; Holzapfel,
/// Nonlinear Solid Mechanics, 2000, chapter 3.
namespace hmps::inline HMPS_ABI {

/// The three-dimensional deformation gradient of one in the plane, with F33 = 1.
template <class T>
[[nodiscard]] Matrix<T, 3> plane_strain(const Matrix<T, 2>& F) {
  Matrix<T, 3> result = Matrix<T, 3>::Identity();
  result.template topLeftCorner<2, 2>() = F;
  return result;
}

/// The Cauchy stress in Pa, force per current area: sigma = P F^T / J, with P = dW/dF by \paper{7} and J = det F.
/// Symmetric up to rounding for laws that are invariant under rotation, which are all but `LinearElastic`. In two
/// dimensions it is the part in the plane. `F` must not be singular.
template <class Law, class T, int D>
[[nodiscard]] Matrix<T, D> cauchy_stress(const Law& law, const Matrix<T, D>& F) {
  return detail::cauchy_of<T, D>(first_piola_kirchhoff(law, F), F);
}

/// The von Mises stress in Pa of a Cauchy stress: sqrt(3/2 s : s), with s the deviator of its symmetric part. In simple
/// tension it is the tension, in simple shear sqrt(3) times the shear stress; pressure does not affect it.
template <class T>
[[nodiscard]] T von_mises_stress(const Matrix<T, 3>& cauchy) {
  const auto square = [](T x) { return x * x; };
  const T normal =
      square(cauchy(0, 0) - cauchy(1, 1)) + square(cauchy(1, 1) - cauchy(2, 2)) + square(cauchy(2, 2) - cauchy(0, 0));
  const T shear =
      square(cauchy(0, 1) + cauchy(1, 0)) + square(cauchy(1, 2) + cauchy(2, 1)) + square(cauchy(2, 0) + cauchy(0, 2));
  return std::sqrt(normal / T(2) + shear * T(0.75));
}

/// The same at the deformation gradient `F` of a particle with the law `law`. In two dimensions it is that of plane
/// strain, including the stress across the plane, so the law must also work in three.
template <class Law, class T, int D>
[[nodiscard]] T von_mises_stress(const Law& law, const Matrix<T, D>& F) {
  if constexpr (D == 2) {
    return von_mises_stress(cauchy_stress(law, plane_strain(F)));
  } else {
    return von_mises_stress(cauchy_stress(law, F));
  }
}

namespace detail {

/// Writes `value(law, F)` of every particle, computed in double, to `stress`, called `name`. Throws as
/// `cauchy_stresses` does.
template <class T, int D, class Material, class R, int N, class Value, class E>
void evaluate_stress(const MatrixView<T, D>& F, const Material& material, const View<R, N>& stress, const char* name,
                     const Value& value, const E& execute) {
  require_recorded(F);
  require_material(material, F.size());
  require_size(stress, F.size(), "stresses");
  require_apart(stress, "stresses", F, "deformation gradients");
  guarded(execute)(F.size(), [&](std::size_t i) {
    const Matrix<double, D> gradient = F[i].template cast<double>();
    const auto result = value(value_at(material, OneParticle{i}), gradient);
    if constexpr (std::is_arithmetic_v<decltype(result)>)
      stress(i, 0) = static_cast<R>(result);
    else
      MatrixView<R, static_cast<int>(decltype(result)::RowsAtCompileTime)>(stress).set(i, result);
  });
  require_finite_result<D>(stress, F, name);
}

}  // namespace detail

/// Writes the Cauchy stress in Pa of every particle, see `cauchy_stress`, computed in double precision: that of the law
/// alone, without the pressure of `mean_dilatation`, which `InternalForce::cauchy_stresses` includes.
///
/// @param F         deformation gradients, \paper{11}
/// @param material  a law, or a callable of `OneParticle` that returns the law of each particle
/// @param stress    where the stresses are written, column-major
/// Throws `InputError` for views of different sizes and for a law whose moduli are not positive, also if it is that of
/// a single particle, and `StateError`, naming the particle, if a stress is not finite.
template <class T, int D, class Material, class R, Executor E = Serial>
void cauchy_stresses(const MatrixView<T, D>& F, const Material& material, const MatrixView<R, D>& stress,
                     const E& execute = {}) {
  detail::evaluate_stress(
      F, material, stress, "Cauchy stress",
      [](const auto& law, const Matrix<double, D>& gradient) { return cauchy_stress(law, gradient); }, execute);
}

/// The same for a body in plane strain, with the stress across the plane, as ParaView needs it. Parameters and errors
/// are the same; the law must also work in three dimensions.
template <class T, class Material, class R, Executor E = Serial>
void cauchy_stresses(const MatrixView<T, 2>& F, const Material& material, const MatrixView<R, 3>& stress,
                     const E& execute = {}) {
  detail::evaluate_stress(
      F, material, stress, "Cauchy stress",
      [](const auto& law, const Matrix<double, 2>& gradient) { return cauchy_stress(law, plane_strain(gradient)); },
      execute);
}

/// Writes the first Piola-Kirchhoff stress P = dW/dF in Pa of every particle, force per reference area, \paper{7}, in
/// the same way. Parameters and errors are those of `cauchy_stresses`.
template <class T, int D, class Material, class R, Executor E = Serial>
void first_piola_kirchhoff_stresses(const MatrixView<T, D>& F, const Material& material, const MatrixView<R, D>& stress,
                                    const E& execute = {}) {
  detail::evaluate_stress(
      F, material, stress, "first Piola-Kirchhoff stress",
      [](const auto& law, const Matrix<double, D>& gradient) { return first_piola_kirchhoff(law, gradient); }, execute);
}

/// Writes the von Mises stress in Pa of every particle, see `von_mises_stress`. Parameters and errors are those of
/// `cauchy_stresses`; in two dimensions the law must also work in three.
template <class T, int D, class Material, class R, Executor E = Serial>
void von_mises_stresses(const MatrixView<T, D>& F, const Material& material, const ScalarView<R>& stress,
                        const E& execute = {}) {
  detail::evaluate_stress(
      F, material, stress, "von Mises stress",
      [](const auto& law, const Matrix<double, D>& gradient) { return von_mises_stress(law, gradient); }, execute);
}

}  // namespace hmps::inline HMPS_ABI
