// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/detail/bond_lengths.hpp"
#include "hmps/force/detail/parts_of_force.hpp"
#include "hmps/lanes/detail/multiply_add.hpp"
#include "hmps/lanes/detail/staging.hpp"
#include "hmps/lanes/detail/volume_shares.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The arithmetic of `InternalForce`, a block at a time, and its scratch memory.
template <Bonds B, class... Terms>
class ForceSweeps {
  using K = typename B::Scalar;
  static constexpr int D = B::dimension;
  using T = Lanes<K>;

 public:
  using Parts = PartsOfForce<K, D, Terms...>;
  static constexpr int means = Parts::means;
  static constexpr bool dilates = Parts::dilates, couples = Parts::couples, damps = Parts::damps;

  ForceSweeps(const B& bonds, Terms... terms)
      : terms_(std::move(terms)...),
        displacement_(bonds.slot_count()),
        velocity_(bonds.slot_count()),
        coupling_(bonds.slot_count()),
        lengths_(bonds.slot_count()),
        damping_each_(bonds.slot_count()),
        dilatation_(bonds.slot_count()),
        pressure_(bonds.slot_count()) {
    std::apply([&](const auto&... term) { (detail::check_term(term, bonds), ...); }, terms_);
    if constexpr (damps) {
      double sum = 0;
      std::apply([&](const auto&... term) { (add_damping(term, bonds, sum), ...); }, terms_);
      damping_ = static_cast<K>(sum);
    }
    if constexpr (dilates) scales_ = detail::neighbourhood_scales(bonds);
  }

  [[nodiscard]] const std::tuple<Terms...>& terms() const { return terms_; }
  /// The d of `MeanDilatation`; empty without such a term.
  [[nodiscard]] const auto& scales() const { return scales_; }
  [[nodiscard]] std::size_t bytes() const {
    return displacement_.bytes() + velocity_.bytes() + coupling_.bytes() + lengths_.bytes() + damping_each_.bytes() +
           dilatation_.bytes() + pressure_.bytes() + scales_.bytes();
  }

  /// Sets to zero what the sweeps wrote: blocks that are not evaluated from now on are read with a weight of zero,
  /// which does not remove a NaN.
  void forget(const B& bonds) {
    coupling_ = decltype(coupling_)(bonds.slot_count());
    lengths_ = decltype(lengths_)(bonds.slot_count());
    dilatation_ = decltype(dilatation_)(bonds.slot_count());
    pressure_ = decltype(pressure_)(bonds.slot_count());
  }

  /// Copies the state of the particles of `block` to the slots.
  template <class X, class V>
  HMPS_INLINE void stage_state(const B& bonds, std::size_t block, const VectorView<X, D>& x, const VectorView<V, D>& v,
                               const CommonDisplacement<D>& common) {
    if constexpr (Parts::displaces) detail::stage_displacement(bonds, block, x, common, displacement_);
    if constexpr (damps) detail::stage(bonds, block, v, velocity_);
    if constexpr (Parts::damps_each) {
      const BlockParameters<K, D> particles(bonds, block);
      T sum(damping_);
      std::apply([&](const auto&... term) { (add_damping_of_each(term, particles, sum), ...); }, terms_);
      damping_each_.store(0, block * B::width, sum);
    }
  }

  /// First sweep of the mean dilatation: F, stored in the memory of the coupling, and v d (J - G).
  void dilate(const B& bonds, std::size_t block) {
    const std::size_t slot = block * B::width;
    const Matrix<T, D> F =
        detail::deformation_gradient_lanes(bonds, block, displacement_, bonds.shape_inverse_lanes(block));
    for (int k = 0; k < D * D; ++k) coupling_.store(static_cast<std::size_t>(k), slot, F(k % D, k / D));
    const T growth = growth_of<K, D, T>(terms_, BlockParameters<K, D>(bonds, block));
    dilatation_.store(0, slot, carried_scale(bonds, block) * (determinant(F) - growth));
  }
  /// Second sweep of the mean dilatation: v d U'(theta).
  void press(const B& bonds, std::size_t block) {
    const std::size_t slot = block * B::width;
    const T d = scales_.lanes(0, slot);
    // If the mean is taken twice, `average` has written the dilatation to pressure_.
    auto &dilatation = means == 2 ? pressure_ : dilatation_, &kept = means == 2 ? dilatation_ : pressure_;
    const T theta = d * detail::sum_over_neighbourhood(bonds, block, dilatation);
    const Matrix<T, D> inverse = bonds.shape_inverse_lanes(block), F = kept_gradient(block);
    const BlockOfParticles<K, D> particles(bonds, block, F, inverse);
    T pressure(0);
    std::apply([&](const auto&... term) { (add_pressure(term, particles, theta, pressure), ...); }, terms_);
    kept.store(0, slot, carried_scale(bonds, block) * pressure);
  }
  /// If the mean is taken twice: the additional mean, of the dilatation before `press` and of the pressure after it.
  void average(const B& bonds, std::size_t block) {
    const std::size_t slot = block * B::width;
    const T d = scales_.lanes(0, slot);
    pressure_.store(0, slot,
                    carried_scale(bonds, block) * (d * detail::sum_over_neighbourhood(bonds, block, dilatation_)));
  }
  /// Computes the coupling of the particles of `block`.
  void couple(const B& bonds, std::size_t block) {
    const std::size_t slot = block * B::width;
    displacement_.prefetch(bonds.last_slot(block) + ahead);
    const Matrix<T, D> inverse = bonds.shape_inverse_lanes(block);
    const Matrix<T, D> F = [&] {
      if constexpr (dilates)
        return kept_gradient(block);
      else
        return detail::deformation_gradient_lanes(bonds, block, displacement_, inverse);
    }();
    const BlockOfParticles<K, D> particles(bonds, block, F, inverse);
    Coupling<K, D> coupling;
    for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) = T(0);
    coupling.c = T(0);
    std::apply([&](const auto&... term) { (add_coupling(term, particles, coupling), ...); }, terms_);
    if constexpr (dilates) {
      const T pressure = scales_.lanes(0, slot) * detail::sum_over_neighbourhood(bonds, block, pressure_);
      const Matrix<T, D> push = product(cofactor(F), inverse);
      for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) += pressure * push(k % D, k / D);
    }
    if constexpr (Parts::predicts) {
      const PredictedLengths<T, D> own(F, detail::length_stiffness_of<K, D>(terms_, particles));
      own.store(lengths_, slot);
      const Matrix<T, D> push = product(product(F, detail::length_stress(bonds, block, displacement_, own)), inverse);
      for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) += push(k % D, k / D);
    }
    // The last sweep works on displacements: c r_ij = c r0_ij + c (u_j - u_i).
    for (int d = 0; d < D; ++d) coupling.M(d, d) += coupling.c;
    for (int k = 0; k < D * D; ++k) coupling_.store(static_cast<std::size_t>(k), slot, coupling.M(k % D, k / D));
    coupling_.store(D * D, slot, coupling.c);
  }

  /// The last sweep: the sum in `Coupling` over the bonds of the particles of `block`.
  template <class Take>
  void sum(const B& bonds, std::size_t block, const Take& take) const {
    const std::size_t slot = block * B::width, next = bonds.last_slot(block) + ahead;
    displacement_.prefetch(next);
    velocity_.prefetch(next);
    damping_each_.prefetch(next);
    coupling_.prefetch(next);
    lengths_.prefetch(next);
    Vector<T, D> force, u, v, drag;
    T c(0);
    for (int d = 0; d < D; ++d) force[d] = drag[d] = T(0);
    if constexpr (couples) {
      for (int col = 0; col < D; ++col) {
        const T asymmetry = bonds.asymmetry_lanes(block, col);
        for (int row = 0; row < D; ++row)
          force[row] += coupling_.lanes(static_cast<std::size_t>(row + D * col), slot) * asymmetry;
      }
      c = coupling_.lanes(D * D, slot);
    }
    if constexpr (Parts::displaces)
      for (int d = 0; d < D; ++d) u[d] = displacement_.lanes(static_cast<std::size_t>(d), slot);
    if constexpr (damps)
      for (int d = 0; d < D; ++d) v[d] = velocity_.lanes(static_cast<std::size_t>(d), slot);

    [[maybe_unused]] PredictedLengths<T, D> own;
    if constexpr (Parts::predicts) own.load(lengths_, slot);
    bonds.for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
      static_assert(RequireRow<std::remove_cvref_t<decltype(bond)>, B>::value);
      if constexpr (couples) add_coupled(bond, c, u, force);
      if constexpr (Parts::predicts) detail::adjust_length(bond, displacement_, lengths_, u, own, force);
      if constexpr (Parts::pairs) pull(bond, u, force);
      if constexpr (damps) {
        const auto velocity = bond.gather(velocity_);
        const T share = [&] {
          if constexpr (Parts::damps_each)
            return bond.weight() * (damping_each_.lanes(0, slot) + bond.gather(damping_each_)[0]);
          else
            return bond.weight();
        }();
        for (int d = 0; d < D; ++d) drag[d] += share * (velocity[static_cast<std::size_t>(d)] - v[d]);
      }
    });
    if constexpr (damps)
      for (int d = 0; d < D; ++d) force[d] += (Parts::damps_each ? K(0.5) : damping_) * drag[d];
    if constexpr (Parts::acts) {
      const BlockParameters<K, D> particles(bonds, block);
      std::apply([&](const auto&... term) { (add_body_force(term, particles, force), ...); }, terms_);
    }
    take(block, [&](int d) { return force[d]; });
  }

 private:
  template <class Term>
  static void add_damping(const Term& term, const B& bonds, double& sum) {
    if constexpr (DampingTerm<Term, K, D>) sum += term.damping(bonds);
  }
  template <class Term>
  HMPS_INLINE static void add_damping_of_each(const Term& term, const BlockParameters<K, D>& particles, T& sum) {
    if constexpr (DampingOfEachTerm<Term, K, D>) sum += term.damping(particles);
  }
  template <class Term>
  HMPS_INLINE static void add_pressure(const Term& term, const BlockOfParticles<K, D>& particles, const T& theta,
                                       T& pressure) {
    if constexpr (DilatationTerm<Term, K, D>) pressure += term.pressure(particles, theta);
  }
  template <class Term>
  HMPS_INLINE static void add_coupling(const Term& term, const BlockOfParticles<K, D>& particles,
                                       Coupling<K, D>& coupling) {
    if constexpr (CouplingTerm<Term, K, D>) term.couple(particles, coupling);
  }
  template <class Term>
  HMPS_INLINE static void add_tension(const Term& term, const BondState<T, D>& bond, T& tension) {
    if constexpr (PairTerm<Term, K, D>) tension += term.tension(bond);
  }
  template <class Term>
  HMPS_INLINE static void add_body_force(const Term& term, const BlockParameters<K, D>& particles,
                                         Vector<T, D>& force) {
    if constexpr (BodyForceTerm<Term, K, D>) {
      const Vector<T, D> own = term.body_force(particles);
      for (int d = 0; d < D; ++d) force[d] += own[d];
    }
  }

  /// Adds the contribution of M and c of both ends along one bond, in displacements.
  template <class Row>
  HMPS_INLINE void add_coupled(const Row& bond, const T& c, const Vector<T, D>& u, Vector<T, D>& force) const {
    const T w = bond.weight();
    const auto coupling = bond.gather(coupling_);
    const auto displacement = bond.gather(displacement_);
    const T stretch = c + coupling[D * D];
    // The force of a bond is computed separately from the sum, so that bonds need not wait for each other.
    // A component of r0 that is zero changes no bit here, so that a row may or may not skip it.
    Vector<T, D> pull;
    for (int row = 0; row < D; ++row) {
      const T relative = displacement[static_cast<std::size_t>(row)] - u[row];
      pull[row] = bond.along(0) ? detail::multiply_add(stretch, relative,
                                                       coupling[static_cast<std::size_t>(row)] * bond.offset(0))
                                : stretch * relative;
    }
    for (int col = 1; col < D; ++col)
      if (bond.along(col))
        for (int row = 0; row < D; ++row)
          pull[row] =
              detail::multiply_add(coupling[static_cast<std::size_t>(row + D * col)], T(bond.offset(col)), pull[row]);
    for (int row = 0; row < D; ++row) force[row] += w * pull[row];
  }

  /// Adds the pair terms along one bond. Coincident particles define no direction and exert no such force.
  template <class Row>
  HMPS_INLINE void pull(const Row& bond, const Vector<T, D>& u, Vector<T, D>& force) const {
    const auto neighbour = bond.gather(displacement_);
    Vector<T, D> r0, relative;
    for (int d = 0; d < D; ++d) {
      r0[d] = bond.along(d) ? T(bond.offset(d)) : T(0);
      relative[d] = neighbour[static_cast<std::size_t>(d)] - u[d];
    }
    const T w = bond.weight();
    const BondState<T, D> state(r0, relative, w);
    T tension(0);
    std::apply([&](const auto&... term) { (add_tension(term, state, tension), ...); }, terms_);
    const T length = state.length();
    const T share = select(w > K(0), select(length > K(0), tension / length, T(0)), T(0));
    for (int d = 0; d < D; ++d) force[d] += share * (r0[d] + relative[d]);
  }

  /// The d of a particle in the sums of others: v d, where v = V / l0^D.
  [[nodiscard]] HMPS_INLINE T carried_scale(const B& bonds, std::size_t block) const {
    return detail::volume_share_lanes(bonds, block) * scales_.lanes(0, block * B::width);
  }

  [[nodiscard]] Matrix<T, D> kept_gradient(std::size_t block) const {
    Matrix<T, D> F;
    for (int k = 0; k < D * D; ++k) F(k % D, k / D) = coupling_.lanes(static_cast<std::size_t>(k), block * B::width);
    return F;
  }

  /// Prefetch distance in slots: some hundred nanoseconds of work.
  static constexpr std::size_t ahead = 4 * B::width;

  std::tuple<Terms...> terms_;
  typename B::template Slots<std::size_t{Parts::displaces ? D : 0}> displacement_;
  typename B::template Slots<std::size_t{damps ? D : 0}> velocity_;
  typename B::template Slots<std::size_t{couples ? D * D + 1 : 0}> coupling_;                // M, c
  typename B::template Slots<Parts::predicts ? PredictedLengths<T, D>::count : 0> lengths_;  // F^T F - 1, C
  typename B::template Slots<std::size_t{Parts::damps_each ? 1 : 0}> damping_each_;          // d
  typename B::template Slots<std::size_t{dilates ? 1 : 0}> dilatation_, pressure_, scales_;  // d (J - G), d U', d
  K damping_ = 0;
};

}  // namespace hmps::inline HMPS_ABI::detail
