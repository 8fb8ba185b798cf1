// SPDX-License-Identifier: MIT
#include "hmps/force/detail/bond_lengths.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace bond_lengths_test {

/// A row with one bond for every lane.
template <class T, int D>
struct Bond {
  hmps::Vector<T, D> r0;
  bool along(int c) const { return r0[c] != T(0); }
  T offset(int c) const { return r0[c]; }
};
template <class T, int D>
struct Case {
  hmps::detail::PredictedLengths<T, D> end;
  hmps::detail::BondLengths<T, D> lengths;
};

/// A bond from `r0` to `r`, with an end that has the gradient `F` and the stiffness 2.
template <class T, int D>
Case<T, D> bond(const hmps::Matrix<T, D>& F, const hmps::Vector<T, D>& r0, const hmps::Vector<T, D>& r) {
  return {{F, T(2)}, {Bond<T, D>{r0}, hmps::Vector<T, D>(r - r0)}};
}

TEST(BondLengths, ComparesTheLengthWithThatWhichFPredicts) {
  hmps::Matrix<double, 3> F;
  F << 1.2, 0.3, -0.1, 0.2, 0.9, 0.4, 0, -0.5, 1.1;
  const hmps::Vector<double, 3> r0(0.7, 0, -0.4), r(0.9, 0.3, -0.2);
  const auto [end, lengths] = bond<double, 3>(F, r0, r);
  const double predicted = (F * r0).norm(), length = r.norm();
  EXPECT_NEAR(end.rise(r0), predicted * predicted - r0.squaredNorm(), 1e-15);
  EXPECT_NEAR(lengths.excess(end), 2 * (1 - predicted / length), 1e-14);
  EXPECT_NEAR(lengths.deficit(end), 2 * (1 - length / predicted), 1e-14);
  EXPECT_EQ(lengths.r, r);

  hmps::Matrix<double, 2> flat;
  flat << 1.2, 0.3, 0.2, 0.9;
  const hmps::Vector<double, 2> a(0.7, -0.4), b(0.9, 0.3);
  const auto plane = bond<double, 2>(flat, a, b);
  EXPECT_NEAR(plane.lengths.excess(plane.end), 2 * (1 - (flat * a).norm() / b.norm()), 1e-14);
}

// In float, the difference of two lengths of 0.001 m would have an error of 1e-7 times the length, as large as this
// strain itself.
TEST(BondLengths, ResolvesSmallStrains) {
  hmps::Matrix<float, 3> F = hmps::Matrix<float, 3>::Identity();
  const hmps::Vector<float, 3> r0(6e-4f, -8e-4f, 0);
  const auto [end, lengths] = bond<float, 3>(F, r0, r0);
  const hmps::detail::BondLengths<float, 3> longer(Bond<float, 3>{r0}, hmps::Vector<float, 3>(1e-7f * r0));
  EXPECT_EQ(lengths.excess(end), 0);
  EXPECT_NEAR(longer.excess(end), 2e-7f, 1e-12f);
  EXPECT_NEAR(longer.deficit(end), -2e-7f, 1e-12f);
}

TEST(BondLengths, IsZeroWhereThereIsNoDirection) {
  const hmps::Vector<double, 2> r0(1, 0), none(0, 0);
  hmps::Matrix<double, 2> singular = hmps::Matrix<double, 2>::Zero();
  singular(1, 1) = 1;
  const auto coincident = bond<double, 2>(hmps::Matrix<double, 2>::Identity(), r0, none);
  EXPECT_EQ(coincident.lengths.excess(coincident.end), 0);
  EXPECT_EQ(coincident.lengths.deficit(coincident.end), 2);
  const auto flat = bond<double, 2>(singular, r0, r0);
  EXPECT_EQ(flat.lengths.excess(flat.end), 2);
  EXPECT_EQ(flat.lengths.deficit(flat.end), 0);
}

}  // namespace bond_lengths_test
