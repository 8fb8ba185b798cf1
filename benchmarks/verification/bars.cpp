// SPDX-License-Identifier: MIT
// Bars in three dimensions without viscosity: free bars that vibrate, and a column that is thrown sideways.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "common/error.hpp"
#include "scenes/timoshenko.hpp"
#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace bars_detail {
namespace {

constexpr double pi = std::numbers::pi;

Measured ring(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  constexpr double length = 0.5, height = 0.05, density = 1000;
  const double l0 = height / n;
  Body<3> body(l0, cells<3>(l0, {10 * n, n, n}));
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  const auto law = hmps::SaintVenantKirchhoff<>::from_young_poisson(1e5, 0.3);
  Measured measured{l0, body.size(), {}};
  with_force(method, body.F(), bonds, law, [&](auto& force) {
    for (const double root : {scenes::free_root, 7.853204624095838, 0.0}) {
      std::vector<Vector> shape(body.size());
      for (std::size_t i = 0; i < body.size(); ++i) {
        const Vector X = body.reference[i] - Vector(0, height / 2, height / 2);
        const double s = X[0] / length;
        // Speeds such that the ends move by about a thousandth of the height; 0 stands for torsion.
        shape[i] = 2 * pi * 5e-5 *
                   (root > 0 ? Vector(0, 0, scenes::free_mode(root, root * s))
                             : Vector(0, -X[2], X[1]) * (std::cos(pi * s) / height));
      }
      measured.values.push_back(frequency(body, force, density, all_move, shape));
    }
  });
  return measured;
}

constexpr std::array<double, 3> bulk_over_shear{3, 30, 300};
constexpr double rubber_length = 0.048, rubber_height = 0.0048, rubber_density = 1000;  // m, m, kg/m3

hmps::MooneyRivlin<> rubber(double ratio) {
  const double shear = 7e3;
  return {shear / 4, shear / 4, ratio * shear / 2};
}
/// The frequency of the first bending mode of a free bar, in Hz.
double beam_frequency(const hmps::MooneyRivlin<>& law) {
  const double bulk = law.bulk_modulus(), shear = law.shear_modulus();
  return scenes::timoshenko_frequency({.length = rubber_length,
                                       .height = rubber_height,
                                       .young = young_of(law),
                                       .poisson = (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear),
                                       .density = rubber_density},
                                      scenes::End::free);
}

Measured ring_rubber(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = rubber_height / n;
  Body<3> body(l0, cells<3>(l0, {10 * n, n, n}));
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  std::vector<Vector> shape, twist;
  for (const Vector& X : body.reference) {
    const double s = X[0] / rubber_length;
    shape.emplace_back(0, 0, 1e-4 * scenes::free_mode(scenes::free_root, scenes::free_root * s));
    const double y = X[1] - rubber_height / 2, z = X[2] - rubber_height / 2;
    twist.emplace_back(Vector(0, -z, y) * (1e-4 / rubber_height * std::cos(pi * s)));
  }
  Measured measured{l0, body.size(), {}};
  for (const double ratio : bulk_over_shear)
    with_force(method, body.F(), bonds, rubber(ratio), [&](auto& force) {
      measured.values.push_back(frequency(body, force, rubber_density, all_move, shape));
    });
  with_force(method, body.F(), bonds, rubber(bulk_over_shear.back()),
             [&](auto& force) { measured.values.push_back(frequency(body, force, rubber_density, all_move, twist)); });
  return measured;
}

constexpr std::array<double, 7> column_times{0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.9};
constexpr std::array<double, 7> column_places{2.107, 2.802, 3.043, 3.077, 2.791, 2.005, 0.058};

Measured throw_column(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  constexpr double density = 1100;
  const double l0 = 1.0 / n;
  // The axis of the column is the first one here.
  Body<3> body(l0, cells<3>(l0, {6 * n, n, n}, method.held));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0; };
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  const auto law = hmps::NeoHookean<>::from_young_poisson(17e6, 0.45);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (moves(i)) body.velocity[i] = Vector(0, 10 * body.reference[i][0] / 6, 0);
  return with_force(method, body.F(), bonds, law, [&](auto& force) {
    std::vector<double> places;
    double before = 0, last = 0;
    march(body, force, density, moves, [&](double time) {
      const double corner = displacement_at<3>(body, {6 * n, n, n}, Vector(6, 0, 0))[1];
      const double wanted = column_times[places.size()];
      if (time >= wanted) places.push_back(before + (corner - before) * (wanted - last) / (time - last));
      before = corner;
      last = time;
      return places.size() < column_times.size();
    });
    double worst = 0;
    for (std::size_t k = 0; k < places.size(); ++k) worst = std::max(worst, std::abs(places[k] - column_places[k]));
    return Measured{l0, body.size(), {places[3], worst}};
  });
}

}  // namespace
}  // namespace bars_detail

Problem free_bar() {
  return {
      .name = "free bar",
      .title = "6. Vibrating bar",
      .text =
          "A free bar of 500 x 50 x 50 mm, E = 0.1 MPa, nu = 0.3, rho = 1000 kg/m3, is started with small velocities "
          "in the shape of its first two bending modes (Euler-Bernoulli) and of its first torsional mode. The "
          "frequencies are compared with those of finite elements for a free bar; a clamped bar would vibrate at "
          "0.32 Hz.",
      .quantities =
          {{.name = "first bending", .unit = "Hz", .answer = 1.9869, .source = "finite elements", .uncertainty = 5e-4},
           {.name = "second bending", .unit = "Hz", .answer = 5.176, .source = "finite elements", .uncertainty = 0.002},
           {.name = "torsion", .unit = "Hz", .answer = 5.697, .source = "finite elements", .uncertainty = 0.002}},
      .across = "particles across the height",
      .sizes = {2, 3, 4, 5, 6, 8, 10},
      .methods = {paper, shear_wave, bar},
      .run = bars_detail::ring,
      .remark =
          "With E_hat = E the bar is too stiff, and the error decreases with second order. With 4/3 mu the bending "
          "frequencies are close to the answer from three particles on and pass it, so no order can be given. The "
          "frequency of torsion, which moves the edges most, approaches the answer from above with both. "
          "`bar_stabiliser` reduces its error to less than a third with three to six particles, approaches the answer "
          "from below, and bends a little too easily. A section of two or three particles across cannot warp; without "
          "warping the bar would be 8.9 % off."};
}

Problem rubber_bar() {
  using namespace bars_detail;
  // Beam theory for the bar of problem 6, for which there is also an answer by finite elements.
  const double theory = scenes::timoshenko_frequency(
      {.length = 0.5, .height = 0.05, .young = 1e5, .poisson = 0.3, .density = 1000}, scenes::End::free);
  Problem problem{
      .name = "rubber bar",
      .title = "6 b. Thin bar of stiff volume",
      .text = examples::message(
          "A free bar of 48 x 4.8 x 4.8 mm, mu = 7 kPa, Mooney-Rivlin, rho = 1000 kg/m3, is started in the shape of "
          "its first bending mode, for three ratios of the bulk modulus to the shear modulus, and in that of its first "
          "torsional mode. The answer for bending is the "
          "frequency of a Timoshenko beam; for the bar of problem 6 this theory gives ",
          std::round(1e4 * theory) / 1e4, " Hz, and finite elements give 1.9869 Hz."),
      .quantities = {},
      .across = "particles across the height",
      .sizes = {2, 3, 4, 5, 6, 8},
      .methods = {paper, shear_wave, mean_dilatation, soft, bar_mean_dilatation},
      .run = ring_rubber,
      .remark =
          "From three particles on, mean dilatation with 4/3 mu is right at any ratio. So is 4/3 mu alone in a bar "
          "as narrow as it is high, but not in wide sheets with an even number of layers (see "
          "[theory.md](../theory.md)). A bar of two particles is too stiff with both, and right with mean dilatation "
          "and E_hat = mu. The torsional frequency is that of problem 6 for this shear modulus, density and length: it "
          "does not depend on the bulk modulus."};
  for (const double ratio : bulk_over_shear)
    problem.quantities.push_back({.name = examples::message("K/mu = ", ratio),
                                  .unit = "Hz",
                                  .answer = beam_frequency(rubber(ratio)),
                                  .source = "beam theory",
                                  .uncertainty = 1e-3 * beam_frequency(rubber(ratio))});
  const double torsion = 5.697 * std::sqrt(rubber(300).shear_modulus() / (1e5 / 2.6)) * 0.5 / rubber_length;
  problem.quantities.push_back({.name = "torsion, K/mu = 300",
                                .unit = "Hz",
                                .answer = torsion,
                                .source = "finite elements",
                                .uncertainty = 4e-4 * torsion});
  return problem;
}

Problem bending_column() {
  return {.name = "bending column",
          .title = "17. Bending column",
          .text =
              "A column of 1 x 1 x 6 m, neo-Hookean with E = 17 MPa and nu = 0.45, rho = 1100 kg/m3, has a fixed "
              "base and starts with transverse velocities that increase to 10 m/s at its top. The results are the "
              "displacement of a corner of the top at 0.5 s, and the largest deviation from the answer at seven "
              "times between 0.2 and 0.9 s.",
          .quantities = {{.name = "displacement at 0.5 s",
                          .unit = "m",
                          .answer = 3.077,
                          .source = "finite elements",
                          .uncertainty = 0.05},
                         {.name = "largest deviation",
                          .unit = "m",
                          .answer = 0,
                          .source = "finite elements",
                          .uncertainty = 0.05,
                          .scale = 3.077}},
          .across = "particles across",
          .sizes = {3, 4, 5, 6, 7, 8, 9, 10},
          .methods = all_methods,
          .run = bars_detail::throw_column,
          .parity = true,
          .remark =
              "With E_hat = E the column is far too stiff. With 4/3 mu the remaining error is that of the clamp, and "
              "about as large as the answer's own error."};
}

}  // namespace verification
