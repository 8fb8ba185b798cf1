// SPDX-License-Identifier: MIT
// The stress in the outermost layer of a bent strip, from the F of the force and from recovered gradients.
#include <cmath>
#include <vector>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {
namespace stress_detail {
namespace {

constexpr double length = 40e-3, width = 10e-3, thickness = 3e-3;  // m
constexpr double load = 106;                                       // N/m3 across the strip

[[nodiscard]] hmps::MooneyRivlin<> material() { return hmps::MooneyRivlin<>::from_young(30e3, 0.3e6); }

/// Means over the particles of the outermost layers, from 0.2 to 0.5 of the length from the clamp and in the middle two
/// thirds of the width, over the stress of beam theory at the height of the particle: the von Mises stress from two
/// deformation gradients, and the axial and mean stress of `InternalForce::cauchy_stresses`.
struct Found {
  double plain = 0, recovered = 0, axial = 0, mean = 0;
};

[[nodiscard]] Found bend(const Placement& at, int layers) {
  const double l0 = thickness / layers;
  const Vector half(length / 2, width / 2, thickness / 2);
  const auto fit = [&](double from, double to) {
    const hmps::Box<double, 3> part{Vector(from, 0, 0) - half, Vector(to, width, thickness) - half};
    const Vector reach = Vector::Constant(0.03);
    return hmps::fit_particles(at.placed(part), hmps::Box<double, 3>{-reach, reach}, l0);
  };
  Piece strip = fit(l0 / 2, length);
  const std::size_t moving = strip.size();
  strip.append(fit(-2.5 * l0, l0 / 2));
  const auto chosen = scenes::stabiliser_of(strip, l0, material());
  scenes::Body<3> body(l0, strip.positions);
  const hmps::BondList<double, 3> bonds(body.X(), {.spacing = l0});
  auto force = scenes::thin_wall_force(bonds, material(), chosen,
                                       hmps::gravity(1000, Vector(at.direction(Vector(0, 0, -load / 1000)))));
  hmps::relax(
      force, body.x(), body.v(), body.f(), 1000,
      {.spacing = l0, .tolerance = 3e-4, .load = load * length * width * thickness, .moves = [&](std::size_t i) {
         return i < moving;
       }});
  std::vector<hmps::Matrix<double, 3>> plain(body.size()), recovered(body.size());
  hmps::deformation_gradient(bonds, body.x(), hmps::matrices(plain));
  hmps::recovered_gradients(bonds, body.x(), hmps::matrices(recovered));
  std::vector<hmps::Matrix<double, 3>> stress(body.size());
  force.cauchy_stresses(body.x(), hmps::matrices(stress));
  const auto law = scenes::with_bulk(material(), chosen.bulk.law);
  Found sum;
  int count = 0;
  for (std::size_t i = 0; i < moving; ++i) {
    const Vector X = at.local(body.reference[i]);
    const double from_clamp = X[0] + half[0], outermost = half[2] - thickness / layers / 2;
    if (std::abs(X[2]) < outermost - 0.15 * l0 || std::abs(X[1]) > width / 3) continue;
    if (from_clamp < 0.2 * length || from_clamp > 0.5 * length) continue;
    const double beam = load * std::pow(length - from_clamp, 2) / 2 * std::abs(X[2]) * 12 / std::pow(thickness, 2);
    sum.plain += hmps::von_mises_stress(law, plain[i]) / beam;
    sum.recovered += hmps::von_mises_stress(law, recovered[i]) / beam;
    const double sign = X[2] > 0 ? 1 : -1;  // the upper side is in tension
    const Vector along = at.direction(Vector(1, 0, 0));
    sum.axial += sign * along.dot(stress[i] * along) / beam;
    sum.mean += sign * stress[i].trace() / 3 / beam;
    ++count;
  }
  return {sum.plain / count, sum.recovered / count, sum.axial / count, sum.mean / count};
}

}  // namespace
}  // namespace stress_detail

report::Table outer_stress(bool quick) {
  using namespace stress_detail;
  using report::places;
  report::Table table{.name = "stress",
                      .header = {"layers", "placements", "von Mises, F of the force", "von Mises, recovered gradients",
                                 "range", "scatter", "axial stress of the force", "mean stress of the force"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4}) {
    std::vector<double> plain, recovered, axial, mean;
    for (const Placement& at : any_placements(quick ? 1 : 6, thickness / layers)) {
      const Found found = bend(at, layers);
      plain.push_back(found.plain);
      recovered.push_back(found.recovered);
      axial.push_back(found.axial);
      mean.push_back(found.mean);
    }
    const Spread by = spread(recovered);
    table.rows.push_back({std::to_string(layers), std::to_string(plain.size()), places(spread(plain).mean, 2),
                          places(by.mean, 2), places(by.least, 2) + " to " + places(by.most, 2),
                          places(100 * by.scatter, 1) + " %", places(spread(axial).mean, 2),
                          places(spread(mean).mean, 2)});
    table.check(std::abs(by.mean - 1) < (layers == 2 ? 0.2 : 0.07),
                "stress: " + std::to_string(layers) + " layers miss their bound");
  }
  return table;
}

}  // namespace fitted
