// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/bonds/followed_bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/step.hpp"
#include "hmps/core/types.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/lanes/staging.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// The internal forces of one body, evaluated together in two sweeps over its bonds: one for the
/// deformation gradient and what follows from it, one for the sum in `Coupling`. A term that is not
/// named is not computed; where no term couples, the first sweep is left out, where none damps, no
/// velocity is read. A term of the mean dilatation adds two sweeps of one number per bond, `mean_dilatation<2>` four.
///
/// Refers to the bonds, which must outlive it and may be moved (in a `std::vector` of bodies, say), and keeps scratch
/// memory, but no state: one object serves any number of states in turn (not at the same time). `restrict_to` leaves
/// out what only particles with a forced displacement would need.
template <Bonds B, class... Terms>
class InternalForce {
 public:
  using Scalar = typename B::Scalar;
  static constexpr int dimension = B::dimension;

 private:
  using K = Scalar;
  static constexpr int D = dimension;
  using T = Lanes<K>;
  static_assert((ForceTerm<Terms, K, D> && ...),
                "hmps: a term of internal_force needs couple(particles, coupling), damping(bonds) or "
                "pressure(particles, theta); see ForceTerm");
  static constexpr bool dilates = (DilatationTerm<Terms, K, D> || ...);
  static constexpr int means = std::max({0, detail::means_of<Terms, K, D>()...});
  static_assert(((!DilatationTerm<Terms, K, D> || detail::means_of<Terms, K, D>() == means) && ...),
                "hmps: all terms of the mean dilatation in a force take the mean as often, once or twice");
  static constexpr bool couples = dilates || (CouplingTerm<Terms, K, D> || ...);
  static constexpr bool damps = (DampingTerm<Terms, K, D> || ...);

 public:
  explicit InternalForce(const B& bonds, Terms... terms)
      : followed_(bonds),
        bonds_(&bonds),
        terms_(std::move(terms)...),
        displacement_(bonds.slot_count()),
        velocity_(bonds.slot_count()),
        coupling_(bonds.slot_count()),
        dilatation_(bonds.slot_count()),
        pressure_(bonds.slot_count()) {
    std::apply([&](const auto&... term) { (check(term), ...); }, terms_);
    if constexpr (damps) {
      double sum = 0;
      std::apply([&](const auto&... term) { (add_damping(term, sum), ...); }, terms_);
      damping_ = static_cast<K>(sum);
    }
    if constexpr (dilates) scales_ = detail::neighbourhood_scales(bonds);
  }

  /// Evaluates from now on only what the particles need for which `moves(i)` holds: those that follow the force. What
  /// is written for the others, if anything, means nothing; terms such as `record` see the particles that move, those
  /// that they are bonded to, and what shares a block with either. Particles deep in a region whose motion is
  /// prescribed cost nothing but their place then.
  template <class Moves>
  requires std::predicate<Moves&, std::size_t>
  void restrict_to(Moves&& moves) {
    bonds_ = &bonds();
    std::vector<char> moving(bonds_->size());
    for (std::size_t i = 0; i < moving.size(); ++i) moving[i] = moves(i) ? 1 : 0;
    summed_ = blocks_of(moving);
    with_neighbours(moving);
    coupled_ = blocks_of(moving);
    if constexpr (dilates) {  // their pressure is that of neighbours, and so are the dilatations that make it
      for (int ring = 0; ring < 2 * means; ++ring) with_neighbours(moving);
      dilated_ = blocks_of(moving);
    }
    restricted_ = true;
  }

  /// Writes the force density (N/m3) of every particle at positions `x` (m) and velocities `v` (m/s)
  /// into `f`. Throws `InputError` for views of the wrong size; does not look at values: what is not
  /// finite reaches the neighbours and others of their blocks.
  template <class X, class V, class F, Executor E = Serial>
  void operator()(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<F, D>& f,
                  const E& execute = {}) {
    bonds_ = &bonds();
    require_size(f, bonds_->size(), "forces");
    require_sizes(x, v);
    require_apart(f, "forces", x, "positions");
    require_apart(f, "forces", v, "velocities");
    evaluate(x, v, execute, [&](std::size_t block, const auto& force) HMPS_INLINE_LAMBDA {
      detail::deliver(*bonds_, block, f, force);
    });
  }

  /// The same for terms that do not read velocities.
  template <class X, class F, Executor E = Serial>
  requires(!damps) void operator()(const VectorView<X, D>& x, const VectorView<F, D>& f, const E& execute = {}) {
    (*this)(x, x, f, execute);
  }

  /// Adds to the velocities `v` (m/s) what the forces give in the time `dt` (s), \paper{2}: what evaluation and `kick`
  /// do one after the other, in the last sweep itself, so that no array of forces is written or read. Density `rho` in
  /// kg/m3, a number or a `ScalarView`. After `restrict_to`, velocities of particles that do not follow the force mean
  /// nothing until they are prescribed. Throws `InputError` as those two do.
  template <class X, class V, PerParticle Rho, Executor E = Serial>
  void kick(const VectorView<X, D>& x, const VectorView<V, D>& v, const Rho& rho, double dt, const E& execute = {}) {
    static_assert(!std::is_const_v<V>, "hmps: kick changes the velocities; give it a writable view of them");
    bonds_ = &bonds();
    require_positive(rho, v.size(), "density", "kg/m3");
    require_sizes(x, v);
    require_apart(v, "velocities", x, "positions");
    detail::require_step(dt);
    // Other blocks read the velocities of the staged copy, so that these may change while they do.
    evaluate(x, v, execute, [&](std::size_t block, const auto& force) HMPS_INLINE_LAMBDA {
      detail::deliver(*bonds_, block, v, force, [&](V& velocity, K density, std::size_t i) HMPS_INLINE_LAMBDA {
        detail::kick(velocity, density, at_particle(rho, i), dt);
      });
    });
  }

  /// The bonds, wherever they are now. Throws `InputError` if they are no more.
  [[nodiscard]] const B& bonds() const { return followed_.now(); }
  /// Bytes of scratch memory.
  [[nodiscard]] std::size_t bytes() const {
    return displacement_.bytes() + velocity_.bytes() + coupling_.bytes() + dilatation_.bytes() + pressure_.bytes() +
           scales_.bytes() + (dilated_.size() + coupled_.size() + summed_.size()) * sizeof(Index);
  }

 private:
  template <class Term>
  void check(const Term& term) const {
    if constexpr (requires { term.check(bonds_->size()); }) term.check(bonds_->size());
  }

  template <class X, class V>
  void require_sizes(const VectorView<X, D>& x, const VectorView<V, D>& v) const {
    require_size(x, bonds_->size(), "positions");
    require_size(v, bonds_->size(), "velocities");
  }

  /// All sweeps at positions `x` and velocities `v`; the last calls `take(block, force)` with what gives the lanes of
  /// each component of the force density.
  template <class X, class V, class E, class Take>
  void evaluate(const VectorView<X, D>& x, const VectorView<V, D>& v, const E& execute, Take&& take) {
    const Vector<double, D> common = detail::common_displacement(*bonds_, x);
    execute(bonds_->block_count(), [&](std::size_t block) {
      if constexpr (couples) detail::stage_displacement(*bonds_, block, x, common, displacement_);
      if constexpr (damps) detail::stage(*bonds_, block, v, velocity_);
    });
    if constexpr (dilates) {
      const auto average = [&](std::size_t block) {
        detail::average_over_neighbourhood(*bonds_, block, scales_, dilatation_, pressure_);
      };
      sweep(dilated_, execute, [&](std::size_t block) { dilate(block); });
      if constexpr (means == 2) sweep(dilated_, execute, average);
      sweep(dilated_, execute, [&](std::size_t block) { press(block); });
      if constexpr (means == 2) sweep(dilated_, execute, average);
    }
    if constexpr (couples) sweep(coupled_, execute, [&](std::size_t block) { couple(block); });
    sweep(summed_, execute, [&](std::size_t block) { sum(block, take); });
  }

  /// The blocks with a particle that is marked.
  [[nodiscard]] std::vector<Index> blocks_of(const std::vector<char>& marked) const {
    std::vector<char> found(bonds_->block_count(), 0);
    for (std::size_t i = 0; i < marked.size(); ++i)
      if (marked[i]) found[bonds_->slot(i) / B::width] = 1;
    std::vector<Index> blocks;
    for (std::size_t block = 0; block < found.size(); ++block)
      if (found[block]) blocks.push_back(static_cast<Index>(block));
    return blocks;
  }
  /// Marks the neighbours of what is marked too.
  void with_neighbours(std::vector<char>& marked) const {
    const std::vector<char> before = marked;
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i]) bonds_->for_each_bond(i, [&](std::size_t j, const auto&, auto) { marked[j] = 1; });
  }
  /// Calls `visit(block)` for all blocks or, if the force is restricted, for those in `blocks`.
  template <class E, class Visit>
  void sweep(const std::vector<Index>& blocks, const E& execute, Visit&& visit) const {
    if (restricted_)
      execute(blocks.size(), [&](std::size_t k) { visit(blocks[k]); });
    else
      execute(bonds_->block_count(), visit);
  }
  template <class Term>
  void add_damping(const Term& term, double& sum) const {
    if constexpr (DampingTerm<Term, K, D>) sum += term.damping(*bonds_);
  }

  /// First of the sweeps that the mean dilatation needs: F, kept where the coupling will be, and d (J - 1).
  void dilate(std::size_t block) {
    const std::size_t slot = block * B::width;
    const Matrix<T, D> F =
        detail::deformation_gradient_lanes(*bonds_, block, displacement_, bonds_->shape_inverse_lanes(block));
    for (int k = 0; k < D * D; ++k) coupling_.keep(static_cast<std::size_t>(k), slot, F(k % D, k / D));
    dilatation_.keep(0, slot, scales_.lanes(0, slot) * (determinant(F) - T(1)));
  }
  /// Second of them: d U'(theta).
  void press(std::size_t block) {
    const std::size_t slot = block * B::width;
    const T d = scales_.lanes(0, slot);
    // Taken twice, the mean lies where that of the pressure will.
    auto &dilatation = means == 2 ? pressure_ : dilatation_, &kept = means == 2 ? dilatation_ : pressure_;
    const T theta = d * detail::sum_over_neighbourhood(*bonds_, block, dilatation);
    const Matrix<T, D> inverse = bonds_->shape_inverse_lanes(block), F = kept_gradient(block);
    const BlockOfParticles<K, D> particles(*bonds_, block, F, inverse);
    T pressure(0);
    std::apply([&](const auto&... term) { (detail::add_pressure(term, particles, theta, pressure), ...); }, terms_);
    kept.keep(0, slot, d * pressure);
  }
  [[nodiscard]] Matrix<T, D> kept_gradient(std::size_t block) const {
    Matrix<T, D> F;
    for (int k = 0; k < D * D; ++k) F(k % D, k / D) = coupling_.lanes(static_cast<std::size_t>(k), block * B::width);
    return F;
  }

  /// What the particles of `block` carry to their bonds.
  void couple(std::size_t block) {
    const std::size_t slot = block * B::width;
    displacement_.prefetch(bonds_->last_slot(block) + ahead);
    const Matrix<T, D> inverse = bonds_->shape_inverse_lanes(block);
    const Matrix<T, D> F = [&] {
      if constexpr (dilates)
        return kept_gradient(block);
      else
        return detail::deformation_gradient_lanes(*bonds_, block, displacement_, inverse);
    }();
    const BlockOfParticles<K, D> particles(*bonds_, block, F, inverse);
    Coupling<K, D> coupling;
    for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) = T(0);
    coupling.c = T(0);
    std::apply([&](const auto&... term) { (detail::add_coupling(term, particles, coupling), ...); }, terms_);
    if constexpr (dilates) {
      const T pressure = scales_.lanes(0, slot) * detail::sum_over_neighbourhood(*bonds_, block, pressure_);
      const Matrix<T, D> push = product(cofactor(F), inverse);
      for (int k = 0; k < D * D; ++k) coupling.M(k % D, k / D) += pressure * push(k % D, k / D);
    }
    // The last sweep works on displacements: c r_ij = c r0_ij + c (u_j - u_i).
    for (int d = 0; d < D; ++d) coupling.M(d, d) += coupling.c;
    for (int k = 0; k < D * D; ++k) coupling_.keep(static_cast<std::size_t>(k), slot, coupling.M(k % D, k / D));
    coupling_.keep(D * D, slot, coupling.c);
  }

  /// The last sweep: the sum in `Coupling` over the bonds of the particles of `block`.
  template <class Take>
  void sum(std::size_t block, const Take& take) const {
    const std::size_t slot = block * B::width;
    const std::size_t last = bonds_->last_slot(block);
    displacement_.prefetch(last + ahead);
    velocity_.prefetch(last + ahead);
    coupling_.prefetch(last + ahead);
    Vector<T, D> force, u, v, drag;
    T c(0);
    for (int d = 0; d < D; ++d) force[d] = drag[d] = T(0);
    if constexpr (couples) {
      for (int col = 0; col < D; ++col) {
        const T asymmetry = bonds_->asymmetry_lanes(block, col);
        for (int row = 0; row < D; ++row)
          force[row] += coupling_.lanes(static_cast<std::size_t>(row + D * col), slot) * asymmetry;
      }
      c = coupling_.lanes(D * D, slot);
      for (int d = 0; d < D; ++d) u[d] = displacement_.lanes(static_cast<std::size_t>(d), slot);
    }
    if constexpr (damps)
      for (int d = 0; d < D; ++d) v[d] = velocity_.lanes(static_cast<std::size_t>(d), slot);

    bonds_->for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
      const T w = bond.weight();
      if constexpr (couples) {
        const auto coupling = bond.gather(coupling_);
        const auto displacement = bond.gather(displacement_);
        const T stretch = c + coupling[D * D];
        const auto stretched = [&](int row) HMPS_INLINE_LAMBDA {
          return stretch * (displacement[static_cast<std::size_t>(row)] - u[row]);
        };
        const auto carried = [&](int row, int col) HMPS_INLINE_LAMBDA {
          return coupling[static_cast<std::size_t>(row + D * col)] * bond.offset(col);
        };
        // What a bond pulls is apart from the sum of all bonds, so that one need not wait for the one before.
        if constexpr (std::remove_cvref_t<decltype(bond)>::skips) {
          Vector<T, D> pull;
          for (int row = 0; row < D; ++row) pull[row] = stretched(row);
          for (int col = 0; col < D; ++col)
            if (bond.along(col))
              for (int row = 0; row < D; ++row) pull[row] += carried(row, col);
          for (int row = 0; row < D; ++row) force[row] += w * pull[row];
        } else {  // With nothing to skip this order is faster, by an eighth in double.
          for (int row = 0; row < D; ++row) {
            T pull = stretched(row);
            for (int col = 0; col < D; ++col) pull += carried(row, col);
            force[row] += w * pull;
          }
        }
      }
      if constexpr (damps) {
        const auto velocity = bond.gather(velocity_);
        for (int d = 0; d < D; ++d) drag[d] += w * (velocity[static_cast<std::size_t>(d)] - v[d]);
      }
    });
    if constexpr (damps)
      for (int d = 0; d < D; ++d) force[d] += damping_ * drag[d];
    take(block, [&](int d) { return force[d]; });
  }

  /// How far ahead of what a block needs memory is asked for: some hundred nanoseconds of work.
  static constexpr std::size_t ahead = 4 * B::width;

  detail::FollowedBonds<B> followed_;
  const B* bonds_;  // where they were last seen
  std::tuple<Terms...> terms_;
  typename B::template Slots<std::size_t{couples ? D : 0}> displacement_;
  typename B::template Slots<std::size_t{damps ? D : 0}> velocity_;
  typename B::template Slots<std::size_t{couples ? D * D + 1 : 0}> coupling_;                // M, c
  typename B::template Slots<std::size_t{dilates ? 1 : 0}> dilatation_, pressure_, scales_;  // d (J - 1), d U', d
  bool restricted_ = false;
  std::vector<Index> dilated_, coupled_, summed_;  // if restricted, the blocks that each sweep visits
  K damping_ = 0;
};

/// The internal force of the body held together by `bonds`, made of `terms`:
/// `internal_force(bonds, elastic(law), artificial(E_hat), viscous(rho, nu))`.
template <Bonds B, class... Terms>
[[nodiscard]] InternalForce<B, Terms...> internal_force(const B& bonds, Terms... terms) {
  return InternalForce<B, Terms...>(bonds, std::move(terms)...);
}
/// The bonds are referred to, not copied: they must outlive the force.
template <Bonds B, class... Terms>
void internal_force(const B&& bonds, Terms... terms) = delete;

}  // namespace hmps::inline HMPS_ABI
