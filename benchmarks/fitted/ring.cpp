// SPDX-License-Identifier: MIT
// A free ring that is squeezed across, at any orientation.
#include <cmath>
#include <numbers>

#include "fitted/scene.hpp"

namespace fitted {
namespace ring_detail {
namespace {

constexpr double radius = 24e-3, wall = 4.8e-3, width = 14.4e-3;  // m, the radius in the middle of the wall
constexpr double load = 1000;                                     // N/m3 in the middle of the wall
constexpr double answer = 0.2151;                                 // mm, by finite elements (C3D20R of CalculiX)

[[nodiscard]] double spacing_of(int layers) { return wall / layers; }

/// How far the ring is squeezed, in mm: A of the displacement A (x, 0, -z) / R, by least squares.
[[nodiscard]] double squeeze(const Placement& at, int layers, Choice choice) {
  const double spacing = spacing_of(layers);
  const auto tube = [](const Vector& x) {
    const double across = std::abs(std::hypot(x[0], x[2]) - radius) - wall / 2, along = std::abs(x[1]) - width / 2;
    return std::hypot(std::max(across, 0.0), std::max(along, 0.0)) + std::min(std::max(across, along), 0.0);
  };
  const Vector reach = Vector::Constant(0.032);
  const Piece ring = hmps::fit_particles(at.placed(tube), hmps::Box<double, 3>{-reach, reach}, spacing);
  FittedBody body(spacing, {ring}, choice, 0, hmps::MooneyRivlin<>::from_young(100e3, 1e6));
  const auto pattern = [](const Vector& x) -> Vector { return {x[0] / radius, 0, -x[2] / radius}; };
  return body.gives_way(at, {.pattern = pattern, .size = load, .of_free_body = true});
}

}  // namespace
}  // namespace ring_detail

Comparison ring() {
  using namespace ring_detail;
  return {.name = "ring",
          .of = "the ring",
          .measured = "squeezed by (mm)",
          .answer = answer,
          .digits = 3,
          .layers = {2, 3, 4},
          .placements = {6, 6, 6},
          .measure = squeeze,
          .spacing = spacing_of};
}

}  // namespace fitted
