// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
/// An Eigen matrix or expression with `D` by `D` numbers `T`. Without this check, Eigen would convert first and fail
/// later.
template <class M, class T, int D>
concept TensorLike = std::same_as<typename std::remove_cvref_t<M>::Scalar, T> &&
                     std::remove_cvref_t<M>::RowsAtCompileTime == D&& std::remove_cvref_t<M>::ColsAtCompileTime == D;
}  // namespace detail

/// A hyperelastic law, \paper{14}: S = 2 dW/dC. Valid expression:
///
/// | expression | gives |
/// |---|---|
/// | `law.second_piola_kirchhoff(C, J)` | the second Piola-Kirchhoff stress S in Pa, symmetric |
///
/// `C` is the right Cauchy-Green tensor F^T F and `J` is det F with its sign, which `C` alone does not determine. For
/// `D = 2` both are those of plane strain (F33 = 1). Satisfied by `MooneyRivlin`, `NeoHookean` and
/// `SaintVenantKirchhoff`, or by a small struct of your own. A law that is a template over `T` with only + - * / on
/// values of `T` also runs on packs of lanes; plain numbers may stand beside `T` and its tensors, as in `mu * C`.
template <class Law, class T = double, int D = 3>
concept HyperelasticLaw = requires(const Law& law, const Matrix<T, D>& C, const T& J) {
  { law.second_piola_kirchhoff(C, J) } -> detail::TensorLike<T, D>;
};

/// A law of the deformation gradient itself. Valid expression: `law.first_piola_kirchhoff(F)`, the
/// first Piola-Kirchhoff stress dW/dF in Pa. Satisfied by `LinearElastic` and `Continued`.
template <class Law, class T = double, int D = 3>
concept DeformationGradientLaw = requires(const Law& law, const Matrix<T, D>& F) {
  { law.first_piola_kirchhoff(F) } -> detail::TensorLike<T, D>;
};

/// Either kind of law, for the scalar (or pack of lanes) `T` in `D` dimensions.
template <class Law, class T = double, int D = 3>
concept ConstitutiveLaw = HyperelasticLaw<Law, T, D> || DeformationGradientLaw<Law, T, D>;

namespace detail {
/// A trait, because clang names the type in the message for a trait, but not for a concept.
template <class Law, class T, int D>
struct IsLaw : std::bool_constant<ConstitutiveLaw<Law, T, D>> {};
/// Fails to compile if `Law` is not a law; the first line of the message names it.
template <class Law, class T, int D>
struct RequireLaw {
  static_assert(IsLaw<Law, T, D>::value,
                "hmps: a law needs second_piola_kirchhoff(C, J) or first_piola_kirchhoff(F), const, taking and "
                "returning Matrix<T, D> of the scalar in use; make it a template over T and D to serve every scalar. "
                "A callable that returns the law of each particle takes `const auto& at`");
  static constexpr bool value = true;
};
}  // namespace detail

/// A law with an energy: `law.energy(C, J)` of a hyperelastic law, `law.energy(F)` of a law of the deformation
/// gradient, in J/m3. Only diagnostics need it.
template <class Law, class T = double, int D = 3>
concept LawWithEnergy = ConstitutiveLaw<Law, T, D> &&(
    requires(const Law& law, const Matrix<T, D>& C, const T& J) {
      { law.energy(C, J) } -> std::convertible_to<T>;
    } ||
    requires(const Law& law, const Matrix<T, D>& F) {
      { law.energy(F) } -> std::convertible_to<T>;
    });

/// The first Piola-Kirchhoff stress in Pa, \paper{7}: F S, at the deformation gradient `F`.
template <class Law, class T, int D>
[[nodiscard]] HMPS_INLINE Matrix<T, D> first_piola_kirchhoff(const Law& law, const Matrix<T, D>& F) {
  static_assert(detail::RequireLaw<Law, T, D>::value);
  if constexpr (DeformationGradientLaw<Law, T, D>) {
    return law.first_piola_kirchhoff(F);
  } else {
    const Matrix<T, D> C = right_cauchy_green(F);
    const T J = determinant(F);
    const Matrix<T, D> S = law.second_piola_kirchhoff(C, J);
    return product(F, S);
  }
}

namespace detail {
/// The Cauchy stress of the first Piola-Kirchhoff stress `P` at `F`.
template <class T, int D>
[[nodiscard]] Matrix<T, D> cauchy_of(const Matrix<T, D>& P, const Matrix<T, D>& F) {
  return P * F.transpose() / determinant(F);
}
}  // namespace detail

/// The strain energy per reference volume in J/m3 at the deformation gradient `F`.
template <class Law, class T, int D>
[[nodiscard]] T energy_density(const Law& law, const Matrix<T, D>& F) {
  static_assert(LawWithEnergy<Law, T, D>,
                "hmps: this law has no energy; give it energy(C, J), or energy(F) if it is a law of the deformation "
                "gradient, const and returning T");
  if constexpr (DeformationGradientLaw<Law, T, D>) {
    return law.energy(F);
  } else {
    const Matrix<T, D> C = right_cauchy_green(F);
    const T J = determinant(F);
    return law.energy(C, J);
  }
}

/// The speed of longitudinal waves in m/s at zero strain, sqrt((K + 4 G / 3) / rho), for a law with `bulk_modulus()`
/// and `shear_modulus()` in Pa and a `density` in kg/m3. Throws `InputError` if the density or K + 4 G / 3 is not
/// positive.
template <class Law, class P>
[[nodiscard]] auto sound_speed(const Law& law, P density) {
  static_assert(
      requires { law.bulk_modulus() + law.shear_modulus(); },
      "hmps: the sound speed needs a law with bulk_modulus() and shear_modulus()");
  detail::require(detail::is_finite(density) && density > P(0), "hmps: the density is ", density,
                  " kg/m3; it must be positive (soft tissue: about 1000)");
  const auto modulus = law.bulk_modulus() + law.shear_modulus() * P(4) / P(3);
  detail::require(detail::is_finite(modulus) && modulus > 0, "hmps: the modulus K + 4 G / 3 of the law is ", modulus,
                  " Pa, which gives no speed of sound; give a law with positive moduli (Poisson's ratio below 0.5)");
  return std::sqrt(modulus / density);
}

namespace detail {

/// Throws `InputError` unless the modulus `value` is positive and finite.
template <class P>
void require_modulus(P value, const char* law, const char* name, const char* remedy) {
  require(is_finite(value) && value > P(0), "hmps: the ", name, " of ", law, " is ", value,
          " Pa; it must be positive and finite: ", remedy);
}

/// Throws `InputError` if Poisson's ratio is below -1/2, that is K < G / 6, with both moduli in Pa: this is true of few
/// materials, but of every soft tissue whose moduli were interchanged. Between -1/2 and 0 there are materials, such as
/// some foams, for which these laws hold, and the method needs no more than positive moduli. What serves nearly
/// incompressible tissue only, `MooneyRivlin` and `split_bulk_modulus`, refuses all negative ratios, which other
/// mistakes lead to as well.
template <class P>
void require_order(P bulk, P shear, const char* law) {
  require(P(6) * bulk >= shear, "hmps: the bulk modulus of ", law, " is ", bulk, " Pa with a shear modulus of ", shear,
          " Pa, so that Poisson's ratio is ", (P(3) * bulk - P(2) * shear) / (P(6) * bulk + P(2) * shear),
          "; are the two interchanged? from_moduli takes the bulk modulus first");
}

/// The shear modulus in Pa of a Young's modulus in Pa and a Poisson's ratio.
template <class P>
[[nodiscard]] P shear_modulus_of(P young, P poisson) {
  return young / (P(1) + poisson) / P(2);
}
/// Lame's first constant in Pa of the same.
template <class P>
[[nodiscard]] P lame_lambda(P young, P poisson) {
  return young / (P(1) + poisson) * poisson / (P(1) - P(2) * poisson);
}
/// Throws `InputError` for Lame's constants `law.lambda` and `law.mu` in Pa of which the bulk or shear modulus is not
/// positive and finite, or Poisson's ratio below -1/2.
template <class Law>
void require_lame(const Law& law, const char* name) {
  require_modulus(law.mu, name, "shear modulus mu", "from_young_poisson needs E > 0 and Poisson's ratio > -1");
  require_modulus(law.bulk_modulus(), name, "bulk modulus lambda + 2 mu / 3",
                  "from_young_poisson needs Poisson's ratio < 0.5");
  require_order(law.bulk_modulus(), law.mu, name);
}

/// Throws `InputError` for a law that rejects its own parameters, and, if `material` is a callable that gives the law
/// of each of `size` particles, for a bulk or shear modulus that is not positive, with the particle.
template <class Material>
void require_material(const Material& material, std::size_t size) {
  if constexpr (requires { material.validate(); }) {
    material.validate();
  } else if constexpr (requires {
                         double(material(OneParticle{}).bulk_modulus() + material(OneParticle{}).shear_modulus());
                       }) {
    for (std::size_t i = 0; i < size; ++i) {
      const auto law = material(OneParticle{i});
      const auto bulk = static_cast<double>(law.bulk_modulus()), shear = static_cast<double>(law.shear_modulus());
      require(is_finite(bulk) && bulk > 0 && is_finite(shear) && shear > 0, "hmps: the law of particle ", i,
              " has the bulk modulus ", bulk, " Pa and the shear modulus ", shear,
              " Pa; both must be positive and finite");
    }
  }
}
}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
