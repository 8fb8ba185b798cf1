// SPDX-License-Identifier: MIT
#pragma once

#include <compare>
#include <cstddef>
#include <type_traits>

#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/laws/law.hpp"

/// What a particle costs: floating-point operations and bytes moved, counted from the equations and the arrays, not
/// measured. A multiplication, an addition, a division and a root are one operation each, a multiply-add two. The
/// operations are those of the sums as written in docs/theory.md, over the bonds that exist: savings of a kernel by
/// symmetry and its work on empty lanes change its time, not this count. The bytes of each array count once for each
/// pass over it, as if neighbours were always found in a cache and no two particles shared a shape tensor; a write
/// counts once. Gathered bytes are those that bonds read of their neighbours, which come from a cache and not from
/// memory.
namespace bench {

struct Cost {
  double flop = 0, bytes = 0, gathered = 0;
  friend Cost operator+(const Cost& a, const Cost& b) {
    return {a.flop + b.flop, a.bytes + b.bytes, a.gathered + b.gathered};
  }
};

/// A number that counts the operations applied to it.
struct Counted {
  double value;
  static inline std::size_t operations = 0;

  Counted() = default;
  template <class T>
  requires std::is_arithmetic_v<T> Counted(T number) : value(static_cast<double>(number)) {}

  friend Counted operator+(Counted a, Counted b) { return ++operations, Counted(a.value + b.value); }
  friend Counted operator-(Counted a, Counted b) { return ++operations, Counted(a.value - b.value); }
  friend Counted operator*(Counted a, Counted b) { return ++operations, Counted(a.value * b.value); }
  friend Counted operator/(Counted a, Counted b) { return ++operations, Counted(a.value / b.value); }
  friend Counted operator-(Counted a) { return ++operations, Counted(-a.value); }
  friend Counted& operator+=(Counted& a, Counted b) { return a = a + b; }
  friend auto operator<=>(Counted a, Counted b) { return a.value <=> b.value; }
  friend Counted select(bool mask, Counted yes, Counted no) { return mask ? yes : no; }
  friend Counted inverse_cube_root(Counted x) { return ++operations, Counted(hmps::inverse_cube_root(x.value)); }
};

/// Number of operations for the stress of one particle by `law`; a root counts as one.
template <class Law>
[[nodiscard]] double stress_flop(const Law& law) {
  hmps::Matrix<Counted, 3> F;
  for (int k = 0; k < 9; ++k) F(k % 3, k / 3) = k % 4 == 0 ? 1.01 : 0.02 * k;
  Counted::operations = 0;
  (void)hmps::first_piola_kirchhoff(law, F);
  return static_cast<double>(Counted::operations);
}

/// The costs of the parts of a step, per particle, for particles bonded by `bonds` with a state of scalar type `S`.
template <class S, class B>
class StepCost {
 public:
  explicit StepCost(const B& b)
      : bonds_(bonds_per_particle(b)),
        bond_bytes_(static_cast<double>(b.bytes() - b.hmps::template Blocks<K, 3>::bytes()) /
                    static_cast<double>(b.size())) {}

  /// Reads positions and reference positions, stores displacements.
  [[nodiscard]] Cost stage_positions() const { return {6, 3 * s + 24 + 3 * k}; }
  [[nodiscard]] Cost stage_velocities() const { return {0, 3 * s + 3 * k}; }
  /// (11): per bond three differences, times w, times r0; per particle times A^-1, plus 1.
  [[nodiscard]] Cost gradient() const { return {24 * bonds_ + 48, 3 * k + 6 * k + bond_bytes_, 3 * k * bonds_}; }
  /// (13) in the first sweep: F S A^-1 is added to M.
  template <class Law>
  [[nodiscard]] Cost elastic(const Law& law) const {
    return {stress_flop(law) + 45 + 9, 0};
  }
  /// (19, 20) in the first sweep: C = E d / tr A, M - C F, c + C.
  [[nodiscard]] Cost artificial() const { return {1 + 18 + 1, k}; }
  /// The artificial tension. In the first sweep, per bond: r, |r|^2 and |F r0|^2, a quotient with a root, and its
  /// product with r0 r0; per particle F^T F - 1 and F S A^-1. In the second, per bond: r, |r|^2, and for both ends
  /// |F r0|^2 and the quotient.
  [[nodiscard]] Cost tension() const {
    return {36 + 90 + 9 + (19 + 16 + 6 + 18 + 19 + 2 * 22 + 8) * bonds_, 14 * k + 3 * k + bond_bytes_,
            (3 + 3 + 7) * k * bonds_};
  }
  /// Writes M and c; the second sweep reads them, with displacements and the stored sum of w r0. Per bond: c_i + c_j,
  /// its product with three differences, M r0, and the sum of all times w.
  [[nodiscard]] Cost couple() const {
    return {3 + 31 * bonds_ + 18, 10 * k + 10 * k + 3 * k + 3 * k + bond_bytes_, 13 * k * bonds_};
  }
  /// (21) in the second sweep: three differences, times w; d.
  [[nodiscard]] Cost viscous() const { return {9 * bonds_ + 6, 3 * k, 3 * k * bonds_}; }
  [[nodiscard]] Cost force() const { return {0, 3 * s}; }
  /// Writes F in the scalar of the kernels.
  [[nodiscard]] Cost record() const { return {0, 9 * k}; }
  /// v + f dt / rho, and x + v dt.
  [[nodiscard]] static Cost kick() { return {6, 9 * s}; }
  [[nodiscard]] static Cost drift() { return {6, 9 * s}; }

  /// The complete step that is measured: all three forces, kick and drift.
  template <class Law>
  [[nodiscard]] Cost step(const Law& law) const {
    return stage_positions() + stage_velocities() + gradient() + elastic(law) + artificial() + couple() + viscous() +
           force() + kick() + drift();
  }

 private:
  using K = typename B::Scalar;
  static constexpr double k = sizeof(K), s = sizeof(S);

  [[nodiscard]] static double bonds_per_particle(const B& b) {
    std::size_t sum = 0;
    for (std::size_t i = 0; i < b.size(); ++i) b.for_each_bond(i, [&](auto&&...) { ++sum; });
    return static_cast<double>(sum) / static_cast<double>(b.size());
  }

  double bonds_, bond_bytes_;
};

}  // namespace bench
