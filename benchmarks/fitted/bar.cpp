// SPDX-License-Identifier: MIT
// The free bar of benchmarks/verification in bending and torsional vibration, at any orientation.
#include <array>
#include <cmath>
#include <numbers>

#include "fitted/scene.hpp"
#include "report/text.hpp"
#include "scenes/timoshenko.hpp"

namespace fitted {
namespace bar_detail {
namespace {

constexpr double length = 0.5, height = 0.05, density = 1000;      // m, m, kg/m3
constexpr double torsion_answer = 5.697, bending_answer = 1.9869;  // Hz, by finite elements
constexpr std::array on_lattice{0.344, 0.173, 0.087, 0.047};  // errors of docs/measured/verification.md, from 2 layers

/// The first frequencies of the bar in Hz.
struct Frequencies {
  double torsion, bending;
};

[[nodiscard]] Frequencies ring(const Placement& at, double spacing, Choice choice) {
  const Vector half(length / 2, height / 2, height / 2), reach = Vector::Constant(0.32);
  const Piece bar =
      hmps::fit_particles(at.placed(hmps::Box<double, 3>{-half, half}), hmps::Box<double, 3>{-reach, reach}, spacing);
  FittedBody body(spacing, {bar}, choice, static_cast<int>(std::lround(height / spacing)),
                  hmps::MooneyRivlin<>::from_young_poisson(1e5, 0.3));
  std::vector<Vector> twist, bend;  // m/s, such that the ends move by about a thousandth of the height
  for (std::size_t i = 0; i < body.moving(); ++i) {
    const Vector X = at.local(body.reference(i));
    const double s = X[0] / length + 0.5, speed = 2 * std::numbers::pi * 1e-3;
    twist.push_back(at.direction(-speed * std::cos(std::numbers::pi * s) * Vector(0, -X[2], X[1])));
    bend.push_back(
        at.direction({0, 0, speed * height / 2 * scenes::free_mode(scenes::free_root, scenes::free_root * s)}));
  }
  return {body.frequency(twist, density), body.frequency(bend, density)};
}

}  // namespace
}  // namespace bar_detail

report::Table twisted_bar(bool quick) {
  using namespace bar_detail;
  using report::places;
  report::Table table{
      .name = "bar",
      .header = {"layers", "stabiliser", "torsion (Hz)", "range", "scatter", "error", "bending (Hz)", "error"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4, 5}) {
    const double l0 = height / layers;
    for (const Choice choice : {Choice::waves, Choice::thin_wall, Choice::bar}) {
      std::vector<double> twisting, bending;
      for (const Placement& at : any_placements(quick ? 1 : 4, l0)) {
        const Frequencies found = ring(at, l0, choice);
        twisting.push_back(found.torsion);
        bending.push_back(found.bending);
      }
      const Spread torsion = spread(twisting);
      const double bent = spread(bending).mean;
      table.rows.push_back({std::to_string(layers), name(choice), places(torsion.mean, 2),
                            places(torsion.least, 2) + " to " + places(torsion.most, 2),
                            places(100 * torsion.scatter, 1) + " %", percent(torsion.mean / torsion_answer - 1),
                            places(bent, 3), percent(bent / bending_answer - 1)});
      const double error = std::abs(torsion.mean / torsion_answer - 1),
                   lattice = on_lattice[static_cast<std::size_t>(layers - 2)];
      // thin_wall_stabiliser is made for walls; bar_stabiliser halves the error.
      const double most = choice == Choice::thin_wall ? 1 : choice == Choice::bar ? lattice / 2 : lattice;
      table.check(error < most && torsion.scatter < 0.02, "the bar of " + std::to_string(layers) + " layers with " +
                                                              name(choice) + " misses its bound in torsion");
    }
  }
  return table;
}

}  // namespace fitted
