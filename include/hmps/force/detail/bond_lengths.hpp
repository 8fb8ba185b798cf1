// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/lane_math.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// What a particle with a `LengthTerm` contributes to its bonds.
template <class T, int D>
struct PredictedLengths {
  static constexpr std::size_t strains = D * (D + 1) / 2, count = strains + 1;

  /// F^T F - 1 on and above its diagonal, by columns: |F r0|^2 - |r0|^2 without cancellation.
  T twice_strain[strains];
  T stiffness;  ///< C in Pa/m2.

  PredictedLengths() = default;
  HMPS_INLINE PredictedLengths(const Matrix<T, D>& F, const T& C) : stiffness(C) {
    const Matrix<T, D> square = right_cauchy_green<T, D>(F);
    std::size_t k = 0;
    for (int c = 0; c < D; ++c)
      for (int r = 0; r <= c; ++r) twice_strain[k++] = r == c ? square(r, c) - T(1) : square(r, c);
  }
  /// As `store` wrote it; `number(k)` returns number k of `count`.
  template <class Number>
  [[nodiscard]] HMPS_INLINE static PredictedLengths of(const Number& number) {
    PredictedLengths stored;
    for (std::size_t k = 0; k < strains; ++k) stored.twice_strain[k] = number(k);
    stored.stiffness = number(strains);
    return stored;
  }
  template <class Slots>
  HMPS_INLINE void load(const Slots& slots, std::size_t slot) {
    *this = of([&](std::size_t k) { return slots.lanes(k, slot); });
  }
  template <class Slots>
  HMPS_INLINE void store(Slots& slots, std::size_t slot) const {
    for (std::size_t k = 0; k < strains; ++k) slots.store(k, slot, twice_strain[k]);
    slots.store(strains, slot, stiffness);
  }

  /// |F r0|^2 - |r0|^2 in m2.
  [[nodiscard]] HMPS_INLINE T rise(const Vector<T, D>& r0) const {
    T sum(0);
    std::size_t k = 0;
    for (int c = 0; c < D; ++c) {
      T row = twice_strain[k + static_cast<std::size_t>(c)] * r0[c];
      for (int r = 0; r < c; ++r) row += T(2) * twice_strain[k + static_cast<std::size_t>(r)] * r0[r];
      k += static_cast<std::size_t>(c) + 1;
      sum += row * r0[c];
    }
    return sum;
  }
};

/// The length of a bond beside those that its ends predict, |F r0|. Each is known by the difference of its square from
/// |r0|^2, so that small strains do not cancel.
template <class T, int D>
class BondLengths {
 public:
  /// From a row of bonds and u_j - u_i (m).
  template <class Row>
  HMPS_INLINE BondLengths(const Row& bond, const Vector<T, D>& relative) : square_(0), rise_(0) {
    for (int d = 0; d < D; ++d) {
      r0[d] = bond.along(d) ? T(bond.offset(d)) : T(0);
      r[d] = r0[d] + relative[d];
      square_ += r0[d] * r0[d];
      rise_ += relative[d] * (r0[d] + r[d]);
    }
  }

  Vector<T, D> r0, r;  ///< m

  /// C (1 - |F r0| / |r|). Coincident particles, whose bond has no direction, exert no force: zero.
  [[nodiscard]] HMPS_INLINE T excess(const PredictedLengths<T, D>& end) const {
    const T predicted = end.rise(r0), own = square_ + rise_;
    return select(own > T(0), end.stiffness * (rise_ - predicted) / (own + mean(own, square_ + predicted)), T(0));
  }
  /// C (1 - |r| / |F r0|); zero where F r0 is zero, where the energy has no derivative.
  [[nodiscard]] HMPS_INLINE T deficit(const PredictedLengths<T, D>& end) const {
    const T predicted = end.rise(r0), own = square_ + predicted;
    return select(own > T(0), end.stiffness * (predicted - rise_) / (own + mean(own, square_ + rise_)), T(0));
  }

 private:
  /// The geometric mean of two squares, of which rounding may have made the second one negative.
  [[nodiscard]] HMPS_INLINE static T mean(const T& a, const T& b) {
    using std::sqrt;
    return sqrt(a * select(b > T(0), b, T(0)));
  }
  T square_, rise_;  // |r0|^2, |r|^2 - |r0|^2
};

/// The S of `LengthTerm` of the particles of `block` in Pa, the derivative of the energy with respect to F^T F / 2.
template <Bonds B, class K = typename B::Scalar, int D = B::dimension>
[[nodiscard]] HMPS_INLINE Matrix<Lanes<K>, D> length_stress(const B& bonds, std::size_t block,
                                                            const typename B::template Slots<std::size_t{D}>& u,
                                                            const PredictedLengths<Lanes<K>, D>& own) {
  using T = Lanes<K>;
  Vector<T, D> here;
  Matrix<T, D> S;
  for (int d = 0; d < D; ++d) here[d] = u.lanes(static_cast<std::size_t>(d), block * B::width);
  for (int k = 0; k < D * D; ++k) S(k % D, k / D) = T(0);
  bonds.for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
    const auto neighbour = bond.gather(u);
    Vector<T, D> relative;
    for (int d = 0; d < D; ++d) relative[d] = neighbour[static_cast<std::size_t>(d)] - here[d];
    const BondLengths<T, D> lengths(bond, relative);
    // Lanes without a bond may hold a value that is not finite.
    const T w = bond.weight(), share = select(w > K(0), w * lengths.deficit(own), T(0));
    for (int c = 0; c < D; ++c)
      for (int r = 0; r <= c; ++r) S(r, c) += share * lengths.r0[r] * lengths.r0[c];
  });
  for (int c = 0; c < D; ++c)
    for (int r = 0; r < c; ++r) S(c, r) = S(r, c);
  return S;
}

/// Adds the force of `LengthTerm` along one bond to `force` (N/m3), from the displacements and lengths of both ends.
template <class Row, class Displacements, class Lengths, class T, int D>
HMPS_INLINE void adjust_length(const Row& bond, const Displacements& displacement, const Lengths& lengths,
                               const Vector<T, D>& u, const PredictedLengths<T, D>& own, Vector<T, D>& force) {
  const auto neighbour = bond.gather(displacement);
  Vector<T, D> relative;
  for (int d = 0; d < D; ++d) relative[d] = neighbour[static_cast<std::size_t>(d)] - u[d];
  const BondLengths<T, D> length(bond, relative);
  const T w = bond.weight();
  const auto other = bond.gather(lengths);
  const T sum = length.excess(own) + length.excess(PredictedLengths<T, D>::of([&](std::size_t k) { return other[k]; }));
  const T share = select(w > typename T::Scalar(0), w * sum, T(0));
  for (int d = 0; d < D; ++d) force[d] += share * length.r[d];
}

}  // namespace hmps::inline HMPS_ABI::detail
