// SPDX-License-Identifier: MIT
// The free bar of benchmarks/verification in torsional vibration, at any orientation.
#include <array>
#include <cmath>
#include <numbers>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {
namespace bar_detail {
namespace {

constexpr double length = 0.5, height = 0.05, density = 1000;  // m, m, kg/m3
constexpr double answer = 5.697;                               // Hz, by finite elements
constexpr std::array on_lattice{0.344, 0.173, 0.087, 0.047};   // errors of docs/measured/verification.md, from 2 layers

/// The first frequency of torsion in Hz.
[[nodiscard]] double twist(const Placement& at, double spacing, Choice choice) {
  const Vector half(length / 2, height / 2, height / 2), reach = Vector::Constant(0.32);
  const Piece bar =
      hmps::fit_particles(at.placed(hmps::Box<double, 3>{-half, half}), hmps::Box<double, 3>{-reach, reach}, spacing);
  FittedBody body(spacing, {bar}, choice, static_cast<int>(std::lround(height / spacing)),
                  hmps::MooneyRivlin<>::from_young_poisson(1e5, 0.3));
  std::vector<Vector> shape;
  for (std::size_t i = 0; i < body.moving(); ++i) {
    const Vector X = at.local(body.reference(i));
    const double angle = 2 * std::numbers::pi * 1e-3 * std::sin(std::numbers::pi * X[0] / length);  // rad/s
    shape.emplace_back(at.direction(angle * Vector(0, -X[2], X[1])));
  }
  return body.frequency(shape, density);
}

}  // namespace
}  // namespace bar_detail

report::Table twisted_bar(bool quick) {
  using namespace bar_detail;
  using report::places;
  report::Table table{.name = "bar", .header = {"layers", "E_hat", "torsion (Hz)", "range", "scatter", "error"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4, 5}) {
    const double l0 = height / layers;
    for (const Choice choice : {Choice::waves, Choice::thin_wall}) {
      std::vector<double> found;
      for (const Placement& at : any_placements(quick ? 1 : 4, l0)) found.push_back(twist(at, l0, choice));
      const Spread torsion = spread(found);
      table.rows.push_back({std::to_string(layers), name(choice), places(torsion.mean, 2),
                            places(torsion.least, 2) + " to " + places(torsion.most, 2),
                            places(100 * torsion.scatter, 1) + " %", percent(torsion.mean / answer - 1)});
      const double error = std::abs(torsion.mean / answer - 1),
                   lattice = on_lattice[static_cast<std::size_t>(layers - 2)];
      const bool is_better = choice != Choice::waves || error < lattice;  // thin_wall_stabiliser is made for walls
      table.check(is_better && torsion.scatter < 0.02,
                  "the bar of " + std::to_string(layers) + " layers errs no less in torsion than on the lattice");
    }
  }
  return table;
}

}  // namespace fitted
