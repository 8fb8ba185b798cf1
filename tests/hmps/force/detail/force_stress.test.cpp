// SPDX-License-Identifier: MIT
#include "hmps/force/detail/force_stress.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "../../../reference/message_of.hpp"
#include "../../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/diagnostics/stress.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/viscous.hpp"

namespace force_stress_test {

template <int D>
using Tensors = std::vector<hmps::Matrix<double, D>>;

constexpr double K_law = 14e3, K_mean = 400e3;
const auto law = hmps::MooneyRivlin<double>{1700, 1500, 0.5 * K_law};

template <int D>
scenes::Scene<D> strained_sheet() {
  scenes::Scene<D> scene;
  scene.reference = scenes::box<D>(scenes::extent<D>(2, 9, 6));
  scenes::move(scene, 0.1);
  return scene;
}

/// The sum of V P : dF is the change of the energies of law and mean dilatation, for a displacement in any direction.
template <int D, class Force, class Volume>
void expect_work_of_stresses(const Force& force, const scenes::Scene<D>& scene, const Volume& volume) {
  const std::size_t n = scene.x.size();
  Tensors<D> P(n), before(n), after(n);
  force.first_piola_kirchhoff_stresses(hmps::vectors(scene.x), hmps::matrices(P));
  scenes::Random random(11);
  const double h = 1e-6 * scene.spacing;
  auto back = scene.x, ahead = scene.x;
  for (std::size_t i = 0; i < n; ++i)
    for (int d = 0; d < D; ++d) {
      const double step = h * random(-1, 1);
      back[i][d] -= step;
      ahead[i][d] += step;
    }
  hmps::deformation_gradient(force.bonds(), hmps::vectors(back), hmps::matrices(before));
  hmps::deformation_gradient(force.bonds(), hmps::vectors(ahead), hmps::matrices(after));
  double work = 0;
  for (std::size_t i = 0; i < n; ++i)
    work += hmps::at_particle(volume, i) * P[i].cwiseProduct(after[i] - before[i]).sum();
  const double rise =
      force.energy(hmps::vectors(ahead), volume).total() - force.energy(hmps::vectors(back), volume).total();
  EXPECT_NEAR(work, rise, 1e-6 * std::abs(rise));
}

template <class Bonds, int D = Bonds::dimension>
void expect_work_with_every_mean(const Bonds& bonds, const scenes::Scene<D>& scene) {
  const double volume = std::pow(scene.spacing, D);
  expect_work_of_stresses<D>(hmps::internal_force(bonds, hmps::elastic(law)), scene, volume);
  expect_work_of_stresses<D>(hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(K_mean)), scene,
                             volume);
  expect_work_of_stresses<D>(hmps::internal_force(bonds, hmps::mean_dilatation<2>(K_mean), hmps::elastic(law)), scene,
                             volume);
}

TEST(ForceStress, DoesTheWorkOfTheEnergies) {
  const auto sheet = strained_sheet<3>();
  expect_work_with_every_mean(hmps::LatticeBonds<double, 3>(hmps::vectors(sheet.reference), {.spacing = sheet.spacing}),
                              sheet);
  const auto plane = strained_sheet<2>();
  expect_work_with_every_mean(hmps::BondList<double, 2>(hmps::vectors(plane.reference), {.spacing = plane.spacing}),
                              plane);
}

TEST(ForceStress, DoesTheWorkOfTheEnergiesOfUnlikeVolumes) {
  const auto scene = strained_sheet<3>();
  scenes::Random random(5);
  std::vector<double> volumes(scene.x.size());
  for (double& own : volumes) own = std::pow(scene.spacing, 3) * random(0.7, 1.3);
  const auto V = hmps::scalars(volumes);
  const hmps::BondList<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing}, V);
  expect_work_of_stresses<3>(hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(K_mean)), scene, V);
  expect_work_of_stresses<3>(hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation<2>(K_mean)), scene,
                             V);
}

TEST(ForceStress, DoesTheWorkOfTheEnergiesOfUnlikeMaterials) {
  const auto scene = strained_sheet<3>();
  scenes::Random random(6);
  std::vector<double> shear(scene.x.size()), bulk(scene.x.size());
  for (double& own : shear) own = 7e3 * random(0.3, 3);
  for (double& own : bulk) own = K_mean * random(0.3, 3);
  const auto mu = hmps::scalars(shear), K = hmps::scalars(bulk);
  const auto own_law = hmps::elastic([mu](const auto& at) {
    const auto own = at(mu);
    return hmps::NeoHookean{own, 2 * own};
  });
  const double volume = std::pow(scene.spacing, 3);
  const hmps::BondList<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  auto force = hmps::internal_force(bonds, own_law, hmps::mean_dilatation<2>(K));
  expect_work_of_stresses<3>(force, scene, volume);
  force.restrict_to([](std::size_t i) { return i < 3; });  // has no effect on stresses
  expect_work_of_stresses<3>(force, scene, volume);
  const hmps::LatticeBonds<float, 3> in_float(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  Tensors<3> P(scene.x.size()), of_float(P);
  force.first_piola_kirchhoff_stresses(hmps::vectors(scene.x), hmps::matrices(P));
  hmps::internal_force(in_float, own_law, hmps::mean_dilatation<2>(K))
      .first_piola_kirchhoff_stresses(hmps::vectors(scene.x), hmps::matrices(of_float));
  for (std::size_t i = 0; i < P.size(); ++i)
    EXPECT_LE((P[i] - of_float[i]).norm(), 1e-3 * P[i].norm()) << "particle " << i;
}

// A uniform dilatation has the pressure of the whole bulk modulus; the law alone gives a thirtieth of it.
TEST(ForceStress, HoldsThePressureOfTheMeanDilatation) {
  const auto scene = strained_sheet<3>();
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  auto x = scene.reference;
  for (auto& point : x) point *= 1.001;
  const double J = std::pow(1.001, 3);
  const auto force = hmps::internal_force(bonds, hmps::elastic(hmps::NeoHookean<double>{7e3, K_law}),
                                          hmps::mean_dilatation<2>(K_mean), hmps::artificial(1e4));
  Tensors<3> sigma(x.size());
  force.cauchy_stresses(hmps::vectors(x), hmps::matrices(sigma));
  const double p = hmps::cauchy_stress(hmps::NeoHookean<double>{7e3, K_law + K_mean},
                                       hmps::Matrix<double, 3>(1.001 * hmps::Matrix<double, 3>::Identity()))
                       .trace() /
                   3;
  ASSERT_NEAR(p, (K_law + K_mean) * (J - 1), 0.01 * p);
  for (const auto& stress : sigma) EXPECT_NEAR(stress.trace() / 3, p, 0.002 * p);
}

TEST(ForceStress, IsThatOfTheLawWithoutMeanDilatation) {
  const auto scene = strained_sheet<3>();
  const hmps::BondList<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  Tensors<3> F(scene.x.size()), of_force(F), of_law(F);
  auto force = hmps::internal_force(bonds, hmps::elastic([](const auto&) { return law; }), hmps::artificial(2e4),
                                    hmps::viscous(1000, 1e-3), hmps::record(hmps::matrices(F)));
  std::vector<hmps::Vector<double, 3>> f(F.size());
  force(hmps::vectors(scene.x), hmps::vectors(scene.v), hmps::vectors(f));
  force.cauchy_stresses(hmps::vectors(scene.x), hmps::matrices(of_force));
  hmps::cauchy_stresses(hmps::matrices(F), law, hmps::matrices(of_law));
  for (std::size_t i = 0; i < F.size(); ++i)
    EXPECT_LE((of_force[i] - of_law[i]).norm(), 1e-9 * of_law[i].norm()) << "particle " << i;
}

TEST(ForceStress, NamesTheInvalidArgument) {
  const auto scene = strained_sheet<3>();
  const hmps::BondList<double, 3> bonds(hmps::vectors(scene.reference), {.spacing = scene.spacing});
  const auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(K_mean));
  Tensors<3> sigma(scene.x.size()), fewer(scene.x.size() - 1);
  auto x = scene.x;
  const std::string wrong =
      hmps_test::message_of<hmps::InputError>([&] { force.cauchy_stresses(hmps::vectors(x), hmps::matrices(fewer)); });
  EXPECT_NE(wrong.find("stresses"), std::string::npos) << wrong;
  x[3][1] = std::numeric_limits<double>::quiet_NaN();
  const std::string lost =
      hmps_test::message_of<hmps::InputError>([&] { force.cauchy_stresses(hmps::vectors(x), hmps::matrices(sigma)); });
  EXPECT_NE(lost.find("component 1 of the position of particle 3"), std::string::npos) << lost;
  // Part of the body is turned inside out. The means over neighbours spread that, but the error names such a particle.
  x = scene.x;
  for (std::size_t i = 60; i < x.size(); ++i) x[i][2] = -x[i][2];
  std::vector<Tensors<3>::value_type> F(x.size());
  hmps::deformation_gradient(bonds, hmps::vectors(x), hmps::matrices(F));
  std::size_t first = 0;
  while (first < F.size() && F[first].determinant() > 0) ++first;
  ASSERT_GT(first, 0u);
  ASSERT_LT(first, F.size());
  const std::string crushed =
      hmps_test::message_of<hmps::StateError>([&] { force.cauchy_stresses(hmps::vectors(x), hmps::matrices(sigma)); });
  EXPECT_NE(crushed.find("of particle " + std::to_string(first) + " is not finite"), std::string::npos) << crushed;
}

}  // namespace force_stress_test
