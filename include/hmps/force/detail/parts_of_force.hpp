// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI::detail {

template <class Term, class K, int D>
struct IsTerm : std::bool_constant<ForceTerm<Term, K, D>> {};
/// Fails to compile if `Term` is not a term of a force, or holds a type that is not a law; the first line of the
/// message names it.
template <class Term, class K, int D>
struct RequireTerm {
  static constexpr bool is_law = IsLaw<Term, Lanes<K>, D>::value;
  static_assert(IsTerm<Term, K, D>::value || !is_law,
                "hmps: a law is not a term of internal_force; wrap it in one: hmps::elastic(law)");
  static_assert(IsTerm<Term, K, D>::value || is_law,
                "hmps: a term of internal_force needs couple(particles, coupling), damping(bonds), damping(particles), "
                "pressure(particles, theta), length_stiffness(particles), tension(bond) or body_force(particles), "
                "const; see ForceTerm");
  static constexpr bool value = true;
};
template <class Term, class K, int D>
requires requires { Term::template serves<K, D>(); }
struct RequireTerm<Term, K, D> {
  static constexpr bool value = Term::template serves<K, D>();
};

/// A `DilatationTerm` of tissue that grows.
template <class Term, class K, int D>
concept GrowingTerm = DilatationTerm<Term, K, D> && requires(const Term& term, const BlockParameters<K, D>& particles) {
  { term.grown(particles) } -> std::convertible_to<Lanes<K>>;
};

/// The growth G of `MeanDilatation` of `at`, a block of particles or one: that of the term that grows, otherwise 1.
template <class K, int D, class G, class At, class... Terms>
[[nodiscard]] HMPS_INLINE G growth_of(const std::tuple<Terms...>& terms, const At& at) {
  G growth(1);
  const auto take = [&](const auto& term) HMPS_INLINE_LAMBDA {
    if constexpr (GrowingTerm<std::remove_cvref_t<decltype(term)>, K, D>) growth = static_cast<G>(term.grown(at));
  };
  std::apply([&](const auto&... term) HMPS_INLINE_LAMBDA { (take(term), ...); }, terms);
  return growth;
}

/// The sum of the stiffnesses of all `LengthTerm`s.
template <class K, int D, class... Terms>
[[nodiscard]] HMPS_INLINE Lanes<K> length_stiffness_of(const std::tuple<Terms...>& terms,
                                                       const BlockParameters<K, D>& particles) {
  Lanes<K> sum(0);
  const auto add = [&](const auto& term) HMPS_INLINE_LAMBDA {
    if constexpr (LengthTerm<std::remove_cvref_t<decltype(term)>, K, D>) sum += term.length_stiffness(particles);
  };
  std::apply([&](const auto&... term) HMPS_INLINE_LAMBDA { (add(term), ...); }, terms);
  return sum;
}

/// What a set of terms needs.
template <class K, int D, class... Terms>
struct PartsOfForce {
  static constexpr bool dilates = (DilatationTerm<Terms, K, D> || ...);
  static constexpr int means = std::max({0, means_of<Terms, K, D>()...});
  static_assert(((!DilatationTerm<Terms, K, D> || means_of<Terms, K, D>() == means) && ...),
                "hmps: all terms of the mean dilatation in a force must take the mean equally often, once or twice");
  static_assert(!(GrowingTerm<Terms, K, D> || ...) || (0 + ... + int(DilatationTerm<Terms, K, D>)) == 1,
                "hmps: the mean dilatation of tissue that grows must be the only term of the mean dilatation in its "
                "force; add the bulk moduli");
  static constexpr bool predicts = (LengthTerm<Terms, K, D> || ...);
  static constexpr bool couples = dilates || predicts || (CouplingTerm<Terms, K, D> || ...);
  static constexpr bool pairs = (PairTerm<Terms, K, D> || ...);
  static constexpr bool displaces = couples || pairs;
  static constexpr bool damps_each = (DampingOfEachTerm<Terms, K, D> || ...);
  static constexpr bool damps = damps_each || (DampingTerm<Terms, K, D> || ...);
  static constexpr bool acts = (BodyForceTerm<Terms, K, D> || ...);
};

/// Throws `InputError` if the tension of `term` in a bond stretched by a thousandth is not finite, or, for bonds that
/// know the volumes of their particles, not proportional to the weight, which contains the volumes.
template <class Term, Bonds B>
HMPS_COLD void require_tensions(const Term& term, const B& bonds) {
  using K = typename B::Scalar;
  using T = Lanes<K>;
  constexpr int D = B::dimension;
  const bool weighted = [&] {
    if constexpr (requires { bool(bonds.knows_volumes()); }) return bonds.knows_volumes();
    return false;
  }();
  for (std::size_t block = 0; block < bonds.block_count(); ++block)
    bonds.for_each_row(block, [&](const auto& bond) {
      Vector<T, D> r0, relative;
      for (int d = 0; d < D; ++d) {
        r0[d] = bond.along(d) ? T(bond.offset(d)) : T(K(0));
        relative[d] = r0[d] * T(K(1e-3));
      }
      const T w = bond.weight(), tension = term.tension(BondState<T, D>(r0, relative, w)),
              twice = weighted ? T(term.tension(BondState<T, D>(r0, relative, T(K(2)) * w))) : T(K(2)) * tension;
      for (int l = 0; l < T::width; ++l) {
        if (!(w.lane[l] > 0)) continue;
        const auto i = bonds.particle(block * B::width + static_cast<std::size_t>(l));
        require(is_finite(tension.lane[l]), "hmps: a pair term pulls particle ", i, " by ", tension.lane[l],
                " N/m3 along a bond that is stretched by a thousandth; check its parameters and formula");
        require(std::abs(twice.lane[l] - 2 * tension.lane[l]) <= K(1e-3) * std::abs(tension.lane[l]),
                "hmps: a pair term pulls particle ", i, " by ", tension.lane[l], " N/m3 along a bond, and by ",
                twice.lane[l],
                " N/m3 along one of twice the weight; these bonds know the volumes of their particles, so the "
                "tension must be proportional to bond.weight()");
      }
    });
}

/// Checks the views of `term` and the values that they have now. Throws `InputError` as `internal_force` says.
template <class Term, Bonds B>
void check_term(const Term& term, const B& bonds) {
  using K = typename B::Scalar;
  constexpr int D = B::dimension;
  if constexpr (requires { term.check(bonds.size()); }) term.check(bonds.size());
  if constexpr (PairTerm<Term, K, D>) require_tensions(term, bonds);
  if constexpr (requires(const BlockOfParticles<K, D>& particles) { term.check_parameters(particles); }) {
    // Stretched and sheared by about a thousandth: every law responds, and none leaves its range.
    Matrix<Lanes<K>, D> F;
    for (int k = 0; k < D * D; ++k)
      F(k % D, k / D) = Lanes<K>(k % D == k / D ? K(1.001) : K(0.0002) * static_cast<K>(k));
    for (std::size_t block = 0; block < bonds.block_count(); ++block)
      term.check_parameters(BlockOfParticles<K, D>(bonds, block, F, bonds.shape_inverse_lanes(block)));
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
