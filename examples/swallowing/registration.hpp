// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "regions.hpp"

/// Where the lattice puts the organs, as against where they are drawn.
///
/// A wall across a lattice has its surface up to half a spacing from where it was drawn: 1.2 mm at the coarsest
/// spacing, as much as decides whether the tip of the epiglottis passes the posterior wall. In the first half second,
/// in which the body conforms to the shape that the swallow starts from, the control regions beside such surfaces move
/// by what is missing. It is measured on the lattice, so that there is nothing to choose.
namespace swallowing {

struct Registration {
  Point vertebrae = Point::Zero();    ///< mm, brings the posterior wall of the pharynx to its place
  Point tongue_base = Point::Zero();  ///< mm, likewise the back of the tongue
  Point epiglottis = Point::Zero();   ///< mm, likewise the leaf, across its midline and at its tip
  double wall = 0;                    ///< mm, thickness of the pharyngeal wall at its sides
};

namespace detail {

/// Mean distance (mm) along x from the lattice's surface to that of `shape`. The lattice's surface lies half a spacing
/// before the first particle of each row along x that looks to `side`, 1 or -1. `points` are in mm.
template <class Shape>
[[nodiscard]] double missing(const std::vector<Point>& points, double l0, int side, const Shape& shape) {
  std::map<std::pair<long, long>, Point> first;
  for (const Point& x : points) {
    const std::pair row(std::lround(2 * x[1] / l0), std::lround(2 * x[2] / l0));
    const auto [found, fresh] = first.try_emplace(row, x);
    if (!fresh && side * x[0] > side * found->second[0]) found->second = x;
  }
  double sum = 0;
  for (const auto& [row, x] : first) {
    double inside = 0, outside = 2 * l0;
    while (outside - inside > 1e-3) {
      const double middle = (inside + outside) / 2;
      (shape(Point(x + side * middle * Point::UnitX())) < 0 ? inside : outside) = middle;
    }
    sum += inside - l0 / 2;
  }
  return first.empty() ? 0 : side * sum / static_cast<double>(first.size());
}

/// Measures the particles `points` (m) of the organs.
[[nodiscard]] inline Registration registration(const Anatomy& anatomy, const std::vector<Point>& points,
                                               const std::vector<Organ>& organ, double spacing) {
  const double l0 = 1e3 * spacing;
  std::vector<Point> posterior, tongue;
  double across = 0, reach = -2 * l0, side = 0;
  std::size_t leaf = 0;
  std::map<std::pair<long, long>, int> sides;
  const double angle = Epiglottis::angle(0.8 * Epiglottis::length);
  const Point along(std::cos(angle), 0, std::sin(angle)), behind(std::sin(angle), 0, -std::cos(angle));
  const Point tip = Epiglottis::midline(Epiglottis::length);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point x = 1e3 * points[i];
    const double y = std::abs(x[1]);
    switch (organ[i]) {
      case Organ::pharynx:
        if (x[2] < 40 || x[2] > 70) break;
        if (y < Anatomy::strip_width && x[0] > 0) posterior.push_back(x);
        if (x[0] < anatomy.pharynx.profile(x[2])[1] && x[0] > -12)
          ++sides[{std::lround(2 * x[0] / l0), std::lround(2 * x[2] / l0)}], ++side;
        break;
      case Organ::tongue:
        if (y < 6 && std::abs(anatomy.tongue.polar(x).angle - tongue_regions[1].angle) < tongue_regions[1].half)
          tongue.push_back(x);
        break;
      case Organ::epiglottis: {
        if (y > 4) break;
        reach = std::max(reach, along.dot(x - tip) + l0 / 2);
        const double arc = anatomy.epiglottis.arc(x);
        if (arc > 0.2 * Epiglottis::length && arc < 0.9 * Epiglottis::length)
          across += anatomy.epiglottis.normal(x), ++leaf;
        break;
      }
      default:
        break;
    }
  }
  Registration r;
  r.vertebrae[0] = missing(posterior, l0, -1, [&](const Point& x) { return anatomy.pharynx(x); });
  r.tongue_base[0] = missing(tongue, l0, 1, [&](const Point& x) { return anatomy.tongue(x); });
  r.epiglottis = -reach * along;
  if (leaf > 0) r.epiglottis -= across / static_cast<double>(leaf) * behind;
  r.wall = sides.empty() ? wall : l0 * side / (2.0 * static_cast<double>(sides.size()));
  return r;
}

}  // namespace detail
}  // namespace swallowing
