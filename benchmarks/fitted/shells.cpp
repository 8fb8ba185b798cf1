// SPDX-License-Identifier: MIT
// Curved walls at any orientation: an open half cylinder that is pinched, and half a hollow ball under a radial load.
#include <cmath>
#include <numbers>

#include "fitted/scene.hpp"

namespace fitted {
namespace shells_detail {
namespace {

constexpr double radius = 24e-3, wall = 4.8e-3;  // m, the radius in the middle of the wall
constexpr double length = 36e-3;                 // m, of the half cylinder
constexpr double held = 6e-3;                    // m, how far the ball continues beyond its rim

// By references/bodies.py, in mm; its refinement is the number of quadratic bricks through the wall. half_cylinder 1 to
// 4: 0.19062, 0.19072, 0.19073, 0.19073. half_ball 1 to 5: 0.012611, 0.012721, 0.012738, 0.012745, 0.012749.
constexpr double pinched = 0.1907, blown = 0.01275;

[[nodiscard]] hmps::MooneyRivlin<> material() { return hmps::MooneyRivlin<>::from_young(100e3, 1e6); }
[[nodiscard]] double spacing_of(int layers) { return wall / layers; }

/// How far the load (-x, 0, 0) / R cos^2(pi y / length) pinches the free half cylinder about y, where z > 0, in mm.
[[nodiscard]] double pinch(const Placement& at, int layers, Choice choice) {
  const double l0 = spacing_of(layers), outer = radius + wall / 2;
  const auto tube = [](const Vector& x) { return std::abs(std::hypot(x[0], x[2]) - radius) - wall / 2; };
  const hmps::Box<double, 3> half{Vector(-outer - l0, -length / 2, 0), Vector(outer + l0, length / 2, outer + l0)};
  FittedBody body(l0, {fit_where_it_lies(at, tube, half, l0)}, choice, layers, material());
  const auto pattern = [](const Vector& x) -> Vector {
    return {-x[0] / radius * std::pow(std::cos(std::numbers::pi * x[1] / length), 2), 0, 0};
  };
  return body.gives_way(at, {.pattern = pattern, .size = 1000, .of_free_body = true});
}

/// How far the half ball, z > 0, gives way to a radial load, in mm. It continues beyond the plane of its rim, where its
/// particles are held.
[[nodiscard]] double blow(const Placement& at, int layers, Choice choice) {
  const double l0 = spacing_of(layers), outer = radius + wall / 2 + l0;
  const auto hollow = [](const Vector& x) { return std::abs(x.norm() - radius) - wall / 2; };
  const auto part = [&](double from, double to) {
    return fit_where_it_lies(at, hollow, {Vector(-outer, -outer, from), Vector(outer, outer, to)}, l0);
  };
  FittedBody body(l0, {part(l0 / 2, outer), part(-held, l0 / 2)}, choice, layers, material());
  const double moved =
      body.gives_way(at, {.pattern = [](const Vector& x) { return Vector(x.normalized()); }, .size = 1e4});
  // The mean over the half ball, which includes the half layer of held particles on this side of the rim.
  const double volume = 2 * std::numbers::pi / 3 * (std::pow(radius + wall / 2, 3) - std::pow(radius - wall / 2, 3));
  return moved * static_cast<double>(body.moving()) * std::pow(l0, 3) / volume;
}

}  // namespace
}  // namespace shells_detail

Comparison half_cylinder() {
  using namespace shells_detail;
  return {.name = "half_cylinder",
          .of = "the half cylinder",
          .measured = "gives way by (mm)",
          .answer = pinched,
          .digits = 4,
          .layers = {2, 3, 4},
          .placements = {6, 4, 3},
          .measure = pinch,
          .spacing = spacing_of};
}

Comparison half_ball() {
  using namespace shells_detail;
  return {.name = "half_ball",
          .of = "the half ball",
          .measured = "gives way by (mm)",
          .answer = blown,
          .digits = 5,
          .layers = {2, 3, 4},
          .placements = {6, 4, 3},
          .measure = blow,
          .spacing = spacing_of};
}

}  // namespace fitted
