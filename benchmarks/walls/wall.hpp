// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <hmps/hmps.hpp>
#include <numbers>
#include <vector>

namespace walls {

using Point = hmps::Vector<double, 3>;

/// The places of a lattice that is turned by `angle` (rad) about y against z = 0, over a rectangle of that plane and
/// `depth` spacings above and below it; `phase` (in spacings) shifts it against the plane.
[[nodiscard]] inline std::vector<Point> lattice(double angle, double phase, const hmps::Vector<double, 2>& lower,
                                                const hmps::Vector<double, 2>& upper, double spacing,
                                                double depth = 4) {
  const double c = std::cos(angle), s = std::sin(angle);
  const Point along(c, 0, s), up(-s, 0, c);
  std::vector<Point> places;
  const int reach = static_cast<int>(std::ceil((upper - lower).norm() / spacing)) + 8;
  for (int j = static_cast<int>(lower[1] / spacing) - 1; j <= upper[1] / spacing + 1; ++j)
    for (int i = -reach; i <= reach; ++i)
      for (int k = -reach; k <= reach; ++k) {
        const Point place =
            spacing * (i * along + (j + 0.2) * Point::UnitY() + (k - phase) * up) + Point(lower[0], 0, 0);
        if (place[0] >= lower[0] && place[0] <= upper[0] && place[1] >= lower[1] && place[1] <= upper[1] &&
            std::abs(place[2]) <= depth * spacing)
          places.push_back(place);
      }
  return places;
}

/// A rigid wall below z = 0 that is cut out of a lattice: `degrees` between its surface and the lattice, about y.
struct Wall {
  double degrees = 0;
  bool raised = false;  ///< contact sees its skin raised to the surface
  double spacing = 1;   ///< m

  std::vector<Point> places = {};      ///< where contact sees the particles, m
  std::vector<hmps::Index> skin = {};  ///< numbered from 0

  /// Mean length of a step of the stairs along x, in m. They come in two lengths, that do not repeat.
  [[nodiscard]] double step() const { return degrees > 0 ? spacing / std::sin(angle()) : spacing; }
  /// Whole steps of 15 spacings or more in all, in m.
  [[nodiscard]] double stretch() const { return step() * std::ceil(15 * spacing / step() - 1e-9); }
  [[nodiscard]] double angle() const { return degrees * std::numbers::pi / 180; }

  /// Fills lower[0] <= x <= upper[0] and the same in y, four layers deep.
  void fill(const hmps::Vector<double, 2>& lower, const hmps::Vector<double, 2>& upper) {
    // A wall along its lattice has its outermost particles half a spacing below its surface; so have the others on
    // the average.
    for (const Point& place : lattice(angle(), degrees > 0 ? 0.13 : 0.5, lower, upper, spacing)) {
      if (place[2] > 0) continue;
      // The next place of the lattice upwards is outside.
      if (-place[2] < spacing * std::cos(angle())) skin.push_back(static_cast<hmps::Index>(places.size()));
      places.push_back(place);
    }
    if (!raised) return;
    const hmps::HalfSpace<double, 3> inside{Point::Zero(), Point::UnitZ()};
    const hmps::SurfaceCorrection<double, 3> raise(hmps::vectors(places), skin, inside, spacing);
    for (std::size_t n = 0; n < skin.size(); ++n) places[skin[n]] += raise.offsets()[n];
  }
};

/// What a slave feels of a wall at one height of contact.
struct Relief {
  double bumps = 0;         ///< of the surface, from the lowest to the highest, in spacings
  double tilt = 0;          ///< tangent of the angle between normal and surface normal, root mean square
  double largest_tilt = 0;  ///< the same, the largest
};

/// Moves a slave over the stretch of a wall with unit spacing, at a penetration of a twentieth of a spacing.
template <class Ball>
[[nodiscard]] Relief relief(double degrees, bool raised) {
  Wall wall{.degrees = degrees, .raised = raised};
  const double reach = Ball::radius, stretch = wall.stretch();
  wall.fill({-reach - 1, -reach - 1}, {stretch + reach + 1, reach + 1});
  const hmps::NormalDensity<double, 3, Ball> Z(1.0);
  const hmps::Matrix<double, 3> undeformed = hmps::Matrix<double, 3>::Identity();
  Relief result;
  double lowest = 1e9, highest = -1e9, squares = 0;
  constexpr int along = 240, across = 5;
  for (int a = 0; a < along; ++a)
    for (int b = 0; b < across; ++b) {
      Point slave(stretch * a / along, 0.5 * b / (across - 1), 0), normal = Point::Zero();
      const auto distance = [&](double height) {
        slave[2] = height;
        hmps::MasterSurface<double, 3, Ball> surface;
        for (const Point& master : wall.places) (void)surface.reach(undeformed, master - slave, 1 / (reach * reach));
        (void)surface.normal(reach, normal);
        return Z.inverse(surface.density()).value;
      };
      double low = -0.5, high = reach;
      while (high - low > 1e-6) {
        const double middle = (low + high) / 2;
        (distance(middle) < 0.95 ? low : high) = middle;
      }
      (void)distance(low);
      const double tilt = normal.head<2>().norm() / normal[2];
      lowest = std::min(lowest, low);
      highest = std::max(highest, low);
      squares += tilt * tilt / (along * across);
      result.largest_tilt = std::max(result.largest_tilt, tilt);
    }
  result.bumps = highest - lowest;
  result.tilt = std::sqrt(squares);
  return result;
}

}  // namespace walls
