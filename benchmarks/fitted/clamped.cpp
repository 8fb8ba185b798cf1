// SPDX-License-Identifier: MIT
// Clamped bodies made of plates, at any orientation: a strip whose ends are turned, a wedge, and a plate on a web. As
// in plate.cpp, a clamped face passes through the middle of the outermost held particles.
#include <algorithm>
#include <cmath>

#include "fitted/scene.hpp"

namespace fitted {
namespace clamped_detail {
namespace {

constexpr double wall = 4.8e-3, held = 6e-3;  // m
using Box = hmps::Box<double, 3>;

// By references/bodies.py. strip 1 to 5: 5.9159, 5.7891, 5.7774, 5.7736, 5.7719 uN m. wide_strip 1 to 4: 11.152,
// 11.015, 11.002, 10.998 uN m. wedge 2 to 5: 0.33284, 0.33261, 0.33274, 0.33285 mm. junction 1 to 5: 0.24379, 0.25101,
// 0.25218, 0.25256, 0.25273 mm.
constexpr double torque = 5.771e-6, wide_torque = 10.998e-6;      // N m
constexpr double wedge_answer = 0.3328, junction_answer = 0.253;  // mm

[[nodiscard]] hmps::MooneyRivlin<> material() { return hmps::MooneyRivlin<>::from_young(100e3, 1e6); }
[[nodiscard]] double spacing_of(int layers) { return wall / layers; }

/// The torque in uN m of a strip along x and y, `length` x `width` (m), of which one end is turned about x.
[[nodiscard]] double turned_strip(const Placement& at, int layers, Choice choice, bool own_volumes, double length,
                                  double width) {
  constexpr double angle = 0.02;
  const double l0 = spacing_of(layers), clamp = length / 2 - l0 / 2;
  const auto part = [&](double from, double to) {
    const Box box{Vector(from, -width / 2, -wall / 2), Vector(to, width / 2, wall / 2)};
    return fit_where_it_lies(at, box, box, l0);
  };
  const Piece middle = part(-clamp, clamp), fixed = part(-length / 2 - held, -clamp),
              turned = part(clamp, length / 2 + held);
  FittedBody body(l0, {middle, fixed, turned}, choice, layers, material(), own_volumes);
  const std::size_t first_turned = middle.size() + fixed.size(), all = first_turned + turned.size();
  for (std::size_t i = 0; i < all; ++i) {
    const Vector X = at.local(body.reference(i));
    const double by = angle * std::clamp(X[0] / length + 0.5, 0.0, 1.0);
    if (i < middle.size() || i >= first_turned)
      body.place(i, body.reference(i) + at.direction(by * Vector(0, -X[2], X[1])));
  }
  body.settle([](std::size_t) -> Vector { return Vector::Zero(); }, torque / wall, 1e-3);
  const std::vector<Vector>& forces = body.internal_forces();
  Vector sum = Vector::Zero();
  for (std::size_t i = first_turned; i < all; ++i)
    sum += (own_volumes ? turned.volumes[i - first_turned] : std::pow(l0, 3)) *
           (body.position(i) - at.moved).cross(forces[i]);
  return -1e6 * sum.dot(at.direction(Vector(1, 0, 0)));
}

/// How far a wedge gives way, in mm. Its edge is too thin for particles, so each particle carries the load of its own
/// volume.
[[nodiscard]] double press_wedge(const Placement& at, int layers, Choice choice) {
  constexpr double length = 36e-3, width = 24e-3, thin = 1.2e-3, loaded = 12e-3;
  const double l0 = spacing_of(layers), slope = (wall - thin) / (2 * length);
  const auto tapered = [=](const Vector& x) {
    return std::max(std::abs(x[2]) - wall / 2, (std::abs(x[2]) - wall / 2 + slope * x[0]) / std::hypot(1, slope));
  };
  const auto part = [&](double from, double to) {
    return fit_where_it_lies(at, tapered, {Vector(from, -width / 2, -wall), Vector(to, width / 2, wall)}, l0);
  };
  const Piece moving = part(l0 / 2, length);
  FittedBody body(l0, {moving, part(-held, l0 / 2)}, choice, layers, material());
  const auto pattern = [](const Vector& x) -> Vector { return {0, 0, -std::max(0.0, 1 - (length - x[0]) / loaded)}; };
  return body.gives_way(at, {.pattern = pattern, .size = 1000}, moving.volumes);
}

/// How far a plate on a web gives way to a load on one of its arms, in mm.
[[nodiscard]] double press_arm(const Placement& at, int layers, Choice choice) {
  constexpr double arm = 21.6e-3, height = 24e-3, width = 24e-3;
  const double l0 = spacing_of(layers);
  const auto united = hmps::unite(Box{Vector(-arm, -width / 2, -wall / 2), Vector(arm, width / 2, wall / 2)},
                                  Box{Vector(-wall / 2, -width / 2, -2 * height), Vector(wall / 2, width / 2, 0)});
  const auto part = [&](double from, double to) {
    return fit_where_it_lies(at, united, {Vector(-arm - l0, -width / 2, from), Vector(arm + l0, width / 2, to)}, l0);
  };
  const double clamp = l0 / 2 - height;
  FittedBody body(l0, {part(clamp, wall / 2 + l0), part(-height - held, clamp)}, choice, layers, material());
  const auto pattern = [](const Vector& x) -> Vector { return {0, 0, -std::max(0.0, x[0]) / arm}; };
  return body.gives_way(at, {.pattern = pattern, .size = 600});
}

}  // namespace
}  // namespace clamped_detail

Comparison strip(bool own_volumes) {
  using namespace clamped_detail;
  return {.name = own_volumes ? "strip_volumes" : "strip",
          .of = own_volumes ? "the strip with own volumes" : "the strip",
          .measured = "torque (uN m)",
          .answer = 1e6 * torque,
          .digits = 3,
          .layers = {2, 3, 4},
          .placements = {6, 4, 3},
          .measure = [=](const Placement& at, int layers,
                         Choice choice) { return turned_strip(at, layers, choice, own_volumes, 72e-3, 18e-3); },
          .spacing = spacing_of};
}

Comparison wide_strip() {
  using namespace clamped_detail;
  return {.name = "wide_strip",
          .of = "the wide strip",
          .measured = "torque (uN m)",
          .answer = 1e6 * wide_torque,
          .digits = 3,
          .layers = {2, 3},
          .placements = {2, 2},
          .measure = [](const Placement& at, int layers,
                        Choice choice) { return turned_strip(at, layers, choice, false, 144e-3, 54e-3); },
          .spacing = spacing_of};
}

Comparison wedge() {
  using namespace clamped_detail;
  return {.name = "wedge",
          .of = "the wedge",
          .measured = "gives way by (mm)",
          .answer = wedge_answer,
          .digits = 3,
          .layers = {4},
          .placements = {4},
          .measure = press_wedge,
          .spacing = spacing_of,
          .bound = [](int) { return 0.06; }};
}

Comparison junction() {
  using namespace clamped_detail;
  return {.name = "junction",
          .of = "the junction",
          .measured = "gives way by (mm)",
          .answer = junction_answer,
          .digits = 4,
          .layers = {2, 3, 4},
          .placements = {6, 4, 3},
          .measure = press_arm,
          .spacing = spacing_of};
}

}  // namespace fitted
