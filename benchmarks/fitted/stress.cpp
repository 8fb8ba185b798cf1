// SPDX-License-Identifier: MIT
// The stress in the outermost layer of a bent strip, from the F of the force, from recovered gradients, and from
// these with the plane stress condition.
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
/// thirds of the width, over the stress of beam theory at the height of the particle: the von Mises stress from the F
/// of the force and from recovered gradients, the axial and mean stress of `InternalForce::cauchy_stresses`, and all
/// three from recovered gradients with the plane stress condition.
struct Found {
  double plain = 0, recovered = 0, axial = 0, mean = 0, plane = 0, plane_axial = 0, plane_mean = 0;
};

[[nodiscard]] Found bend(const Placement& at, int layers) {
  const double l0 = thickness / layers;
  const Vector half(length / 2, width / 2, thickness / 2);
  const auto part = [&](double from, double to) {
    return at.placed(hmps::Box<double, 3>{Vector(from, 0, 0) - half, Vector(to, width, thickness) - half});
  };
  const auto fit = [&](double from, double to) {
    const Vector reach = Vector::Constant(0.03);
    return hmps::fit_particles(part(from, to), hmps::Box<double, 3>{-reach, reach}, l0);
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
  auto plane = recovered;
  const auto normals = hmps::wall_normals(part(-2.5 * l0, length), body.X(), l0);
  hmps::impose_plane_stress(hmps::matrices(plane), material(), hmps::vectors(normals));
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
    const hmps::Matrix<double, 3> in_plane = hmps::cauchy_stress(material(), plane[i]);
    sum.plane += hmps::von_mises_stress(in_plane) / beam;
    sum.plane_axial += sign * along.dot(in_plane * along) / beam;
    sum.plane_mean += sign * in_plane.trace() / 3 / beam;
    ++count;
  }
  for (double* value :
       {&sum.plain, &sum.recovered, &sum.axial, &sum.mean, &sum.plane, &sum.plane_axial, &sum.plane_mean})
    *value /= count;
  return sum;
}

}  // namespace
}  // namespace stress_detail

report::Table outer_stress(bool quick) {
  using namespace stress_detail;
  using report::places;
  report::Table table{.name = "stress",
                      .header = {"layers", "placements", "von Mises, F of the force", "von Mises, recovered",
                                 "von Mises, plane stress", "range", "scatter", "axial, of the force",
                                 "axial, plane stress", "mean, of the force", "mean, plane stress"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4}) {
    std::vector<Found> found;
    for (const Placement& at : any_placements(quick ? 1 : 6, thickness / layers)) found.push_back(bend(at, layers));
    const auto over_placements = [&](double Found::*value) {
      std::vector<double> values;
      for (const Found& one : found) values.push_back(one.*value);
      return spread(values);
    };
    const auto mean = [&](double Found::*value) { return places(over_placements(value).mean, 2); };
    const Spread by = over_placements(&Found::plane);
    table.rows.push_back(
        {std::to_string(layers), std::to_string(found.size()), mean(&Found::plain), mean(&Found::recovered),
         places(by.mean, 2), places(by.least, 2) + " to " + places(by.most, 2), places(100 * by.scatter, 1) + " %",
         mean(&Found::axial), mean(&Found::plane_axial), mean(&Found::mean), mean(&Found::plane_mean)});
    const double pressure = over_placements(&Found::plane_mean).mean;
    table.check(std::abs(by.mean - 1) < 0.03 && std::abs(pressure - 1. / 3) < 0.02,
                "stress: " + std::to_string(layers) + " layers miss their bound");
  }
  return table;
}

}  // namespace fitted
