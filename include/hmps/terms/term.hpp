// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI {

/// One block of particles as a term sees it, a particle in each lane.
template <class K, int D>
class BlockOfParticles {
 public:
  using T = Lanes<K>;

  BlockOfParticles(const Blocks<K, D>& blocks, std::size_t block, const Matrix<T, D>& gradient,
                   const Matrix<T, D>& inverse)
      : deformation_gradient(gradient), shape_inverse(inverse), blocks_(blocks), block_(block) {}

  const Matrix<T, D>& deformation_gradient;  ///< F_i, \paper{11}.
  const Matrix<T, D>& shape_inverse;         ///< A_i^-1 in 1/m2, \paper{12}.

  /// 1 / sum |r0|^2 w in 1/m2, the denominator of \paper{20}.
  [[nodiscard]] HMPS_INLINE T inverse_shape_trace() const { return blocks_.inverse_trace_lanes(block_); }

  /// The particle in `lane`, or `Blocks::none` behind the last one.
  [[nodiscard]] HMPS_INLINE Index particle(int lane) const {
    return blocks_.particle(block_ * Blocks<K, D>::width + static_cast<std::size_t>(lane));
  }

  [[nodiscard]] HMPS_INLINE const Blocks<K, D>& blocks() const { return blocks_; }
  [[nodiscard]] HMPS_INLINE std::size_t block() const { return block_; }

  /// A parameter of each particle, from the user's array of one number per particle. Throws
  /// `InputError` if it has another size.
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
  /// A parameter of each particle's body: `table[body[i]]`. Throws `InputError` if the bodies have
  /// another size or one is not in the table.
  template <class P, class B>
  [[nodiscard]] HMPS_INLINE T operator()(const ScalarView<P>& table, const ScalarView<B>& body) const {
    require_size(body, blocks_.size(), "bodies");
    require_view(table, "the table of parameters");
    return gather([&](Index i) {
      const auto b = static_cast<std::size_t>(body[i]);
      require(b < table.size(), "hmps: particle ", i, " belongs to body ", +body[i],
              " but the table of parameters has ", table.size(), " bodies; number them from 0");
      return table[b];
    });
  }

 private:
  template <class Value>
  [[nodiscard]] HMPS_INLINE T gather(Value&& value) const {
    T result;
    for (int l = 0; l < T::width; ++l) {
      const Index i = particle(l);
      // Empty lanes take the first particle's parameters, with which nothing can go wrong.
      result.lane[l] = static_cast<K>(value(i == Blocks<K, D>::none ? particle(0) : i));
    }
    return result;
  }

  const Blocks<K, D>& blocks_;
  std::size_t block_;
};

/// What a particle carries to each of its bonds. With M, c of both ends and d of the whole body,
/// every internal force of the paper is one sum (force density in N/m3):
///
///     f_i = sum_j w_ij [ (M_i + M_j) r0_ij + (c_i + c_j) r_ij + d (v_j - v_i) ]
///
/// It is antisymmetric in i and j, so that the forces sum to zero whatever the terms put in.
template <class K, int D>
struct Coupling {
  Matrix<Lanes<K>, D> M;  ///< Acts on the reference position of the neighbour, in Pa/m2.
  Lanes<K> c;             ///< Acts on the current position of the neighbour, in Pa/m2.
};

/// A term of the internal force. Valid expressions, of which a term has one or more:
///
/// | expression | meaning |
/// |---|---|
/// | `term.couple(particles, coupling)` | adds to `coupling.M` and `coupling.c` of a `BlockOfParticles` |
/// | `term.damping(bonds)` | d of the whole body, in Pa s/m2 |
/// | `term.pressure(particles, theta)` | dU/dtheta in Pa, U being an energy of the mean dilatation theta |
///
/// A term that holds views of particles has `term.check(size)` too, which throws `InputError` unless they are views of
/// `size` particles: `internal_force` asks when it is made. One of the mean dilatation may have `means`, 1 or 2: how
/// often the mean is taken. Satisfied by `Elastic`, `Artificial`, `Viscous`,
/// `MeanDilatation`, `Record`, and a user's own struct.
template <class Term, class K, int D>
concept CouplingTerm = requires(const Term& term, const BlockOfParticles<K, D>& particles, Coupling<K, D>& coupling) {
  term.couple(particles, coupling);
};
template <class Term, class K, int D>
concept DampingTerm = requires(const Term& term, const Blocks<K, D>& blocks) {
  { term.damping(blocks) } -> std::convertible_to<double>;
};
template <class Term, class K, int D>
concept DilatationTerm = requires(const Term& term, const BlockOfParticles<K, D>& particles, const Lanes<K>& theta) {
  { term.pressure(particles, theta) } -> std::convertible_to<Lanes<K>>;
};
template <class Term, class K, int D>
concept ForceTerm = CouplingTerm<Term, K, D> || DampingTerm<Term, K, D> || DilatationTerm<Term, K, D>;

namespace detail {

/// How often a term takes the mean of the dilatation: once unless it says otherwise, and never if it takes none.
template <class Term, class K, int D>
[[nodiscard]] constexpr int means_of() {
  if constexpr (!DilatationTerm<Term, K, D>)
    return 0;
  else if constexpr (requires { Term::means; })
    return Term::means;
  else
    return 1;
}

template <class Term, class K, int D>
HMPS_INLINE void add_pressure(const Term& term, const BlockOfParticles<K, D>& particles, const Lanes<K>& theta,
                              Lanes<K>& pressure) {
  if constexpr (DilatationTerm<Term, K, D>) pressure += term.pressure(particles, theta);
}
template <class Term, class K, int D>
HMPS_INLINE void add_coupling(const Term& term, const BlockOfParticles<K, D>& particles, Coupling<K, D>& coupling) {
  if constexpr (CouplingTerm<Term, K, D>) term.couple(particles, coupling);
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
