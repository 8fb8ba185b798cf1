// SPDX-License-Identifier: MIT
// Vibrations without viscosity: a free bar, plates that are clamped at one end, a column that is thrown sideways.
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "../tradeoff/timoshenko.hpp"
#include "parts.hpp"
#include "support.hpp"

namespace verification {
namespace {

constexpr double pi = std::numbers::pi;

/// The mode of a free beam whose wave number times its length is `root`, at the share `s` of it.
double free_mode(double root, double s) {
  const double ratio = (std::cosh(root) - std::cos(root)) / (std::sinh(root) - std::sin(root));
  return (std::cosh(root * s) + std::cos(root * s) - ratio * (std::sinh(root * s) + std::sin(root * s))) / 2;
}
/// The first mode of a beam that is clamped at s = 0.
double clamped_mode(double s) {
  const double root = 1.8751040687119611, ratio = 0.7340955137589128;
  return (std::cosh(root * s) - std::cos(root * s) - ratio * (std::sinh(root * s) - std::sin(root * s))) / 2;
}

Measured ring(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  constexpr double length = 0.5, height = 0.05, density = 1000;
  const double l0 = height / n;
  Body<3> body(l0, cells<3>(l0, {10 * n, n, n}));
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  const auto law = hmps::SaintVenantKirchhoff<>::from_young(1e5, 0.3);
  Measured measured{l0, body.size(), {}};
  with_force(method, body.F(), bonds, law, [&](auto& force) {
    for (const double root : {4.730040744862704, 7.853204624095838, 0.0}) {
      std::vector<Vector> shape(body.size());
      for (std::size_t i = 0; i < body.size(); ++i) {
        const Vector X = body.reference[i] - Vector(0, height / 2, height / 2);
        const double s = X[0] / length;
        // Speeds such that the ends move by about a thousandth of the height; 0 stands for torsion.
        shape[i] = 2 * pi * 5e-5 *
                   (root > 0 ? Vector(0, 0, free_mode(root, s)) : Vector(0, -X[2], X[1]) * (std::cos(pi * s) / height));
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
/// Of the first bending mode of a free bar, in Hz.
double beam_frequency(const hmps::MooneyRivlin<>& law) {
  const double bulk = law.bulk_modulus(), shear = law.shear_modulus();
  return tradeoff::timoshenko_frequency({.length = rubber_length,
                                         .height = rubber_height,
                                         .young = 9 * bulk * shear / (3 * bulk + shear),
                                         .poisson = (3 * bulk - 2 * shear) / (6 * bulk + 2 * shear),
                                         .density = rubber_density},
                                        tradeoff::End::free);
}

Measured ring_rubber(int n, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = rubber_height / n;
  Body<3> body(l0, cells<3>(l0, {10 * n, n, n}));
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  std::vector<Vector> shape;
  for (const Vector& X : body.reference)
    shape.emplace_back(0, 0, 1e-4 * free_mode(4.730040744862704, X[0] / rubber_length));
  Measured measured{l0, body.size(), {}};
  for (const double ratio : bulk_over_shear)
    with_force(method, body.F(), bonds, rubber(ratio), [&](auto& force) {
      measured.values.push_back(frequency(body, force, rubber_density, all_move, shape));
    });
  return measured;
}

/// A plate in plane strain, clamped at x = 0, or what moves it.
struct Plate {
  double length, height, young, poisson, density;

  [[nodiscard]] auto law() const { return hmps::SaintVenantKirchhoff<>::from_young(young, poisson); }
  /// Of its first mode: that of a beam with the moduli of plane strain.
  [[nodiscard]] double frequency() const {
    return tradeoff::timoshenko_frequency({.length = length,
                                           .height = height,
                                           .young = young / (1 - poisson * poisson),
                                           .poisson = poisson / (1 - poisson),
                                           .density = density},
                                          tradeoff::End::clamped);
  }
};
constexpr Plate plate{.length = 0.2, .height = 0.02, .young = 2e6, .poisson = 0.3975, .density = 1000};
constexpr Plate flag{.length = 0.35, .height = 0.02, .young = 1.4e6, .poisson = 0.4, .density = 1000};

std::array<int, 2> cells_of(const Plate& p, int n) {
  return {static_cast<int>(std::lround(p.length / p.height * n)), n};
}

Measured swing(int n, const Method& method) {
  using Vector = hmps::Vector<double, 2>;
  const double l0 = plate.height / n;
  Body<2> body(l0, cells<2>(l0, cells_of(plate, n), method.held));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0; };
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0});
  Measured measured{l0, body.size(), {}};
  with_force(method, body.F(), bonds, plate.law(), [&](auto& force) {
    const auto start = [&](double speed) {
      std::vector<Vector> shape(body.size(), Vector::Zero());
      for (std::size_t i = 0; i < body.size(); ++i)
        if (moves(i)) shape[i][1] = speed * clamped_mode(body.reference[i][0] / plate.length);
      return shape;
    };
    measured.values.push_back(1 / frequency(body, force, plate.density, moves, start(1e-3)));
    // The large one: v_f = 0.05 of the speed of sound sqrt(K / rho).
    body.position = body.reference;
    body.velocity = start(0.05 * std::sqrt(plate.law().bulk_modulus() / plate.density));
    Crossings crossings;
    double most = 0, least = 0;
    march(body, force, plate.density, moves, [&](double time) {
      const double end = displacement_at<2>(body, cells_of(plate, n), Vector(plate.length, plate.height / 2))[1];
      most = std::max(most, end);
      least = std::min(least, end);
      return crossings.add(time, end, 3);
    });
    measured.values.push_back(crossings.span());
    measured.values.push_back((most - least) / 2);
  });
  return measured;
}

Measured wave_flag(int n, const Method& method) {
  using Vector = hmps::Vector<double, 2>;
  const double l0 = flag.height / n, gravity = 2;
  Body<2> body(l0, cells<2>(l0, cells_of(flag, n), method.held));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0; };
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0});
  return with_force(method, body.F(), bonds, flag.law(), [&](auto& internal) {
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x, v, f);
      for (std::size_t i = 0; i < f.size(); ++i) f(i, 1) -= flag.density * gravity;
    };
    // Released at rest: the end swings between 0 and its lowest place. The period is that of passing the middle.
    const double middle = -0.06396;
    double most = -1, least = 0;
    Crossings crossings;
    march(body, force, flag.density, moves, [&](double time) {
      const double end = displacement_at<2>(body, cells_of(flag, n), Vector(flag.length, flag.height / 2))[1];
      if (time > 0.3) most = std::max(most, end);
      least = std::min(least, end);
      return crossings.add(time, end - middle, 3);
    });
    return Measured{l0, body.size(), {1e3 * (most + least) / 2, 1e3 * (most - least) / 2, 1 / crossings.span()}};
  });
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
  const auto law = hmps::NeoHookean<>::from_young(17e6, 0.45);
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

Problem free_bar() {
  return {
      .name = "free bar",
      .title = "6. Vibrating bar",
      .text =
          "A free bar of 500 x 50 x 50 mm, E = 0.1 MPa, nu = 0.3, rho = 1000, is started in the shape of its first "
          "two bending modes (Euler and Bernoulli) and of its first mode of torsion, by small speeds. The "
          "frequencies of finite elements that it is compared with are those of a free bar; a clamped one has "
          "0.32 Hz.",
      .quantities =
          {{.name = "first bending", .unit = "Hz", .answer = 1.9869, .source = "finite elements", .uncertainty = 5e-4},
           {.name = "second bending", .unit = "Hz", .answer = 5.176, .source = "finite elements", .uncertainty = 0.002},
           {.name = "torsion", .unit = "Hz", .answer = 5.697, .source = "finite elements", .uncertainty = 0.002}},
      .across = "particles across the height",
      .sizes = {2, 3, 4, 5, 6, 8, 10},
      .methods = methods,
      .run = ring,
      .remark =
          "With E_hat = E the bar is too stiff, and the error falls with the second order. With 4/3 mu the bending "
          "frequencies are near from three particles on and pass the answer, so that no order can be given; torsion, "
          "which moves the edges most, comes down from above with both."};
}

Problem rubber_bar() {
  // Beam theory of the bar of problem 6, for which there is an answer of finite elements.
  const double theory = tradeoff::timoshenko_frequency(
      {.length = 0.5, .height = 0.05, .young = 1e5, .poisson = 0.3, .density = 1000}, tradeoff::End::free);
  Problem problem{
      .name = "rubber bar",
      .title = "6 b. Thin bar of stiff volume",
      .text = hmps::message(
          "A free bar of 48 x 4.8 x 4.8 mm, mu = 7 kPa, Mooney-Rivlin, rho = 1000, is started in the shape of its "
          "first bending mode, for three ratios of bulk and shear modulus. The answer is the frequency of a "
          "Timoshenko beam, which for the bar of problem 6 is ",
          std::round(1e4 * theory) / 1e4, " Hz where finite elements give 1.9869 Hz."),
      .quantities = {},
      .across = "particles across the height",
      .sizes = {2, 3, 4, 5, 6, 8},
      .methods = {paper, shear_wave, mean_dilatation, soft},
      .run = ring_rubber,
      .remark =
          "From three particles on mean dilatation with 4/3 mu is right whatever the ratio, and so is 4/3 mu alone in "
          "a "
          "bar as narrow as high; in wide sheets it is not, where their number of layers is even (see "
          "[theory.md](theory.md)). A bar of two particles is too stiff with both, and right with mean dilatation and "
          "E_hat = mu."};
  for (const double ratio : bulk_over_shear)
    problem.quantities.push_back({.name = hmps::message("K/mu = ", ratio),
                                  .unit = "Hz",
                                  .answer = beam_frequency(rubber(ratio)),
                                  .source = "beam theory",
                                  .uncertainty = 1e-3 * beam_frequency(rubber(ratio))});
  return problem;
}

Problem oscillating_plate() {
  return {.name = "oscillating plate",
          .title = "19. Oscillating plate",
          .text =
              "A plate of 200 x 20 mm in plane strain, E = 2 MPa, nu = 0.3975, rho = 1000, Saint Venant-Kirchhoff, "
              "clamped at one end, is started with the velocities of its first mode: small ones, for which the "
              "period should be that of a Timoshenko beam with the moduli of plane strain (Euler and Bernoulli: "
              "0.2540 s), and 0.05 of the speed of sound at its end, for which SPHinXsys stores a period of 0.2746 s "
              "and an amplitude of 0.113 m, themselves particle results.",
          .quantities =
              {{.name = "period, small",
                .unit = "s",
                .answer = 1 / plate.frequency(),
                .source = "beam theory",
                .uncertainty = 3e-4},
               {.name = "period, large", .unit = "s", .answer = 0.2746, .source = "published", .uncertainty = 0.003},
               {.name = "amplitude, large", .unit = "m", .answer = 0.113, .source = "published", .uncertainty = 0.001}},
          .across = "particles across the height",
          .sizes = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
          .methods = clamped_methods,
          .run = swing,
          .parity = true,
          .remark =
              "Small swings: with E_hat = E the plate is too stiff, with 4/3 mu what is left is mostly the clamp, "
              "which holds it half a spacing too far back. Large swings: the published figures are those of another "
              "particle method, whose period lies well above that of beam theory; the runs here leave it and approach "
              "beam theory from both sides."};
}

Problem elastic_flag() {
  return {
      .name = "elastic flag",
      .title = "20. Elastic flag (Turek CSM3)",
      .text =
          "A plate of 350 x 20 mm in plane strain, E = 1.4 MPa, nu = 0.4, rho = 1000, Saint Venant-Kirchhoff, "
          "clamped at one end, is released under g = 2. The middle of its end is compared: mean, amplitude and "
          "frequency of its fall.",
      .quantities = {{.name = "mean", .unit = "mm", .answer = -63.96, .source = "published", .uncertainty = 0.4},
                     {.name = "amplitude", .unit = "mm", .answer = 65.51, .source = "published", .uncertainty = 0.4},
                     {.name = "frequency", .unit = "Hz", .answer = 1.094, .source = "published", .uncertainty = 0.006}},
      .across = "particles across the height",
      .sizes = {3, 4, 5, 6, 7, 8},
      .methods = clamped_methods,
      .run = wave_flag,
      .parity = true,
      .remark =
          "With 4/3 mu what is left is mostly the clamp: half a spacing more of length. With E_hat = E the stiffness "
          "of the stabiliser makes up for part of it."};
}

Problem bending_column() {
  return {.name = "bending column",
          .title = "17. Bending column",
          .text =
              "A column of 1 x 1 x 6 m, neo-Hookean with E = 17 MPa and nu = 0.45, rho = 1100, its base fixed, starts "
              "with velocities across that grow to 10 m/s at its top. The displacement of a corner of the top at "
              "0.5 s, and the largest deviation from seven values between 0.2 and 0.9 s.",
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
          .run = throw_column,
          .parity = true,
          .remark =
              "With E_hat = E the column is far too stiff. With 4/3 mu the clamp is what is left, about as large as "
              "the answer's own error."};
}

}  // namespace verification
