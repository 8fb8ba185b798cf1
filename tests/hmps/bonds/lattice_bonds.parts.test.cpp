// SPDX-License-Identifier: MIT
// Parts of a body, each with the bonds of its own particles and two layers borrowed from its neighbours, give the bits
// of the whole: what several machines rely on.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/lanes/detail/window.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"
#include "reference/scenes.hpp"

namespace lattice_bonds_parts_test {

using Vector = hmps::Vector<double, 3>;
using Bonds = hmps::LatticeBonds<float, 3>;
using State = std::vector<Vector>;

const double l0 = scenes::Scene<3>::spacing;

auto force_of(const Bonds& bonds) {
  return hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)), hmps::artificial(10e3),
                              hmps::viscous(1000, 2e-3));
}

/// A strained body that moves, far from its reference position.
struct Body {
  State X, x = X, v = X;
  Bonds bonds{hmps::vectors(X), {.spacing = l0}};
  State f = State(X.size(), Vector::Zero());

  explicit Body(State reference = scenes::box<3>({11, 6, 5})) : X(std::move(reference)) {
    scenes::Random random(7);
    for (std::size_t i = 0; i < x.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        x[i][c] = 0.3 + 1.05 * X[i][c] + random(-0.05, 0.05) * l0;
        v[i][c] = random(-1, 1);
      }
    force_of(bonds)(hmps::vectors(std::as_const(x)), hmps::vectors(std::as_const(v)), hmps::vectors(f));
  }
};

/// How many of the particles whose `part_of` is `part` get a force with other bits than in the whole, whether or not
/// the part knows the `axes` and the displacement that the whole subtracts.
std::size_t differences(const Body& body, const std::vector<int>& part_of, int part, bool axes, bool displacement) {
  const std::size_t n = body.X.size();
  std::vector<int> layer(n, 3);
  for (std::size_t i = 0; i < n; ++i)
    if (part_of[i] == part) layer[i] = 0;
  for (const int next : {1, 2})
    for (std::size_t i = 0; i < n; ++i)
      if (layer[i] == next - 1)
        body.bonds.for_each_bond(i, [&](std::size_t j, const auto&, auto) { layer[j] = std::min(layer[j], next); });
  std::vector<std::size_t> particles;
  for (std::size_t i = 0; i < n; ++i)
    if (layer[i] <= 2) particles.push_back(i);
  State X, x, v;
  for (const std::size_t i : particles) {
    X.push_back(body.X[i]);
    x.push_back(body.x[i]);
    v.push_back(layer[i] <= 1 ? body.v[i] : Vector::Zero());  // the forces of the second layer do not count
  }
  hmps::BondSettings settings{.spacing = l0, .unbonded = true};
  if (axes) settings.axes = hmps::lattice_axes(hmps::vectors(body.X), l0);
  Bonds bonds(hmps::vectors(X), settings, [&](std::size_t i, std::size_t) { return layer[particles[i]] <= 1; });
  const std::size_t middle = body.bonds.particle(n / 2);
  if (displacement) bonds.subtract_displacement(body.x[middle] - body.X[middle]);
  State f(X.size(), Vector::Zero());
  auto force = force_of(bonds);
  force.restrict_to([&](std::size_t i) { return layer[particles[i]] == 0; });
  force(hmps::vectors(x), hmps::vectors(v), hmps::vectors(f));
  std::size_t found = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (layer[particles[i]] == 0 && f[i] != body.f[particles[i]]) ++found;
  return found;
}

TEST(PartsOfALattice, HaveTheBitsOfTheWhole) {
  const Body body;
  scenes::Random random(3);
  std::vector<int> slabs, scattered;
  for (const Vector& X : body.X) {
    slabs.push_back(static_cast<int>((X[0] - body.X[0][0]) / l0 + 0.5) / 4);
    scattered.push_back(random() < 0.5 ? 0 : 1);
  }
  for (const int part : {0, 1, 2}) EXPECT_EQ(differences(body, slabs, part, true, true), 0u) << "slab " << part;
  for (const int part : {0, 1}) EXPECT_EQ(differences(body, scattered, part, true, true), 0u) << "scattered " << part;
}

// Half a hollow ball on a plate. Where the target reads windows fast, the blocks of the ball have windows and those of
// the plate have runs. The parts cut the plate obliquely, so that its blocks have windows there.
TEST(PartsOfALattice, HaveTheBitsOfTheWholeInThinWalls) {
  const Eigen::Vector3d middle(10, 10, 3);
  const Body body(scenes::lattice<3>({21, 21, 14}, [&](const auto& cell) {
    const double radius = (cell.template cast<double>() - middle).norm();
    return cell[2] < 3 || (radius >= 7 && radius < 10);
  }));
  std::size_t runs = 0, windows = 0;
  for (std::size_t block = 0; block < body.bonds.block_count(); ++block)
    body.bonds.for_each_row(block, [&](const auto& row) { ++(requires { row.places; } ? windows : runs); });
  EXPECT_GT(runs, 0u);
  EXPECT_EQ(windows > 0, hmps::detail::windows_are_fast);
  std::vector<int> wedges;
  for (const Vector& X : body.X) {
    const Vector away = X - body.X[0];
    wedges.push_back(away[1] < 0.3 * away[0] ? 0 : away[1] < 0.6 * away[0] ? 1 : 2);
  }
  for (const int part : {0, 1, 2}) EXPECT_EQ(differences(body, wedges, part, true, true), 0u) << "wedge " << part;
}

// Without the axes or the displacement of the whole, parts round differently: this is what `axes` and
// `subtract_displacement` are for, and shows that the comparison above can fail.
TEST(PartsOfALattice, RoundDifferentlyWithTheirOwnAxes) {
  const Body body;
  std::vector<int> slabs;
  for (const Vector& X : body.X) slabs.push_back(static_cast<int>((X[0] - body.X[0][0]) / l0 + 0.5) / 4);
  EXPECT_GT(differences(body, slabs, 0, false, true), 0u);
  EXPECT_GT(differences(body, slabs, 2, true, false), 0u);
}

TEST(PartsOfALattice, AllowUnbondedParticlesOnlyOnRequest) {
  const State X = scenes::box<3>({4, 4, 4});
  const auto bonded = [](std::size_t i, std::size_t) { return i != 5; };
  EXPECT_THROW(Bonds(hmps::vectors(X), {.spacing = l0}, bonded), hmps::InputError);
  const Bonds bonds(hmps::vectors(X), {.spacing = l0, .unbonded = true}, bonded);
  EXPECT_TRUE(bonds.shape_inverse(5).isZero());
}

// Whole blocks of particles without bonds, and a body without any: F is 1 there, and nothing beyond the lists is read.
TEST(PartsOfALattice, BlocksWithoutBondsAreUndeformed) {
  const State X = scenes::box<3>({9, 9, 9});
  for (const std::size_t held : {std::size_t{243}, X.size()}) {
    const auto bonded = [&](std::size_t i, std::size_t j) { return std::min(i, j) >= held; };
    const Bonds bonds(hmps::vectors(X), {.spacing = l0, .unbonded = true}, bonded);
    State x = X, f = X;
    for (Vector& r : x) r *= 1.1;
    std::vector<hmps::Matrix<double, 3>> F(X.size());
    auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(1e4, 1e5)),
                                      hmps::artificial(1e4), hmps::record(hmps::matrices(F)));
    force(hmps::vectors(x), hmps::vectors(f));
    for (std::size_t i = 0; i < held; ++i) {
      EXPECT_TRUE(F[i].isIdentity(0)) << i;
      EXPECT_TRUE(f[i].isZero(0)) << i;
    }
  }
}

TEST(PartsOfALattice, RejectInvalidAxesAndDisplacements) {
  const State X = scenes::box<3>({4, 4, 4});
  EXPECT_THROW(Bonds(hmps::vectors(X), {.spacing = l0, .axes = {0, 1, 1}}), hmps::InputError);
  Bonds bonds(hmps::vectors(X), {.spacing = l0});
  EXPECT_THROW(bonds.subtract_displacement(Vector(0, std::nan(""), 0)), hmps::InputError);
  EXPECT_NO_THROW(Bonds(hmps::vectors(X), {.spacing = l0, .axes = {2, 0, 1}}));
}

}  // namespace lattice_bonds_parts_test
