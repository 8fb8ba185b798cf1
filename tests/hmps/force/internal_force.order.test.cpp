// SPDX-License-Identifier: MIT
// The order in which an executor runs the blocks changes no bit (threads: tests of the executors).
#include <gtest/gtest.h>

#include <numeric>

#include "../../reference/backwards.hpp"
#include "../executors/same_bits.hpp"
#include "equations.hpp"

namespace internal_force_order_test {

using hmps_test::Backwards;

struct Shuffled {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    std::vector<std::size_t> order(n);
    std::iota(order.begin(), order.end(), std::size_t{0});
    scenes::Random(1).shuffle(order);
    for (std::size_t i : order) body(i);
  }
};

template <class B>
class Order : public testing::Test {};
using Models = testing::Types<hmps::LatticeBonds<float, 3>, hmps::BondList<double, 3>>;
using Lists = testing::Types<hmps::BondList<float, 3>, hmps::BondList<double, 2>>;
TYPED_TEST_SUITE(Order, Models);

TYPED_TEST(Order, OfTheBlocksDoesNotChangeTheResult) {
  const same_bits::Probe<TypeParam> probe;
  const auto expected = probe(hmps::Serial{});
  EXPECT_TRUE(same_bits::identical(probe(Backwards{}), expected));
  EXPECT_TRUE(same_bits::identical(probe(Shuffled{}), expected));
  const auto lambda = [](std::size_t n, auto&& body) {
    for (std::size_t i = 0; i < n; ++i) body(n - 1 - i);
  };
  EXPECT_TRUE(same_bits::identical(probe(lambda), expected));
}

// The order in which particles are given changes only the rounding, for lattices, bodies with cuts and clouds.
template <class B>
class OrderOfParticles : public testing::Test {};
TYPED_TEST_SUITE(OrderOfParticles, Lists);

TYPED_TEST(OrderOfParticles, ChangesForcesOnlyByRounding) {
  constexpr int D = TypeParam::dimension;
  for (const auto& scene : scenes::all<D>()) {
    SCOPED_TRACE(scene.name);
    const std::size_t n = scene.x.size();
    std::vector<std::size_t> of(n);  // the particle of `scene` that comes at each place
    std::iota(of.begin(), of.end(), std::size_t{0});
    scenes::Random(9).shuffle(of);
    scenes::Scene<D> shuffled;
    for (const std::size_t i : of) {
      shuffled.reference.push_back(scene.reference[i]);
      shuffled.x.push_back(scene.x[i]);
      shuffled.v.push_back(scene.v[i]);
    }
    shuffled.bonded = [&](std::size_t i, std::size_t j) { return scene.bonded(of[i], of[j]); };
    const auto forces = [](const scenes::Scene<D>& s) {
      const auto bonds = equations::make_bonds<TypeParam>(s);
      auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<double>{1700, 1600, 1e4}),
                                        hmps::artificial(2e4), hmps::viscous(equations::density, equations::viscosity));
      equations::Vectors<D> f(s.x.size());
      force(hmps::vectors(s.x), hmps::vectors(s.v), hmps::vectors(f));
      return f;
    };
    const auto f = forces(scene), g = forces(shuffled);
    const equations::Tolerance<typename TypeParam::Scalar, D> tolerance(scene);
    EXPECT_LE(equations::largest_difference<D>(g, [&](std::size_t s) { return f[of[s]]; }),
              tolerance.elastic + tolerance.artificial + tolerance.viscous);
  }
}

}  // namespace internal_force_order_test
