// SPDX-License-Identifier: MIT
// The epiglottis of examples/swallowing alone, held at its root and loaded at its tip. As in clamped.cpp, the clamped
// face passes through the middle of the outermost held particles.
#include <algorithm>
#include <cmath>

#include "fitted/scene.hpp"
#include "scene/anatomy.hpp"

namespace fitted {
namespace leaf_detail {
namespace {

using swallowing::Epiglottis;

// mm. The example holds the part before the clamp.
constexpr double wall = swallowing::wall, clamp = 5, held = 6, loaded = 9;

// By references/bodies.py, in mm. leaf 1 to 6: 0.2618, 0.26212, 0.26444, 0.26456, 0.26484, 0.26482.
constexpr double answer = 0.2648;

/// The spacing (m). For three layers it is that of the example, in which the layers lie closer together than a spacing.
[[nodiscard]] double spacing_of(int layers) { return layers == 3 ? 1.8e-3 : 1e-3 * wall / layers; }

/// The length (mm) of the midline up to the point nearest to `x` (mm) in its plane. The midline is part of a circle.
/// `Epiglottis::arc` is the length along 24 chords, which stays constant at their corners on the outer side.
[[nodiscard]] double arc_of(const Vector& x) {
  const double start = Epiglottis::angle(0),
               radius = Epiglottis::length / (start - Epiglottis::angle(Epiglottis::length));
  const Vector from = x - Epiglottis::midline(0) - radius * Vector(std::sin(start), 0, -std::cos(start));
  return radius * (start - std::atan2(-from[0], from[2]));
}

/// Approximately the signed distance (mm) to the leaf between two lengths along the midline (mm). The shape of the
/// example is not a distance where the width changes, and has no such ends.
[[nodiscard]] double distance(const Vector& x, double from, double to) {
  const double arc = arc_of(x), angle = Epiglottis::angle(arc);
  const Vector off = x - Epiglottis::midline(arc);
  const double behind = off[0] * std::sin(angle) - off[2] * std::cos(angle) - 0.012 * x[1] * x[1];
  const double faces = (std::abs(behind) - wall / 2) / std::hypot(1, 0.024 * x[1]);
  const auto half_width = [&](double at) { return Epiglottis::half_width(std::clamp(at, from, to)); };
  constexpr double change = 1e-3;
  const double slope = (half_width(arc + change) - half_width(arc - change)) / (2 * change);
  const double edges = (std::abs(x[1]) - half_width(arc)) / std::hypot(1, slope);
  return std::max({faces, edges, from - arc, arc - to});
}

/// How far the leaf gives way to a load on its tip, in mm.
[[nodiscard]] double press_tip(const Placement& at, int layers, Choice choice) {
  // The outermost held particles lie half a layer behind the cut.
  const double l0 = spacing_of(layers), face = clamp + wall / layers / 2;
  const auto part = [&](double from, double to) {
    const auto shape = [=](const Vector& x) { return 1e-3 * distance(1e3 * x, from, to); };
    return fit_where_it_lies(at, shape, {Vector(-16e-3, -14e-3, 8e-3), Vector(14e-3, 14e-3, 54e-3)}, l0);
  };
  FittedBody body(l0, {part(face, Epiglottis::length), part(clamp - held, face)}, choice, layers,
                  hmps::MooneyRivlin<>::from_young(100e3, 1e6));
  const double tip = Epiglottis::angle(Epiglottis::length);
  const auto pattern = [&](const Vector& x) -> Vector {
    const double share = std::max(0.0, 1 - (Epiglottis::length - arc_of(1e3 * x)) / loaded);
    return share * Vector(std::sin(tip), 0, -std::cos(tip));
  };
  return body.gives_way(at, {.pattern = pattern, .size = 1000});
}

}  // namespace
}  // namespace leaf_detail

Comparison leaf() {
  using namespace leaf_detail;
  return {.name = "leaf",
          .of = "the leaf",
          .measured = "gives way by (mm)",
          .answer = answer,
          .digits = 4,
          .layers = {2, 3, 4},
          .placements = {6, 4, 3},
          .measure = press_tip,
          .spacing = spacing_of,
          .bound = [](int) { return 0.05; }};
}

}  // namespace fitted
