// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <type_traits>

#include "hmps/core/abi.hpp"
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

}  // namespace hmps::inline HMPS_ABI::detail
