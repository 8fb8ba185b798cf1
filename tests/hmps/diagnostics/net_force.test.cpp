// SPDX-License-Identifier: MIT
#include "hmps/diagnostics/net_force.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <vector>

#include "../../reference/backwards.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/terms/elastic.hpp"

namespace net_force_test {

using namespace hmps;

const auto all = [](std::size_t) { return true; };

TEST(NetForce, AddsUpTheForcesOfTheSet) {
  const std::vector<Vector<float, 3>> f{{1, 2, 3}, {10, 20, 30}, {-4, 0, 5}};
  const std::vector<double> volume{1, 0.5, 2};
  const ParticleSet ends(3, std::vector<Index>{0, 2});
  EXPECT_EQ(net_force(vectors(f), ends, scalars(volume)), (Vector<double, 3>(-7, 2, 13)));
  EXPECT_EQ(net_force(vectors(f), ends, 2.0), (Vector<double, 3>(-6, 4, 16)));
  EXPECT_EQ(net_force(vectors(f), ParticleSet(3, std::vector<Index>{}), 1.0), (Vector<double, 3>(0, 0, 0)));
}

TEST(NetForce, HasAMomentAboutAPoint) {
  const std::vector<Vector<double, 3>> x{{1, 0, 0}, {0, 1, 0}, {5, 5, 5}}, f{{0, 3, 0}, {0, 0, 2}, {7, 7, 7}};
  const ParticleSet set(3, std::vector<Index>{0, 1});
  EXPECT_EQ(net_moment(vectors(x), vectors(f), set, 2.0), (Vector<double, 3>(4, 0, 6)));
  // About another point it differs by the moment of the net force.
  const Vector<double, 3> about(0.5, 1, 2);
  const Vector<double, 3> there = net_moment(vectors(x), vectors(f), set, 2.0, about);
  EXPECT_EQ(there, (Vector<double, 3>(4, 0, 6) - cross<3>(about, net_force(vectors(f), set, 2.0))));
  const std::vector<Vector<double, 2>> flat{{1, 0}, {-1, 0}}, couple{{0, 3}, {0, -3}};
  EXPECT_EQ(net_moment(vectors(flat), vectors(couple), ParticleSet(2, all), 0.5)[0], 3.0);
}

TEST(NetForce, MeansTheDisplacementsOfTheSet) {
  const std::vector<Vector<double, 2>> reference{{1e6, 0}, {1, 1}, {2, 2}}, x{{1e6 + 0.25, 0}, {9, 9}, {2, 2.5}};
  EXPECT_EQ(mean_displacement(vectors(x), vectors(reference), ParticleSet(3, std::vector<Index>{0, 2})),
            (Vector<double, 2>(0.125, 0.25)));
}

TEST(NetForce, EveryExecutorGivesTheSameBits) {
  std::vector<Vector<double, 2>> x, f;
  for (int i = 0; i < 5000; ++i) {
    x.push_back(Vector<double, 2>(0.1 * i, 1.0 / (1 + i)));
    f.push_back(Vector<double, 2>(1.0 / (3 + i), 0.7 * i));
  }
  const ParticleSet set(x.size(), [](std::size_t i) { return i % 7 != 2; });
  const hmps_test::Backwards backwards;
  EXPECT_EQ(net_force(vectors(f), set, 0.3), net_force(vectors(f), set, 0.3, backwards));
  EXPECT_EQ(net_moment(vectors(x), vectors(f), set, 0.3)[0],
            net_moment(vectors(x), vectors(f), set, 0.3, Vector<double, 2>(0, 0), backwards)[0]);
  EXPECT_EQ(mean_displacement(vectors(x), vectors(f), set), mean_displacement(vectors(x), vectors(f), set, backwards));
}

/// A bar that is stretched evenly, with no stress across it: the face is pulled by stress times height.
TEST(NetForce, OfAnEvenStressIsThatOfTheTwoOutermostLayers) {
  constexpr double l0 = 1e-3, shear = 5e3, strain = 0.01;
  std::vector<Vector<double, 2>> reference, x;
  for (int a = 0; a < 10; ++a)
    for (int k = 0; k < 7; ++k) reference.emplace_back(a * l0, k * l0);
  for (const auto& X : reference) x.emplace_back((1 + strain) * X[0], X[1]);
  const LatticeBonds<double, 2> bonds(vectors(reference), {.spacing = l0});
  std::vector<Vector<double, 2>> f(x.size());
  internal_force(bonds, elastic(LinearElastic<double>{0, shear}))(vectors(x), vectors(f));
  const auto share = [&](std::size_t layers) {
    const ParticleSet end(x.size(), [&](std::size_t i) { return i >= x.size() - 7 * layers; });
    return -net_force(vectors(f), end, l0 * l0)[0] / (2 * shear * strain * 7 * l0);
  };
  EXPECT_NEAR(share(1), 1.5, 1e-9);
  EXPECT_NEAR(share(2), 1, 1e-9);
}

TEST(NetForce, RefusesBadInput) {
  const std::vector<Vector<double, 2>> x(3, Vector<double, 2>::Zero()), few(2, Vector<double, 2>::Zero());
  const ParticleSet three(3, all), none(3, std::vector<Index>{});
  EXPECT_THROW((void)net_force(vectors(few), three, 1.0), InputError);
  EXPECT_THROW((void)net_force(vectors(x), three, 0.0), InputError);
  EXPECT_THROW((void)net_moment(vectors(few), vectors(x), three, 1.0), InputError);
  EXPECT_THROW((void)net_moment(vectors(x), vectors(few), three, 1.0), InputError);
  EXPECT_THROW((void)net_moment(vectors(x), vectors(x), three, -1.0), InputError);
  const Vector<double, 2> nowhere(std::numeric_limits<double>::infinity(), 0);
  EXPECT_THROW((void)net_moment(vectors(x), vectors(x), three, 1.0, nowhere), InputError);
  EXPECT_THROW((void)mean_displacement(vectors(x), vectors(few), three), InputError);
  EXPECT_THROW((void)mean_displacement(vectors(x), vectors(x), none), InputError);
}

}  // namespace net_force_test
