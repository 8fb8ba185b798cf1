// SPDX-License-Identifier: MIT
// A free ring that is squeezed across, at any orientation.
#include <cmath>
#include <numbers>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {
namespace ring_detail {
namespace {

constexpr double radius = 24e-3, wall = 4.8e-3, width = 14.4e-3;  // m, the radius in the middle of the wall
constexpr double load = 1000;                                     // N/m3 in the middle of the wall
constexpr double answer = 0.2151;                                 // mm, by finite elements (C3D20R of CalculiX)

/// How far the ring is squeezed, in mm: A of the displacement A (x, 0, -z) / R, by least squares.
[[nodiscard]] double squeeze(const Placement& at, double spacing) {
  const auto tube = [](const Vector& x) {
    const double across = std::abs(std::hypot(x[0], x[2]) - radius) - wall / 2, along = std::abs(x[1]) - width / 2;
    return std::hypot(std::max(across, 0.0), std::max(along, 0.0)) + std::min(std::max(across, along), 0.0);
  };
  const Vector reach = Vector::Constant(0.032);
  const Piece ring = hmps::fit_particles(at.placed(tube), hmps::Box<double, 3>{-reach, reach}, spacing);
  FittedBody body(spacing, {ring}, Choice::thin_wall, 0, hmps::MooneyRivlin<>::from_young(100e3, 1e6));
  const auto pattern = [](const Vector& x) -> Vector { return {x[0] / radius, 0, -x[2] / radius}; };
  return body.gives_way(at, {.pattern = pattern, .size = load, .of_free_body = true});
}

}  // namespace
}  // namespace ring_detail

report::Table pinched_ring(bool quick) {
  using namespace ring_detail;
  using report::places;
  report::Table table{.name = "ring",
                      .header = {"layers", "placements", "squeezed by (mm)", "range", "scatter", "error"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4}) {
    const double l0 = wall / layers;
    const auto placements = any_placements(quick ? 2 : 6, l0);
    std::vector<double> found;
    for (const Placement& at : placements) found.push_back(squeeze(at, l0));
    const Spread by = spread(found);
    table.rows.push_back({std::to_string(layers), std::to_string(placements.size()), places(by.mean, 3),
                          places(by.least, 3) + " to " + places(by.most, 3), places(100 * by.scatter, 1) + " %",
                          percent(by.mean / answer - 1)});
    const std::string which = "the ring of " + std::to_string(layers) + " layers ";
    table.check(std::abs(by.mean / answer - 1) < (layers < 3 ? 0.06 : 0.03), which + "misses its bound");
    table.check(by.scatter < 0.02, which + "depends on how it lies");
  }
  return table;
}

}  // namespace fitted
