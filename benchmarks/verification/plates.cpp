// SPDX-License-Identifier: MIT
// Plates in plane strain that are clamped at one end and vibrate, without viscosity.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scenes/timoshenko.hpp"
#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace plates_detail {
namespace {

/// A plate in plane strain, clamped at x = 0.
struct Plate {
  double length, height, young, poisson, density;

  [[nodiscard]] auto law() const { return hmps::SaintVenantKirchhoff<>::from_young_poisson(young, poisson); }
  /// The frequency of its first mode, which is that of a beam with the moduli of plane strain.
  [[nodiscard]] double frequency() const {
    return scenes::timoshenko_frequency({.length = length,
                                         .height = height,
                                         .young = young / (1 - poisson * poisson),
                                         .poisson = poisson / (1 - poisson),
                                         .density = density},
                                        scenes::End::clamped);
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
        if (moves(i))
          shape[i][1] = speed * scenes::clamped_mode(scenes::clamped_root * (body.reference[i][0] / plate.length));
      return shape;
    };
    measured.values.push_back(1 / frequency(body, force, plate.density, moves, start(1e-3)));
    // The large vibration: v_f = 0.05 of the speed of sound sqrt(K / rho).
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
    // Released at rest: the end swings between 0 and its lowest position. The period is measured between passages of
    // the middle.
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

}  // namespace
}  // namespace plates_detail

Problem oscillating_plate() {
  using namespace plates_detail;
  return {.name = "oscillating plate",
          .title = "19. Oscillating plate",
          .text =
              "A plate of 200 x 20 mm in plane strain, E = 2 MPa, nu = 0.3975, rho = 1000 kg/m3, Saint "
              "Venant-Kirchhoff, is clamped at one end and started with the velocities of its first mode. With small "
              "velocities, the period should be that of a Timoshenko beam with the moduli of plane strain "
              "(Euler-Bernoulli: 0.2540 s). With 0.05 of the speed of sound at its end, it is compared with the "
              "values that SPHinXsys stores, a period of 0.2746 s and an amplitude of 0.113 m, which are themselves "
              "results of a particle method.",
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
              "Small vibrations: with E_hat = E the plate is too stiff; with 4/3 mu the remaining error is mostly "
              "that of the clamp, which holds the plate half a spacing too far back. Large vibrations: the published "
              "figures are those of another particle method, whose period lies well above that of beam theory; with "
              "refinement, the runs here move away from it and approach beam theory from both sides."};
}

Problem elastic_flag() {
  return {
      .name = "elastic flag",
      .title = "20. Elastic flag (Turek CSM3)",
      .text =
          "A plate of 350 x 20 mm in plane strain, E = 1.4 MPa, nu = 0.4, rho = 1000 kg/m3, Saint Venant-Kirchhoff, "
          "is clamped at one end and released under g = 2 m/s2. The mean, amplitude and frequency of the vertical "
          "displacement of the middle of its end are compared.",
      .quantities = {{.name = "mean", .unit = "mm", .answer = -63.96, .source = "published", .uncertainty = 0.4},
                     {.name = "amplitude", .unit = "mm", .answer = 65.51, .source = "published", .uncertainty = 0.4},
                     {.name = "frequency", .unit = "Hz", .answer = 1.094, .source = "published", .uncertainty = 0.006}},
      .across = "particles across the height",
      .sizes = {3, 4, 5, 6, 7, 8},
      .methods = clamped_methods,
      .run = plates_detail::wave_flag,
      .parity = true,
      .remark =
          "With 4/3 mu the remaining error is mostly that of the clamp, which adds half a spacing to the length. "
          "With E_hat = E the stiffness of the stabiliser compensates for part of it."};
}

}  // namespace verification
