// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lane_math.hpp"

namespace hmps::inline HMPS_ABI {

/// One block of particles, one per lane, with their parameters: the argument of terms that need no deformation.
template <class K, int D>
class BlockParameters {
 public:
  using T = Lanes<K>;

  BlockParameters(const Blocks<K, D>& blocks, std::size_t block) : blocks_(blocks), block_(block) {}

  /// 1 / sum |r0|^2 w in 1/m2, the denominator of \paper{20}.
  [[nodiscard]] HMPS_INLINE T inverse_shape_trace() const { return blocks_.inverse_trace_lanes(block_); }

  /// The particle in `lane`, or `Blocks::none` after the last one.
  [[nodiscard]] HMPS_INLINE Index particle(int lane) const {
    return blocks_.particle(block_ * Blocks<K, D>::width + static_cast<std::size_t>(lane));
  }

  [[nodiscard]] HMPS_INLINE const Blocks<K, D>& blocks() const { return blocks_; }
  [[nodiscard]] HMPS_INLINE std::size_t block() const { return block_; }

  /// A parameter per particle, from the user's array. Throws `InputError` if the array has another size.
  template <class P>
  [[nodiscard]] HMPS_INLINE T operator()(const ScalarView<P>& parameter) const {
    require_size(parameter, blocks_.size(), "parameters");
    if (blocks_.consecutive(block_) && parameter.stride() == static_cast<std::ptrdiff_t>(sizeof(P))) {
      const P* const first = parameter.base(0) + particle(0);
      T result;
      for (int l = 0; l < T::width; ++l) result.lane[l] = static_cast<K>(first[l]);
      return result;
    }
    return gather([&](Index i) { return parameter[i]; });
  }
  /// A vector per particle, such as the direction of its fibres. Throws `InputError` if the array has another size.
  template <class P>
  [[nodiscard]] HMPS_INLINE Vector<T, D> operator()(const VectorView<P, D>& parameter) const {
    require_size(parameter, blocks_.size(), "vectors");
    Vector<T, D> result;
    for (int c = 0; c < D; ++c) result[c] = gather([&](Index i) { return parameter(i, c); });
    return result;
  }
  /// A tensor per particle, such as that of its growth. Throws `InputError` if the array has another size.
  template <class P>
  [[nodiscard]] HMPS_INLINE Matrix<T, D> operator()(const MatrixView<P, D>& parameter) const {
    require_size(parameter, blocks_.size(), "tensors");
    Matrix<T, D> result;
    for (int c = 0; c < D * D; ++c) result(c % D, c / D) = gather([&](Index i) { return parameter(i, c); });
    return result;
  }
  /// A parameter per body: `table[body[i]]`. Throws `InputError` if `body` has another size or an entry lies outside
  /// the table.
  template <class P, class B>
  [[nodiscard]] HMPS_INLINE T operator()(const ScalarView<P>& table, const ScalarView<B>& body) const {
    require_size(body, blocks_.size(), "bodies");
    require_view(table, "the table of parameters");
    return gather([&](Index i) {
      const auto b = static_cast<std::size_t>(body[i]);
      detail::require(b < table.size(), "hmps: particle ", i, " belongs to body ", +body[i],
                      " but the table of parameters has ", table.size(), " bodies; indices start at 0");
      return table[b];
    });
  }

 private:
  template <class Value>
  [[nodiscard]] HMPS_INLINE T gather(Value&& value) const {
    T result;
    for (int l = 0; l < T::width; ++l) {
      const Index i = particle(l);
      // Empty lanes take the parameters of the first particle, which are valid.
      result.lane[l] = static_cast<K>(value(i == Blocks<K, D>::none ? particle(0) : i));
    }
    return result;
  }

  const Blocks<K, D>& blocks_;
  std::size_t block_;
};

/// One block of particles as the argument of a coupling term: their parameters and their deformation.
template <class K, int D>
class BlockOfParticles : public BlockParameters<K, D> {
 public:
  using T = Lanes<K>;

  BlockOfParticles(const Blocks<K, D>& blocks, std::size_t block, const Matrix<T, D>& gradient,
                   const Matrix<T, D>& inverse)
      : BlockParameters<K, D>(blocks, block), deformation_gradient(gradient), shape_inverse(inverse) {}

  const Matrix<T, D>& deformation_gradient;  ///< F_i, \paper{11}.
  const Matrix<T, D>& shape_inverse;         ///< A_i^-1 in 1/m2, \paper{12}.
};

/// A bond as the argument of a pair term: only what is the same from both ends. `T` is `Lanes<K>` in a force, with one
/// bond of each particle of a block, and `double` in an energy. Lanes without a bond hold arbitrary values; the results
/// for them are discarded.
template <class T, int D>
class BondState {
 public:
  /// From r0 (m), u_j - u_i (m) and w.
  HMPS_INLINE BondState(const Vector<T, D>& reference, const Vector<T, D>& relative_displacement, const T& weight)
      : weight_(weight), reference_square_(0), square_(0), rise_(0) {
    for (int c = 0; c < D; ++c) {
      const T r = reference[c] + relative_displacement[c];
      reference_square_ += reference[c] * reference[c];
      square_ += r * r;
      rise_ += relative_displacement[c] * (reference[c] + r);
    }
  }

  /// |r0| in m.
  [[nodiscard]] HMPS_INLINE T reference_length() const { return root(reference_square_); }
  /// |r| in m.
  [[nodiscard]] HMPS_INLINE T length() const { return root(square_); }
  /// |r| - |r0| in m, without cancellation.
  [[nodiscard]] HMPS_INLINE T elongation() const { return rise_ / (length() + reference_length()); }
  /// w, dimensionless.
  [[nodiscard]] HMPS_INLINE T weight() const { return weight_; }

 private:
  [[nodiscard]] HMPS_INLINE static T root(const T& square) {
    using std::sqrt;
    return sqrt(square);
  }
  T weight_, reference_square_, square_, rise_;
};

/// What a particle contributes to each of its bonds. With M and c of both ends, and d of the whole body or the mean of
/// both ends, every internal force of the paper is one sum (force density in N/m3):
///
///     f_i = sum_j w_ij [ (M_i + M_j) r0_ij + (c_i + c_j) r_ij + d_ij (v_j - v_i) ]
///
/// It is antisymmetric in i and j, so that the forces sum to zero whatever the terms contribute.
template <class K, int D>
struct Coupling {
  Matrix<Lanes<K>, D> M;  ///< Acts on the reference position of the neighbour, in Pa/m2.
  Lanes<K> c;             ///< Acts on the current position of the neighbour, in Pa/m2.
};

/// A term that acts through the coupling of a particle to its bonds: `term.couple(particles, coupling)` adds to
/// `coupling.M` and `coupling.c` of a `BlockOfParticles`. Satisfied by `Elastic`, `Artificial` and `Record`.
template <class Term, class K, int D>
concept CouplingTerm = requires(const Term& term, const BlockOfParticles<K, D>& particles, Coupling<K, D>& coupling) {
  term.couple(particles, coupling);
};

/// A term that damps relative velocities: `term.damping(blocks)` is d of the whole body in Pa s/m2, read once, when the
/// force is made. Satisfied by `Viscous`.
template <class Term, class K, int D>
concept DampingTerm = requires(const Term& term, const Blocks<K, D>& blocks) {
  { term.damping(blocks) } -> std::convertible_to<double>;
};

/// A term that damps relative velocities by d of each particle: `term.damping(particles)`, in Pa s/m2, of a
/// `BlockParameters`; a bond takes the mean of its ends. Satisfied by `ViscousOfEach`.
template <class Term, class K, int D>
concept DampingOfEachTerm =
    !DampingTerm<Term, K, D> && requires(const Term& term, const BlockParameters<K, D>& particles) {
  { term.damping(particles) } -> std::convertible_to<Lanes<K>>;
};

/// A term whose energy U depends on the mean dilatation theta of a particle and its neighbours:
/// `term.pressure(particles, theta)` is dU/dtheta in Pa. The constant `Term::means`, 1 or 2, says how often the mean is
/// taken; once if there is none. With `term.grown(particles)`, of a `BlockParameters` or a `OneParticle`, the tissue
/// grows, as in `MeanDilatation`. Satisfied by `MeanDilatation`.
template <class Term, class K, int D>
concept DilatationTerm = requires(const Term& term, const BlockOfParticles<K, D>& particles, const Lanes<K>& theta) {
  { term.pressure(particles, theta) } -> std::convertible_to<Lanes<K>>;
};

/// A term that resists the difference between the length of a bond and those that the deformation gradients of its ends
/// predict: `term.length_stiffness(particles)`, of a `BlockParameters`, is C of each particle in Pa/m2,
///
///     f_i = sum_j w_ij [ C_i (|r_ij| - |F_i r0_ij|) + C_j (|r_ij| - |F_j r0_ij|) ] r_ij / |r_ij|
///
/// and M += F S A^-1 with S = C sum (1 - |r| / |F r0|) w r0 (x) r0. Satisfied by `ArtificialTension`.
template <class Term, class K, int D>
concept LengthTerm = requires(const Term& term, const BlockParameters<K, D>& particles) {
  { term.length_stiffness(particles) } -> std::convertible_to<Lanes<K>>;
};

/// A term that pulls along each bond: `term.tension(bond)`, of a `BondState`, is the force density in N/m3 that pulls
/// the two ends together, negative if it pushes them apart,
///
///     f_i = sum_j t_ij r_ij / |r_ij|.
///
/// If the tension is to be weighted, the term itself multiplies by the weight of the bond. Where bonds know the volumes
/// of particles it must do so, since the weight then includes that of the neighbour; `internal_force` checks it. Apart
/// from that weight, the term receives only quantities that are the same from both ends, and the force lies along the
/// bond, so that momentum and angular momentum are conserved whatever it returns. t is the derivative of an energy
/// density with respect to |r|, where each bond counts once: see `ForceEnergy`.
template <class Term, class K, int D>
concept PairTerm = requires(const Term& term, const BondState<Lanes<K>, D>& bond) {
  { term.tension(bond) } -> std::convertible_to<Lanes<K>>;
};

/// An external force on each particle: `term.body_force(particles)`, of a `BlockParameters`, is the force density in
/// N/m3, `Vector<Lanes<K>, D>`. It changes the momentum of the body. Models: `Gravity`, `DeadLoad`.
template <class Term, class K, int D>
concept BodyForceTerm = requires(const Term& term, const BlockParameters<K, D>& particles) {
  { term.body_force(particles) } -> std::convertible_to<Vector<Lanes<K>, D>>;
};

/// A term of `internal_force`: models one or more of the concepts above. A term that holds views of particles also has
/// `term.check(size)`, which throws `InputError` unless they have `size` particles, and it may have
/// `term.check_parameters(particles)`, of a `BlockOfParticles` that is hardly deformed, which throws for bad values;
/// `internal_force` calls both in the constructor. For `InternalForce::energy`, a `PairTerm` has `term.energy(bond)`,
/// other terms `term.energy(particle)`: see `ForceEnergy`. For `InternalForce::cauchy_stresses`, a `CouplingTerm` needs
/// `term.stress(particle)`, and a `DilatationTerm` `term.pressure(particle)`: see `ParticleState`. Models: the
/// results of `elastic`, `artificial`, `artificial_tension`, `viscous`, `mean_dilatation`, `gravity`, `dead_load` and
/// `record`; a struct of your own.
template <class Term, class K, int D>
concept ForceTerm = CouplingTerm<Term, K, D> || DampingTerm<Term, K, D> || DampingOfEachTerm<Term, K, D> ||
    DilatationTerm<Term, K, D> || LengthTerm<Term, K, D> || PairTerm<Term, K, D> || BodyForceTerm<Term, K, D>;

namespace detail {

/// Throws `InputError` unless the quantity `name` with the values `own` (in `unit`) is finite and not negative, or
/// positive if `must_be_positive`, at the particles of the block.
template <class K, int D>
HMPS_COLD void require_values(const BlockParameters<K, D>& particles, const Lanes<K>& own, const char* name,
                              const char* unit, bool must_be_positive = false) {
  for (int l = 0; l < Lanes<K>::width; ++l) {
    const Index i = particles.particle(l);
    const K value = own.lane[l];
    require(i == Blocks<K, D>::none || (is_finite(value) && (must_be_positive ? value > K(0) : value >= K(0))),
            "hmps: the ", name, " of particle ", i, " is ", value, " ", unit, "; it must be finite and ",
            must_be_positive ? "positive" : "not negative", " when the force is made: fill the parameters first");
  }
}

/// How often a term takes the mean of the dilatation: 0 if it takes none.
template <class Term, class K, int D>
[[nodiscard]] constexpr int means_of() {
  if constexpr (!DilatationTerm<Term, K, D>)
    return 0;
  else if constexpr (requires { Term::means; })
    return Term::means;
  else
    return 1;
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
