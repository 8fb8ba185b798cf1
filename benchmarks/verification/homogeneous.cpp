// SPDX-License-Identifier: MIT
// States of homogeneous stress: the method should be right at any spacing.
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace homogeneous_detail {
namespace {

template <int D>
using Tensor = hmps::Matrix<double, D>;

/// Cauchy's stress of the seed law.
template <int D>
Tensor<D> cauchy(const Tensor<D>& F) {
  return hmps::first_piola_kirchhoff(tissue, F) * F.transpose() / F.determinant();
}

/// The deformation gradient that stretches the axes below `stretched` by `stretch`, and the others such that they carry
/// no stress.
Tensor<3> free_stretch(double stretch, int stretched) {
  Tensor<3> F = Tensor<3>::Identity();
  for (int c = 0; c < stretched; ++c) F(c, c) = stretch;
  double low = 0.1, high = 10;
  for (int k = 0; k < 200; ++k) {
    const double middle = (low + high) / 2;
    for (int c = stretched; c < 3; ++c) F(c, c) = middle;
    (cauchy<3>(F)(2, 2) > 0 ? high : low) = middle;
  }
  return F;
}

/// A box of `n` free particles along each axis, continued by two held layers in both directions along the axes below
/// `bounded`. The held particles are placed at the positions given by `F`; the free ones start close to theirs and are
/// brought to rest.
Body<3> at_rest(int n, const Method& method, const Tensor<3>& F, int bounded) {
  const double l0 = 1e-3;
  hmps::Vector<double, 3> lower = hmps::Vector<double, 3>::Zero(), upper = hmps::Vector<double, 3>::Constant(n * l0);
  for (int c = 0; c < bounded; ++c) lower[c] -= 2 * l0, upper[c] += 2 * l0;
  const hmps::Box<double, 3> box{lower, upper};
  Body<3> body(l0,
               hmps::fill_lattice(box, box, l0, hmps::Vector<double, 3>(hmps::Vector<double, 3>::Constant(l0 / 2))));
  const auto moves = [&](std::size_t i) {
    for (int c = 0; c < bounded; ++c)
      if (body.reference[i][c] < 0 || body.reference[i][c] > n * l0) return false;
    return true;
  };
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  for (std::size_t i = 0; i < body.size(); ++i) {
    body.position[i] = F * body.reference[i];
    for (int c = 0; c < 3 && moves(i); ++c) body.position[i][c] += 0.02 * l0 * noise(i, c);
  }
  with_force(method, body.F(), bonds, tissue, [&](auto& force) { settle(body, force, moves, 0, 1e-9); });
  return body;
}

/// A homogeneous state of stress: the components (r, c) of Cauchy's stress at some strains, and the right answers.
struct Case {
  Tensor<3> F;
  int r, c;
  std::string name;
  double answer;
};
Problem homogeneous(std::string name, std::string title, std::string text, int bounded,
                    const std::vector<Case>& cases) {
  Problem problem{.name = std::move(name),
                  .title = std::move(title),
                  .text = std::move(text),
                  .quantities = {},
                  .across = "free particles along each axis",
                  .sizes = {3, 4, 5},
                  .methods = bulky_methods,
                  .run = {}};
  for (const Case& one : cases)
    problem.quantities.push_back(
        {.name = one.name, .unit = "Pa", .answer = one.answer, .source = "exact", .bound = 2e-6});
  problem.run = [bounded, cases](int n, const Method& method) {
    Measured measured{.spacing = 1e-3, .particles = 0, .values = {}};
    for (const Case& one : cases) {
      const Body<3> body = at_rest(n, method, one.F, bounded);
      measured.particles = body.size();
      const auto middle = nearest(body, hmps::Vector<double, 3>(hmps::Vector<double, 3>::Constant(n * 5e-4)));
      measured.values.push_back(cauchy<3>(body.gradient[middle])(one.r, one.c));
    }
    return measured;
  };
  return problem;
}

}  // namespace
}  // namespace homogeneous_detail

Problem uniaxial_stress() {
  using namespace homogeneous_detail;
  std::vector<Case> cases;
  for (const auto& [stretch, answer] :
       {std::pair{0.5, -17515.426}, {0.7, -7597.4589}, {1.3, 5418.6321}, {1.5, 8771.2136}, {2.0, 17414.0623}})
    cases.push_back({free_stretch(stretch, 1), 0, 0, "stress at " + examples::message(stretch), answer});
  return homogeneous(
      "uniaxial stress", "3. Uniaxial stress",
      "A bar of the paper's soft tissue with free sides, whose ends are held at a given stretch. The free particles "
      "start up to 0.02 spacings away from equilibrium and come to rest by relaxation; the stress in the middle is "
      "compared.",
      1, cases);
}

Problem equibiaxial_stress() {
  using namespace homogeneous_detail;
  std::vector<Case> cases;
  for (const auto& [stretch, answer] : {std::pair{0.8, -9822.3128}, {1.1, 3859.0892}, {1.5, 21863.3411}})
    cases.push_back({free_stretch(stretch, 2), 0, 0, "stress at " + examples::message(stretch), answer});
  return homogeneous("equibiaxial stress", "4. Equibiaxial stress",
                     "The same for a sheet that is held all around its rim and stretched equally along two axes.", 2,
                     cases);
}

Problem simple_shear() {
  using namespace homogeneous_detail;
  Tensor<3> F = Tensor<3>::Identity();
  F(0, 1) = 1;
  return homogeneous(
      "simple shear", "5. Simple shear",
      "The same for a block that is held on all sides and sheared by gamma = 1. The answers are the shear stress, 2 "
      "(C1 + C2) gamma, and the normal stresses that accompany it.",
      3, {{F, 0, 1, "sigma12", 6666.6667}, {F, 0, 0, "sigma11", 3333.3333}, {F, 1, 1, "sigma22", -3333.3333}});
}

}  // namespace verification
