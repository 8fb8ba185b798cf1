// SPDX-License-Identifier: MIT
// Contact between two blocks and their internal force, behind a function without types of the library. Compiled as
// FUNCTION by each of two compilers.
#include <cstddef>
#include <vector>

#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/contact/contact.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/record.hpp"

using Vector = hmps::Vector<double, 3>;

extern "C" std::size_t FUNCTION(double* contact_forces, double* internal_forces, std::size_t most) {
  const double l0 = 1e-3;
  const hmps::Box<double, 3> lower{Vector(0, 0, -4 * l0), Vector(6 * l0, 6 * l0, 0)};
  const hmps::Box<double, 3> upper{Vector(0, 0, 0), Vector(6 * l0, 6 * l0, 4 * l0)};
  std::vector<Vector> x = hmps::fill_lattice(lower, lower, l0, Vector(l0 / 2, l0 / 2, l0 / 2));
  const std::size_t first = x.size();
  for (const Vector& p : hmps::fill_lattice(upper, upper, l0, Vector(l0 / 2, l0 / 2, l0 / 2))) x.push_back(p);
  if (3 * x.size() > most) return 0;
  const auto same_body = [&](std::size_t i, std::size_t j) { return (i < first) == (j < first); };
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = l0}, same_body);
  for (std::size_t i = 0; i < x.size(); ++i)
    x[i] += 0.1 * l0 * Vector(static_cast<double>(i % 3), static_cast<double>(i % 2), i < first ? 0.3 : -1.7);

  std::vector<Vector> v(x.size(), Vector(0.1, 0, 0)), f(x.size(), Vector::Zero());
  std::vector<hmps::Matrix<double, 3>> F(x.size());
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)),
                                    hmps::artificial(10e3), hmps::record(hmps::matrices(F)));
  force(hmps::vectors(x), hmps::vectors(f));
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) internal_forces[3 * i + c] = f[i][static_cast<Eigen::Index>(c)];

  std::vector<hmps::Index> of_lower, of_upper;
  for (std::size_t i = 0; i < x.size(); ++i) (i < first ? of_lower : of_upper).push_back(static_cast<hmps::Index>(i));
  hmps::MetaballContact<double, 3> contact({.spacing = l0, .density = 1000, .friction = 0.2});
  const auto below = contact.add_organ({"lower", of_lower, of_lower});
  contact.add_pair(below, contact.add_organ({"upper", of_upper, of_upper}));
  for (Vector& density : f) density.setZero();
  contact.add(hmps::vectors(x), hmps::vectors(v), hmps::matrices(F), hmps::vectors(f), 1e-5);
  for (std::size_t i = 0; i < x.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c) contact_forces[3 * i + c] = f[i][static_cast<Eigen::Index>(c)];
  return 3 * x.size();
}
