// SPDX-License-Identifier: MIT
// How far a clamped plate of fitted particles bends, whichever way it lies: prints the table of docs/fitted.md.
// Arguments: spacings in mm.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

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
  std::vector<Vector> x = reference, v(x.size(), Vector::Zero()), f = v;
  const hmps::BondList<double, 3> bonds(hmps::vectors(reference), {.spacing = spacing});
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
        force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), 1000.0,
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
    const double along = at.local(reference[i])[0] - length, down = -(x[i] - reference[i]).dot(at.normal());
    if (along < -7e-3) continue;
    n += 1, a += along, aa += along * along, w += down, aw += down * along;
  }
  return 1e3 * (w * aa - aw * a) / (n * aa - a * a);
}

void row(double spacing, Choice choice) {
  double sum = 0, squares = 0, least = 1e9, most = 0;
  int runs = 0;
  for (const double degrees : {15.0, 30.0, 45.0, 65.0})
    for (const Vector& by : {Vector(0.31, 0.17, 0.43), Vector(0.83, 0.59, 0.07)}) {
      const double w = tip(Placement(degrees, by * spacing), spacing, choice);
      sum += w, squares += w * w, ++runs;
      least = std::min(least, w), most = std::max(most, w);
    }
  const double mean = sum / runs;
  const char* const name = choice == Choice::waves   ? "4/3 mu"
                           : choice == Choice::sheet ? "sheet_stabiliser"
                                                     : "thin_wall_stabiliser";
  std::printf("| %.1f | %.0f | %s | %.3f | %.3f to %.3f | %.1f %% | %+.1f %% |\n", 1e3 * spacing,
              std::round(thickness / spacing), name, mean, least, most,
              100 * std::sqrt(std::max(0.0, squares / runs - mean * mean)) / mean, 100 * (mean / answer - 1));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<double> spacings;
  for (int k = 1; k < argc; ++k) spacings.push_back(std::atof(argv[k]));
  if (spacings.empty()) spacings = {2.4, 1.8, 1.6, 1.2};
  std::puts("| spacing (mm) | layers | E_hat | tip (mm) | from to | scatter | error |\n|---|---|---|---|---|---|---|");
  for (const double spacing : spacings)
    for (const Choice choice : {Choice::waves, Choice::sheet, Choice::thin_wall}) row(1e-3 * spacing, choice);
}
