// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Four numbers that fill one vector register: a vector of two or three components and up to two spare numbers. Size
/// and alignment are the same for every instruction set. Pass it by reference only: passing by value depends on the
/// instruction set.
#if defined(__GNUC__) || defined(__clang__)
template <class S>
struct QuadOf {
  typedef S Type __attribute__((vector_size(4 * sizeof(S))));
};
#else
template <class S>
struct PlainQuad {
  S lane[4];
  [[nodiscard]] S operator[](std::size_t l) const { return lane[l]; }
  S& operator[](std::size_t l) { return lane[l]; }
  PlainQuad& operator+=(const PlainQuad& b) {
    for (int l = 0; l < 4; ++l) lane[l] += b.lane[l];
    return *this;
  }
  PlainQuad& operator-=(const PlainQuad& b) {
    for (int l = 0; l < 4; ++l) lane[l] -= b.lane[l];
    return *this;
  }
  friend PlainQuad operator*(PlainQuad a, const PlainQuad& b) {
    for (int l = 0; l < 4; ++l) a.lane[l] *= b.lane[l];
    return a;
  }
  friend PlainQuad operator*(PlainQuad a, S b) {
    for (int l = 0; l < 4; ++l) a.lane[l] *= b;
    return a;
  }
};
template <class S>
struct QuadOf {
  using Type = PlainQuad<S>;
};
#endif
template <class S>
using Quad = typename QuadOf<S>::Type;

/// Sets `quad` to the components of `v`, followed by zeros.
template <class S, class Derived>
HMPS_INLINE void set_quad(const Eigen::MatrixBase<Derived>& v, Quad<S>& quad) {
  quad = Quad<S>{};
  for (int c = 0; c < v.size(); ++c) quad[static_cast<std::size_t>(c)] = v[c];
}

/// The smaller of `s` and 1; sets `quad` to zero if `s` is not below 1. The outcome is unpredictable, so the code must
/// not branch. Compilers turn a selection of one number into a branch, but not a selection of four.
template <class S>
[[nodiscard]] HMPS_INLINE S cut_at_one(S s, Quad<S>& quad) {
#if defined(__GNUC__) || defined(__clang__)
  const Quad<S> one = Quad<S>{} + S(1);
  Quad<S> all = Quad<S>{} + s;
  const auto below = all < one;
  all = below ? all : one;
  quad = below ? quad : Quad<S>{};
  return all[0];
#else
  if (s < S(1)) return s;
  quad = Quad<S>{};
  return S(1);
#endif
}

/// The first `D` numbers of `quad`.
template <int D, class S>
[[nodiscard]] HMPS_INLINE Vector<S, D> first(const Quad<S>& quad) {
  Vector<S, D> v;
  for (int c = 0; c < D; ++c) v[c] = quad[static_cast<std::size_t>(c)];
  return v;
}

}  // namespace hmps::inline HMPS_ABI::detail
