// SPDX-License-Identifier: MIT
// How far a clamped plate of fitted particles bends, whichever way it lies. See --help.
#include <algorithm>
#include <cmath>
#include <hmps/hmps.hpp>
#include <string>
#include <utility>
#include <vector>

#include "report/study.hpp"
#include "report/text.hpp"
#include "scenes/body.hpp"

namespace {

using Vector = hmps::Vector<double, 3>;

constexpr double length = 36e-3, width = 24e-3, thickness = 4.8e-3, held = 6e-3;  // m
constexpr double load = 1962;                                                     // N/m3, across the plate
constexpr double answer = 1.90;                                                   // mm, by finite elements

/// Where a plate lies: turned about y and moved.
struct Placement {
  hmps::Matrix<double, 3> turn;
  Vector moved;

  Placement(double degrees, const Vector& by) : moved(by) {
    const double angle = degrees * std::acos(-1.0) / 180, c = std::cos(angle), s = std::sin(angle);
    turn << c, 0, -s, 0, 1, 0, s, 0, c;
  }
  [[nodiscard]] Vector local(const Vector& x) const { return turn.transpose() * (x - moved); }
  [[nodiscard]] Vector normal() const { return turn.col(2); }
};

/// How the plate is held and stabilised.
enum class Choice {
  waves,      // E_hat = 4/3 mu; the clamped face lies between held and moving particles
  sheet,      // sheet_stabiliser; so does it
  thin_wall,  // thin_wall_stabiliser; it goes through the outermost held particles
};

/// Fits the part of the plate between `from` and `to` (m) along it. The box that is sampled does not move with it.
[[nodiscard]] hmps::FittedParticles<double, 3> fit(const Placement& at, double from, double to, double spacing) {
  const hmps::Box<double, 3> plate{Vector(from, 0, 0), Vector(to, width, thickness)};
  const auto shape = hmps::translated(hmps::rotated(plate, at.turn), at.moved);
  return hmps::fit_particles(shape, hmps::Box<double, 3>{Vector(-0.02, -0.01, -0.02), Vector(0.05, 0.04, 0.05)},
                             spacing);
}

/// The deflection of the tip in mm. A piece beyond the clamped face is fitted by itself, and held.
[[nodiscard]] double tip(const Placement& at, double spacing, Choice choice) {
  const double clamp = choice == Choice::thin_wall ? spacing / 2 : 0;
  auto plate = fit(at, clamp, length, spacing);
  const std::size_t moving = plate.size();
  const auto rest = fit(at, -held, clamp, spacing);
  const auto append = [](auto& to, const auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(plate.positions, rest.positions);
  append(plate.layers, rest.layers);
  append(plate.layer_spacings, rest.layer_spacings);
  const std::vector<Vector>& reference = plate.positions;
  scenes::Body<3> body(spacing, reference);
  const hmps::BondList<double, 3> bonds(body.X(), {.spacing = spacing});
  auto law = hmps::MooneyRivlin<>::from_young(100e3, 1e6);
  const double shear = law.shear_modulus();
  const double bulk = law.bulk_modulus();
  hmps::SheetStabiliser<double> chosen{hmps::shear_wave_modulus(shear), {bulk, 0.0}};
  if (choice == Choice::sheet)
    chosen = hmps::sheet_stabiliser(static_cast<int>(std::lround(thickness / spacing)), bulk, shear);
  const auto wall = hmps::thin_wall_stabiliser(plate.layers, plate.layer_spacings, spacing, bulk, shear);
  law.d1 = (choice == Choice::thin_wall ? wall.bulk : chosen.bulk).law / 2;
  const auto settle = [&](auto internal) {
    const auto force = [&](const auto& xs, const auto& vs, const auto& fs) {
      internal(xs, vs, fs);
      for (std::size_t i = 0; i < fs.size(); ++i)
        for (int c = 0; c < 3; ++c) fs(i, c) -= load * at.normal()[c];
    };
    hmps::relax(
        force, body.x(), body.v(), body.f(), 1000.0,
        {.spacing = spacing, .tolerance = 2e-3, .load = load * length * width * thickness, .moves = [&](std::size_t i) {
           return i < moving;
         }});
  };
  if (choice == Choice::thin_wall)
    settle(hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation<2>(wall.bulk.mean),
                                hmps::artificial([&](const auto& of) { return of(hmps::scalars(wall.moduli)); })));
  else if (chosen.bulk.mean > 0)
    settle(hmps::internal_force(bonds, hmps::elastic(law), hmps::mean_dilatation(chosen.bulk.mean),
                                hmps::artificial(chosen.modulus)));
  else
    settle(hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(chosen.modulus)));
  // The line through the displacements of the last 7 mm, at the end.
  double n = 0, a = 0, aa = 0, w = 0, aw = 0;
  for (std::size_t i = 0; i < moving; ++i) {
    const double along = at.local(reference[i])[0] - length, down = -body.displacement(i).dot(at.normal());
    if (along < -7e-3) continue;
    n += 1, a += along, aa += along * along, w += down, aw += down * along;
  }
  return 1e3 * (w * aa - aw * a) / (n * aa - a * a);
}

[[nodiscard]] const char* name(Choice choice) {
  return choice == Choice::waves ? "4/3 mu" : choice == Choice::sheet ? "sheet_stabiliser" : "thin_wall_stabiliser";
}

/// Adds a row of the table: the plate in `tilts` (degrees), twice each.
void add_row(report::Table& table, double spacing, Choice choice, const std::vector<double>& tilts) {
  using report::places;
  double sum = 0, squares = 0, least = 1e9, most = 0;
  int runs = 0;
  for (const double degrees : tilts)
    for (const Vector& by : {Vector(0.31, 0.17, 0.43), Vector(0.83, 0.59, 0.07)}) {
      const double w = tip(Placement(degrees, by * spacing), spacing, choice);
      sum += w, squares += w * w, ++runs;
      least = std::min(least, w), most = std::max(most, w);
    }
  const double mean = sum / runs, scatter = std::sqrt(std::max(0.0, squares / runs - mean * mean)) / mean;
  const double error = mean / answer - 1;
  table.rows.push_back({places(1e3 * spacing, 1), places(std::round(thickness / spacing), 0), name(choice),
                        places(mean), places(least) + " to " + places(most), places(100 * scatter, 1) + " %",
                        (error < 0 ? "" : "+") + places(100 * error, 1) + " %"});
  table.check(scatter < 0.05, "at " + places(1e3 * spacing, 1) + " mm the tip depends on how the plate lies");
}

}  // namespace

int main(int argc, char** argv) {
  report::Study study("fitted", "How far a clamped plate of fitted particles bends, whichever way it lies",
                      "the coarsest spacing at one tilt, to see that it works");
  std::vector<double> spacings{2.4, 1.8, 1.6, 1.2};
  study.app.add_option("spacings", spacings, "in mm")->capture_default_str();
  return study.run(argc, argv, [&] {
    std::vector<double> tilts{15, 30, 45, 65};
    if (study.quick) spacings = {2.4}, tilts = {30};
    report::Table table{.name = "plate",
                        .header = {"spacing (mm)", "layers", "E_hat", "tip (mm)", "from to", "scatter", "error"}};
    for (const double spacing : spacings)
      for (const Choice choice : {Choice::waves, Choice::sheet, Choice::thin_wall})
        add_row(table, 1e-3 * spacing, choice, tilts);
    study.publish(table);
  });
}
