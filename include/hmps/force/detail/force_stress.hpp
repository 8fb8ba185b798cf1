// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/detail/parts_of_force.hpp"
#include "hmps/force/force_energy.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `StateError` at the first particle whose `values`, called `name`, are not finite.
template <int D, class R, int N, class Gradients>
void require_finite_result(const View<R, N>& values, const Gradients& F, const char* name) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    bool finite = true;
    for (int c = 0; c < N; ++c) finite = finite && is_finite(values(i, c));
    if (finite) continue;
    const Matrix<double, D> gradient = F[i].template cast<double>();
    throw StateError(message("hmps: the ", name, " of particle ", i, " is not finite; its deformation gradient has ",
                             "det F = ", determinant(gradient),
                             ": if that is not positive, the particle is crushed or turned inside out; use a "
                             "smaller step, or wrap the law as Continued{law}"));
  }
}

/// The first Piola-Kirchhoff stress of `term` in one particle in Pa; zero for terms that do not act through F.
template <class Term, Bonds B, int D = B::dimension>
[[nodiscard]] Matrix<double, D> stress_of_term(const Term& term, const ParticleState<B>& particle) {
  if constexpr (CouplingTerm<Term, typename B::Scalar, D>) {
    static_assert(
        requires {
          { term.stress(particle) } -> std::convertible_to<Matrix<double, D>>;
        },
        "hmps: this term has no stress(particle), of a ParticleState, in Pa; let it return 0 if it has none");
    return term.stress(particle);
  } else {
    return Matrix<double, D>::Zero();
  }
}

/// dU/dtheta of `term` in one particle in Pa; zero for terms that do not resist the mean dilatation.
template <class Term, Bonds B>
[[nodiscard]] double pressure_of_term(const Term& term, const ParticleState<B>& particle) {
  if constexpr (DilatationTerm<Term, typename B::Scalar, B::dimension>) {
    static_assert(
        requires {
          { term.pressure(particle) } -> std::convertible_to<double>;
        },
        "hmps: this term of the mean dilatation has no pressure(particle), of a ParticleState, in Pa, for stresses");
    return static_cast<double>(term.pressure(particle));
  } else {
    return 0;
  }
}

/// The first Piola-Kirchhoff stress in Pa that `terms` give each particle of `body`: that of the law, and the averaged
/// pressure of `MeanDilatation`, p cof F. Throws `StateError` at the first particle whose law gives a stress that is
/// not finite, before averaging spreads it.
template <Bonds B, class... Terms, class E, int D = B::dimension>
[[nodiscard]] std::vector<Matrix<double, D>> stresses(const BodyState<B>& body, const std::tuple<Terms...>& terms,
                                                      const typename B::template Slots<1>* scales, const E& execute) {
  const std::size_t n = body.bonds.size();
  std::vector<Matrix<double, D>> P(n);
  guarded(execute)(n, [&](std::size_t i) {
    const auto sum = [&](const auto&... term) {
      return (Matrix<double, D>::Zero().eval() + ... + stress_of_term(term, body.particle(i))).eval();
    };
    P[i] = std::apply(sum, terms);
  });
  require_finite_result<D>(matrices(P), body.F, "stress by the law");
  std::vector<double> pressure(n);
  if (scales != nullptr) {
    guarded(execute)(n, [&](std::size_t i) {
      const auto sum = [&](const auto&... term) { return (0.0 + ... + pressure_of_term(term, body.particle(i))); };
      pressure[i] = std::apply(sum, terms);
    });
    constexpr int means = PartsOfForce<typename B::Scalar, D, Terms...>::means;
    pressure = neighbourhood_means(body.bonds, std::move(pressure), *scales, means, execute);
  }
  guarded(execute)(n, [&](std::size_t i) { P[i] += pressure[i] * cofactor(body.F[i]); });
  return P;
}

}  // namespace hmps::inline HMPS_ABI::detail
