// SPDX-License-Identifier: MIT
#include "hmps/force/reference.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "../../hmps/force/equations.hpp"

namespace reference_test {

using namespace equations;

// What the benchmarks compare the library with computes the same: Eqs. (13), (19) and (21).
template <class S>
void expect_the_equations() {
  const scenes::Scene<3> box = scenes::all<3>().front();
  ASSERT_EQ(box.name, "box");
  using Vec = typename bench::Reference<S>::Vec;
  std::vector<Vec> reference, x, v, f(box.x.size());
  for (std::size_t i = 0; i < f.size(); ++i) {
    reference.push_back((box.reference[i] - box.reference[0]).template cast<S>());
    x.push_back((box.x[i] - box.reference[0]).template cast<S>());
    v.push_back(box.v[i].template cast<S>());
  }
  const Materials m(f.size(), true);
  bench::Reference<S> force(reference, static_cast<S>(1.75 * box.spacing));
  force(hmps::MooneyRivlin<S>{S(m.c1[0]), S(m.c2[0]), S(m.d1[0])}, S(m.modulus[0]), S(density), S(viscosity), x, v, f);

  const auto bonds = make_bonds<hmps::LatticeBonds<double, 3>>(box);
  const Expected<3> expected(box, m, bonds.standard_lambda(), bonds.standard_density());
  Vectors<3> found;
  for (const Vec& fi : f) found.push_back(fi.template cast<double>());
  const Tolerance<S, 3> tolerance(box);
  EXPECT_LE(
      largest_difference<3>(
          found, [&](std::size_t i) { return expected.elastic[i] + expected.artificial[i] + expected.viscous[i]; }),
      tolerance.elastic + tolerance.artificial + tolerance.viscous);
}

TEST(Reference, ComputesTheEquationsInDouble) { expect_the_equations<double>(); }
TEST(Reference, ComputesTheEquationsInFloat) { expect_the_equations<float>(); }

}  // namespace reference_test
