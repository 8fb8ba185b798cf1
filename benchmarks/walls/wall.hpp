// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <hmps/hmps.hpp>
#include <numbers>
#include <vector>

#include "scenes/fitted_body.hpp"

namespace walls {

using Point = hmps::Vector<double, 3>;

/// The sites of a lattice that is turned by `angle` (rad) about y against the plane z = 0, over a rectangle of that
/// plane and up to `depth` spacings above and below it; `phase` (in spacings) shifts the lattice against the plane.
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

/// How a body is filled with particles, and at which positions contact evaluates its surface particles.
enum class Made {
  cut,     ///< cut out of a turned lattice
  raised,  ///< the same; in contact its surface particles are raised to the surface
  fitted   ///< fitted to its surface
};

/// Particles fitted to a box, which is turned by `angle` (rad) about y against the grid with which `fit_particles`
/// samples it. Lengths in m.
[[nodiscard]] inline std::vector<Point> fitted(double angle, const hmps::Box<double, 3>& box, double spacing) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()).toRotationMatrix();
  return scenes::fit_turned(box, turn, spacing).positions;
}

/// A rigid wall below z = 0, four layers deep, that is cut out of a lattice or fitted. `degrees` is the angle about y
/// between its surface and the lattice or the grid of samples.
struct Wall {
  double degrees = 0;
  Made made = Made::cut;
  double spacing = 1;        ///< m
  int layers = 4;            ///< of a fitted one
  double layer_spacing = 1;  ///< of a fitted one, in spacings

  std::vector<Point> places = {};      ///< positions of the particles in contact, m
  std::vector<hmps::Index> skin = {};  ///< numbered from 0

  /// Mean length in m of a step of the staircase along x. The steps have two lengths, whose sequence is not periodic.
  [[nodiscard]] double step() const {
    return degrees > 0 && made != Made::fitted ? spacing / std::sin(angle()) : spacing;
  }
  /// Total length in m of as many whole steps as make up 15 spacings or more.
  [[nodiscard]] double stretch() const { return step() * std::ceil(15 * spacing / step() - 1e-9); }
  [[nodiscard]] double angle() const { return degrees * std::numbers::pi / 180; }

  /// Fills lower[0] <= x <= upper[0], and likewise in y.
  void fill(const hmps::Vector<double, 2>& lower, const hmps::Vector<double, 2>& upper) {
    if (made == Made::fitted)
      fit(lower, upper);
    else
      cut(lower, upper);
    if (made == Made::raised) raise();
  }

  /// Moves the surface particles, as contact sees them, to half a spacing below the surface.
  void raise() {
    const hmps::HalfSpace<double, 3> inside{Point::Zero(), Point::UnitZ()};
    const hmps::SurfaceCorrection<double, 3> raise(hmps::vectors(places), skin, inside, spacing);
    for (std::size_t n = 0; n < skin.size(); ++n) places[skin[n]] += raise.offsets()[n];
  }

 private:
  void add(const Point& place, bool is_skin) {
    if (is_skin) skin.push_back(static_cast<hmps::Index>(places.size()));
    places.push_back(place);
  }
  void cut(const hmps::Vector<double, 2>& lower, const hmps::Vector<double, 2>& upper) {
    // The outermost particles of a wall along its lattice lie half a spacing below its surface; those of other walls do
    // so on average. A particle belongs to the surface particles if the next lattice site above it is outside.
    for (const Point& place : lattice(angle(), degrees > 0 ? 0.13 : 0.5, lower, upper, spacing))
      if (place[2] <= 0) add(place, -place[2] < spacing * std::cos(angle()));
  }
  void fit(const hmps::Vector<double, 2>& lower, const hmps::Vector<double, 2>& upper) {
    const double rim = 3 * spacing, layer = layer_spacing * spacing;  // at the rim the layers run around it
    const Point low(lower[0] - rim, lower[1] - rim, -layers * layer), high(upper[0] + rim, upper[1] + rim, 0);
    for (const Point& place : fitted(angle(), {low, high}, spacing)) {
      const hmps::Vector<double, 2> at = place.head<2>();
      if ((at.array() >= lower.array()).all() && (at.array() <= upper.array()).all()) add(place, -place[2] < layer);
    }
  }
};

/// The shape of a wall as a slave feels it at one height of contact.
struct Relief {
  double offset = 0;        ///< mean height of the surface above the drawn surface, in spacings
  double bumps = 0;         ///< of the surface, from the lowest to the highest, in spacings
  double tilt = 0;          ///< tangent of the angle between normal and surface normal, root mean square
  double largest_tilt = 0;  ///< the largest such tangent
};

/// Moves a slave over the stretch of a filled wall with unit spacing, at a penetration of a twentieth of a spacing.
template <class Ball>
[[nodiscard]] Relief relief(const Wall& wall) {
  constexpr double reach = Ball::radius, penetration = 0.05;
  const hmps::NormalDensity<double, 3, Ball> Z(1.0);
  const hmps::Matrix<double, 3> undeformed = hmps::Matrix<double, 3>::Identity();
  Relief result;
  double lowest = 1e9, highest = -1e9, squares = 0;
  constexpr int along = 240, across = 5, count = along * across;
  for (int a = 0; a < along; ++a)
    for (int b = 0; b < across; ++b) {
      Point slave(wall.stretch() * a / along, 0.5 * b / (across - 1), 0), normal = Point::Zero();
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
        (distance(middle) < 1 - penetration ? low : high) = middle;
      }
      (void)distance(low);
      const double tilt = normal.head<2>().norm() / normal[2];
      lowest = std::min(lowest, low);
      highest = std::max(highest, low);
      result.offset += (low - (0.5 - penetration)) / count;
      squares += tilt * tilt / count;
      result.largest_tilt = std::max(result.largest_tilt, tilt);
    }
  result.bumps = highest - lowest;
  result.tilt = std::sqrt(squares);
  return result;
}
/// The same for a wall that is not filled yet.
template <class Ball>
[[nodiscard]] Relief relief_of(Wall wall, bool raised = false) {
  constexpr double beyond = Ball::radius + 1;
  wall.fill({-beyond, -beyond}, {wall.stretch() + beyond, beyond});
  if (raised) wall.raise();
  return relief<Ball>(wall);
}

}  // namespace walls
