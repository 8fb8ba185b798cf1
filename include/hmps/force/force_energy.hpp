// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <numeric>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/detail/parts_of_force.hpp"
#include "hmps/lanes/detail/volume_shares.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// The energy of a body for each of the `N` terms of its force, in the order of the arguments, in J (in two dimensions
/// per metre of thickness). It is zero for terms without an energy, such as viscosity.
template <std::size_t N>
struct ForceEnergy {
  std::array<double, N> of_term{};

  [[nodiscard]] double total() const { return std::accumulate(of_term.begin(), of_term.end(), 0.0); }
};

/// One particle, in double, as the argument of what a term returns for output: `term.energy(particle)` is an energy per
/// reference volume in J/m3, `term.stress(particle)` a first Piola-Kirchhoff stress in Pa, and
/// `term.pressure(particle)` of a `DilatationTerm` is dU/dtheta in Pa. Like any `OneParticle` it returns parameters,
/// `particle(view)`. A `PairTerm` instead has `term.energy(bond)`, of a `BondState<double, D>`, whose derivative with
/// respect to |r| is the tension; each bond counts once.
template <Bonds B>
class ParticleState : public OneParticle {
 public:
  static constexpr int dimension = B::dimension;
  using Vectors = std::vector<Vector<double, dimension>>;
  using Gradients = std::vector<Matrix<double, dimension>>;

  ParticleState(std::size_t i, const B& bonds, const Vectors& x, const Gradients& F, const std::vector<double>& theta)
      : OneParticle{i}, position(x[i]), deformation_gradient(F[i]), bonds_(bonds), x_(x), theta_(theta) {}

  const Vector<double, dimension>& position;              ///< x in m.
  const Matrix<double, dimension>& deformation_gradient;  ///< F, \paper{11}.

  /// 1 / sum |r0|^2 w in 1/m2, the denominator of \paper{20}.
  [[nodiscard]] double inverse_shape_trace() const { return 1.0 / static_cast<double>(bonds_.shape_trace(index)); }

  /// sum_j |r_ij - F r0_ij|^2 w_ij in m2, the error functional of \paper{9}.
  [[nodiscard]] double misfit() const {
    const Matrix<double, dimension> strain = deformation_gradient - Matrix<double, dimension>::Identity();
    double sum = 0;
    visit_bonds([&](const Vector<double, dimension>& r0, const Vector<double, dimension>& relative, double w) {
      sum += w * (relative - strain * r0).squaredNorm();
    });
    return sum;
  }

  /// sum_j (|r_ij| - |F r0_ij|)^2 w_ij in m2, the part of `misfit` along the bonds, to first order.
  [[nodiscard]] double length_misfit() const {
    double sum = 0;
    visit_bonds([&](const Vector<double, dimension>& r0, const Vector<double, dimension>& relative, double w) {
      const double length = (r0 + relative).norm(), predicted = (deformation_gradient * r0).norm();
      sum += w * (length - predicted) * (length - predicted);
    });
    return sum;
  }

  /// theta of `MeanDilatation`. Throws `InputError` if the force has no term of the mean dilatation.
  [[nodiscard]] double mean_dilatation() const {
    detail::require(
        !theta_.empty(),
        "hmps: a term uses the mean dilatation in a force without such a term; give the term pressure(...)");
    return theta_[index];
  }

  /// Calls `visit(r0, u_j - u_i, w)` for each bond, in m.
  template <class Visit>
  void visit_bonds(Visit&& visit) const {
    bonds_.for_each_bond(index, [&](std::size_t j, const auto& r0, auto w) {
      const Vector<double, dimension> reference = r0.template cast<double>();
      const Vector<double, dimension> relative = (x_[j] - bonds_.reference(j)) - (position - bonds_.reference(index));
      visit(reference, relative, static_cast<double>(w));
    });
  }

 private:
  const B& bonds_;
  const Vectors& x_;
  const std::vector<double>& theta_;
};

namespace detail {

/// The energy of `term` per volume of one particle in J/m3; zero for terms without an energy.
template <class Term, Bonds B>
[[nodiscard]] double energy_of_term(const Term& term, const ParticleState<B>& particle) {
  using K = typename B::Scalar;
  constexpr int D = B::dimension;
  double sum = 0;
  if constexpr (PairTerm<Term, K, D>) {
    static_assert(
        requires(const BondState<double, D>& bond) {
          { term.energy(bond) } -> std::convertible_to<double>;
        },
        "hmps: a pair term has an energy only with energy(bond), of a BondState<double, D>, in J/m3");
    particle.visit_bonds([&](const Vector<double, D>& r0, const Vector<double, D>& relative, double w) {
      sum += 0.5 * static_cast<double>(term.energy(BondState<double, D>(r0, relative, w)));
    });
  }
  if constexpr (CouplingTerm<Term, K, D> || DilatationTerm<Term, K, D> || LengthTerm<Term, K, D> ||
                BodyForceTerm<Term, K, D>) {
    static_assert(
        requires {
          { term.energy(particle) } -> std::convertible_to<double>;
        },
        "hmps: this term has no energy(particle), of a ParticleState, in J/m3; let it return 0 if it stores none");
    sum += static_cast<double>(term.energy(particle));
  }
  return sum;
}

/// The mean of `values` over each particle and its neighbours, as in `MeanDilatation`, taken `means` times.
template <Bonds B, class E>
[[nodiscard]] std::vector<double> neighbourhood_means(const B& bonds, std::vector<double> values,
                                                      const typename B::template Slots<1>& scales, int means,
                                                      const E& execute) {
  const auto scale = [&](std::size_t k) { return static_cast<double>(scales(0, bonds.slot(k))); };
  std::vector<double> mean(bonds.size());
  for (int pass = 0; pass < means; ++pass) {
    guarded(execute)(bonds.size(), [&](std::size_t i) {
      double sum = volume_share(bonds, i) * scale(i) * values[i];
      bonds.for_each_bond(
          i, [&](std::size_t j, const auto&, auto) { sum += volume_share(bonds, j) * scale(j) * values[j]; });
      mean[i] = scale(i) * sum;
    });
    std::swap(values, mean);
  }
  return values;
}

/// theta of `MeanDilatation` of each particle, from the deformation gradients `F` with the growth of `terms`; the mean
/// is taken `means` times.
template <Bonds B, class Gradients, class E, class... Terms>
[[nodiscard]] std::vector<double> mean_dilatations(const B& bonds, const std::tuple<Terms...>& terms,
                                                   const Gradients& F, const typename B::template Slots<1>& scales,
                                                   int means, const E& execute) {
  constexpr int D = B::dimension;
  std::vector<double> dilatation(bonds.size());
  guarded(execute)(bonds.size(), [&](std::size_t i) {
    dilatation[i] = determinant(Matrix<double, D>(F[i].template cast<double>())) -
                    growth_of<typename B::Scalar, D, double>(terms, OneParticle{i});
  });
  return neighbourhood_means(bonds, std::move(dilatation), scales, means, execute);
}

/// The state of a body in double, from which the energies and stresses of its terms follow.
template <Bonds B>
struct BodyState {
  /// At the positions `x`; with `scales`, those of the mean dilatation of `terms`.
  template <class... Terms, class X, class E>
  BodyState(const B& all_bonds, const std::tuple<Terms...>& terms, const VectorView<X, B::dimension>& x,
            const typename B::template Slots<1>* scales, const E& execute)
      : bonds(all_bonds), positions(all_bonds.size()), F(all_bonds.size()) {
    for (std::size_t i = 0; i < positions.size(); ++i) positions[i] = x[i].template cast<double>();
    deformation_gradient(bonds, x, matrices(F), execute);
    constexpr int means = PartsOfForce<typename B::Scalar, B::dimension, Terms...>::means;
    if (scales != nullptr) theta = mean_dilatations(bonds, terms, F, *scales, means, execute);
  }
  [[nodiscard]] ParticleState<B> particle(std::size_t i) const { return {i, bonds, positions, F, theta}; }

  const B& bonds;
  typename ParticleState<B>::Vectors positions;
  typename ParticleState<B>::Gradients F;
  std::vector<double> theta;  ///< empty without scales
};

/// The energies of `terms` at the positions `x`; see `InternalForce::energy`.
template <Bonds B, class... Terms, class X, PerParticle Vol, class E>
[[nodiscard]] ForceEnergy<sizeof...(Terms)> energies(const B& bonds, const std::tuple<Terms...>& terms,
                                                     const typename B::template Slots<1>* scales,
                                                     const VectorView<X, B::dimension>& x, const Vol& volume,
                                                     const E& execute) {
  constexpr std::size_t N = sizeof...(Terms);
  const BodyState<B> body(bonds, terms, x, scales, execute);
  using Energies = std::array<double, N>;
  const Energies sum = reduce(
      bonds.size(), Energies{},
      [&](std::size_t i) {
        const ParticleState<B> particle = body.particle(i);
        const auto own = static_cast<double>(at_particle(volume, i));
        return std::apply([&](const auto&... term) { return Energies{own * energy_of_term(term, particle)...}; },
                          terms);
      },
      [](Energies a, const Energies& b) {
        for (std::size_t k = 0; k < N; ++k) a[k] += b[k];
        return a;
      },
      execute);
  return {sum};
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
