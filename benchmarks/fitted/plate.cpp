// SPDX-License-Identifier: MIT
// A clamped plate at any orientation: how far it bends, and how fast it vibrates.
#include <cmath>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {
namespace plate_detail {
namespace {

constexpr double length = 36e-3, width = 24e-3, thickness = 4.8e-3, held = 6e-3;  // m
constexpr double load = 1962, density = 1000;                                     // N/m3 across the plate, kg/m3
// By finite elements (C3D20R of CalculiX): mm, and Hz; for the frequency, 2, 4 and 6 elements through the thickness
// give 6.572, 6.398 and 6.366, and the fit of order two 6.34.
constexpr double answer = 1.90, first_frequency = 6.34;

[[nodiscard]] hmps::MooneyRivlin<> material() { return hmps::MooneyRivlin<>::from_young(100e3, 1e6); }

/// Fits the part of the plate between `from` and `to` (m) along it. The box that is sampled does not move with it.
[[nodiscard]] Piece fit(const Placement& at, double from, double to, double spacing) {
  const Vector centre((length - held) / 2, width / 2, thickness / 2);
  const hmps::Box<double, 3> part{Vector(from, 0, 0) - centre, Vector(to, width, thickness) - centre};
  const Vector reach = Vector::Constant(0.03);  // beyond the corners at any orientation of the plate
  return hmps::fit_particles(at.placed(part), hmps::Box<double, 3>{-reach, reach}, spacing);
}

/// The plate with a piece beyond the clamped face that is fitted separately and held. The face passes through the
/// middle of the outermost held particles (thin_wall, edges) or half a spacing in front of them.
[[nodiscard]] FittedBody plate(const Placement& at, double spacing, Choice choice) {
  const double clamp = choice == Choice::thin_wall || choice == Choice::edges ? spacing / 2 : 0;
  return {spacing,
          {fit(at, clamp, length, spacing), fit(at, -held, clamp, spacing)},
          choice,
          static_cast<int>(std::lround(thickness / spacing)),
          material()};
}

/// Lets the plate sink. Returns the deflection of the tip in mm, from the line through the displacements of the last 7
/// mm.
[[nodiscard]] double sink(FittedBody& body, const Placement& at) {
  const Vector down = at.direction(Vector(0, 0, -1));
  body.settle([&](std::size_t) -> Vector { return load * down; }, load* length* width* thickness);
  double n = 0, a = 0, aa = 0, w = 0, aw = 0;
  for (std::size_t i = 0; i < body.moving(); ++i) {
    const double along = at.local(body.reference(i))[0] - (length + held) / 2, sunk = body.displacement(i).dot(down);
    if (along < -7e-3) continue;
    n += 1, a += along, aa += along * along, w += sunk, aw += sunk * along;
  }
  return 1e3 * (w * aa - aw * a) / (n * aa - a * a);
}

/// The lowest frequency in Hz of a plate that has sunk. It is started without load, with velocities in the shape of the
/// sag.
[[nodiscard]] double vibrate(FittedBody& body) {
  std::vector<Vector> shape(body.moving());
  for (std::size_t i = 0; i < body.moving(); ++i) shape[i] = 0.5 * body.displacement(i);  // the tip moves by 25 um
  return body.frequency(shape, density);
}

[[nodiscard]] report::Cells cells_of(const Spread& found, double right, int digits) {
  using report::places;
  return {places(found.mean, digits), places(found.least, digits) + " to " + places(found.most, digits),
          places(100 * found.scatter, 1) + " %", percent(found.mean / right - 1)};
}

[[nodiscard]] double layers_of(double spacing) { return std::round(thickness / spacing); }

}  // namespace
}  // namespace plate_detail

report::Table plate_about_one_axis(const std::vector<double>& spacings, bool quick) {
  using namespace plate_detail;
  using report::places;
  report::Table table{.name = "plate",
                      .header = {"spacing (mm)", "layers", "E_hat", "tip (mm)", "range", "scatter", "error"}};
  const std::vector<double> tilts = quick ? std::vector<double>{30} : std::vector<double>{15, 30, 45, 65};
  for (const double l0 : spacings)
    for (const Choice choice : {Choice::waves, Choice::sheet, Choice::thin_wall}) {
      std::vector<double> tips;
      for (const double degrees : tilts)
        for (const Vector& by : {Vector(0.31, 0.17, 0.43), Vector(0.83, 0.59, 0.07)}) {
          const Placement at = tilted(degrees, l0 * by);
          FittedBody body = plate(at, l0, choice);
          tips.push_back(sink(body, at));
        }
      const Spread tip = spread(tips);
      report::Cells row{places(1e3 * l0, 1), places(layers_of(l0), 0), name(choice)};
      for (const std::string& cell : cells_of(tip, answer, 3)) row.push_back(cell);
      table.rows.push_back(row);
      table.check(tip.scatter < 0.05, "at " + places(1e3 * l0, 1) + " mm the tip depends on how the plate lies");
    }
  return table;
}

report::Table plate_about_any_axis(const std::vector<double>& spacings, bool quick) {
  using namespace plate_detail;
  using report::places;
  report::Table table{.name = "any_axis",
                      .header = {"spacing (mm)", "layers", "stabiliser", "placements", "tip (mm)", "range", "scatter",
                                 "error", "frequency (Hz)", "range", "scatter", "error"}};
  const auto measure = [&](double l0, Choice choice) {
    const auto placements = any_placements(quick ? 2 : l0 < 1.5e-3 ? 6 : 12, l0);
    std::vector<double> tips, frequencies;
    for (const Placement& at : placements) {
      FittedBody body = plate(at, l0, choice);
      tips.push_back(sink(body, at));
      frequencies.push_back(vibrate(body));
    }
    const Spread tip = spread(tips), frequency = spread(frequencies);
    report::Cells row{places(1e3 * l0, 1), places(layers_of(l0), 0), name(choice), std::to_string(placements.size())};
    for (const auto& cells : {cells_of(tip, answer, 3), cells_of(frequency, first_frequency, 3)})
      row.insert(row.end(), cells.begin(), cells.end());
    table.rows.push_back(row);
    const std::string where = "at " + places(1e3 * l0, 1) + " mm with " + name(choice) + " ";
    const double bound = layers_of(l0) < 3 ? 0.06 : 0.03;
    table.check(std::abs(tip.mean / answer - 1) < bound, where + "the tip misses its bound");
    table.check(std::abs(frequency.mean / first_frequency - 1) < bound, where + "the frequency misses its bound");
    table.check(tip.scatter < 0.02 && frequency.scatter < 0.02, where + "the plate depends on how it lies");
  };
  for (const double l0 : spacings)
    for (const Choice choice : {Choice::thin_wall, Choice::edges}) measure(l0, choice);
  return table;
}

}  // namespace fitted
