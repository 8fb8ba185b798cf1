// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI::detail {

template <class Term, class K, int D>
struct IsTerm : std::bool_constant<ForceTerm<Term, K, D>> {};
/// Fails to compile if `Term` is not a term of a force, or holds a type that is not a law; the first line of the
/// message names it.
template <class Term, class K, int D>
struct RequireTerm {
  static_assert(IsTerm<Term, K, D>::value,
                "hmps: a term of internal_force needs couple(particles, coupling), damping(bonds), damping(particles), "
                "pressure(particles, theta), tension(bond) or body_force(particles), const; see ForceTerm");
  static constexpr bool value = true;
};
template <class Term, class K, int D>
requires requires { Term::template serves<K, D>(); }
struct RequireTerm<Term, K, D> {
  static constexpr bool value = Term::template serves<K, D>();
};

/// What a set of terms needs.
template <class K, int D, class... Terms>
struct PartsOfForce {
  static constexpr bool dilates = (DilatationTerm<Terms, K, D> || ...);
  static constexpr int means = std::max({0, means_of<Terms, K, D>()...});
  static_assert(((!DilatationTerm<Terms, K, D> || means_of<Terms, K, D>() == means) && ...),
                "hmps: all terms of the mean dilatation in a force must take the mean equally often, once or twice");
  static constexpr bool couples = dilates || (CouplingTerm<Terms, K, D> || ...);
  static constexpr bool pairs = (PairTerm<Terms, K, D> || ...);
  static constexpr bool displaces = couples || pairs;
  static constexpr bool damps_each = (DampingOfEachTerm<Terms, K, D> || ...);
  static constexpr bool damps = damps_each || (DampingTerm<Terms, K, D> || ...);
  static constexpr bool acts = (BodyForceTerm<Terms, K, D> || ...);
};

/// Throws `InputError` if the tension of `term` is not finite in a bond stretched by a thousandth.
template <class Term, Bonds B>
HMPS_COLD void require_tensions(const Term& term, const B& bonds) {
  using T = Lanes<typename B::Scalar>;
  constexpr int D = B::dimension;
  for (std::size_t block = 0; block < bonds.block_count(); ++block)
    bonds.for_each_row(block, [&](const auto& bond) {
      Vector<T, D> r0, relative;
      for (int d = 0; d < D; ++d) {
        r0[d] = bond.along(d) ? T(bond.offset(d)) : T(typename B::Scalar(0));
        relative[d] = r0[d] * T(typename B::Scalar(1e-3));
      }
      const T w = bond.weight(), tension = term.tension(BondState<T, D>(r0, relative, w));
      for (int l = 0; l < T::width; ++l)
        require(!(w.lane[l] > 0) || is_finite(tension.lane[l]), "hmps: a pair term pulls particle ",
                bonds.particle(block * B::width + static_cast<std::size_t>(l)), " by ", tension.lane[l],
                " N/m3 along a bond that is stretched by a thousandth; check its parameters and formula");
    });
}

}  // namespace hmps::inline HMPS_ABI::detail
