// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <hmps/shapes/combine.hpp>
#include <hmps/shapes/implicit.hpp>
#include <hmps/shapes/sweep.hpp>
#include <numbers>
#include <vector>

#include "scene/organs.hpp"
#include "scene/rows.hpp"

/// The organs of the swallow as implicit shapes.
///
/// Millimetres and degrees; x points to the back, z to the head, y = 0 is the midsagittal plane. The CT surfaces of the
/// paper are not public: dimensions come from the literature where docs/swallowing says so; the rest was drawn. Soft
/// sheets are 4.8 mm thick (the pharyngeal wall measures 4.8 mm at its sides and 3.8 mm behind; an epiglottis with its
/// mucosa 4.7 to 6.8 mm), which is two particles at the coarsest spacing of 2.4 mm. The thickness is fixed in
/// millimetres, so that refining the lattice does not change the body.
namespace swallowing {

using Point = hmps::Vector<double, 3>;

inline constexpr double wall = 4.8;  ///< mm, thickness of the soft sheets

/// The epiglottis: a leaf that stands on the inner front of the larynx and leans back, its edges set
/// back, 36 mm along its midline (literature: arc 37, chord 35).
struct Epiglottis {
  static constexpr double length = 36;
  hmps::Plate<double> leaf{rows(), Point::UnitY(), 2.0};

  /// Angle (rad) of the tangent above the horizontal at `arc` mm from the base: it turns from 76 to 62 degrees.
  [[nodiscard]] static double angle(double arc) { return (76 - 14 * arc / length) * std::numbers::pi / 180; }
  /// Point of the midline at `arc` mm from the base.
  [[nodiscard]] static Point midline(double arc) {
    Point p(-10.3, 0, 12.6);
    constexpr int steps = 72;
    for (int k = 0; k < steps; ++k) {
      const double at = angle((k + 0.5) / steps * arc);
      p += arc / steps * Point(std::cos(at), 0, std::sin(at));
    }
    return p;
  }
  [[nodiscard]] static double half_width(double arc) {
    const double s = std::clamp(arc / (0.6 * length), 0.0, 1.0);
    if (s < 1) return 6 + 6 * s * s * (3 - 2 * s);
    // Blunt: the reach of the leaf's corners must not depend on where a coarse lattice cuts a pointed end.
    return 12 * std::sqrt(1 - std::pow((arc / length - 0.6) / 0.42, 6));
  }
  [[nodiscard]] static std::vector<hmps::PlateRow<double>> rows() {
    std::vector<hmps::PlateRow<double>> rows;
    for (int k = 0; k <= 24; ++k) {
      const double arc = length * k / 24;
      rows.push_back({midline(arc), half_width(arc), wall / 2, 0});
    }
    return rows;
  }
  [[nodiscard]] double arc(const Point& x) const { return leaf.arc(x); }
  /// The approximate distance (mm) to the faces and the edges, negative inside; the leaf continues beyond its ends.
  [[nodiscard]] double surface(const Point& x) const {
    return std::max(std::abs(normal(x)) - wall / 2, std::abs(x[1]) - half_width(leaf.arc(x)));
  }
  /// Flat faces and square edges: a superelliptic section would thin the edges to one particle.
  [[nodiscard]] double operator()(const Point& x) const {
    if (std::abs(x[1]) > 13 || x[0] < -16 || x[0] > 12 || x[2] < 10 || x[2] > 54) return 10;
    return std::max(surface(x), std::abs(ahead(x)) - 0.3);
  }
  /// Distance (mm) above the tip, negative below the base, zero between them.
  [[nodiscard]] double ahead(const Point& x) const {
    const double s = leaf.arc(x);
    const Point off = x - midline(s);
    return off[0] * std::cos(angle(s)) + off[2] * std::sin(angle(s));
  }
  /// Distance (mm) behind the middle surface, whose edges are set back.
  [[nodiscard]] double normal(const Point& x) const {
    const double s = leaf.arc(x);
    const Point off = x - midline(s);
    return off[0] * std::sin(angle(s)) - off[2] * std::cos(angle(s)) - 0.012 * x[1] * x[1];
  }
};

/// The tongue: a shell without its inside, as in the paper. In the midsagittal plane it is a polar curve about
/// `centre`, with the angle 0 at the back and 90 at the top.
struct Tongue {
  Point centre{-36, 0, 55};
  /// Angle, radius of the surface, half width, thickness of the shell.
  Rows<4> profile{{{-66, 31.5, 18, 8.6},
                   {-60, 31.4, 19, 8.6},
                   {-44, 31, 21, 8.6},
                   {-25, 30.4, 22.5, 8.6},
                   {0, 30.7, 23.5, 8.6},
                   {10, 31.2, 23.5, 8.6},
                   {20, 32.4, 23.5, 8.6},
                   {33.5, 34.6, 23.5, 8.6},
                   {47, 36.5, 23, 8},
                   {62, 37.4, 22.5, 6.6},
                   {90, 36.8, 22, 5.8},
                   {118, 38, 20.5, 5.8},
                   {137, 40.7, 18, 5.8},
                   {150.6, 42.8, 14, 5.8},
                   {158, 43, 11, 5.8}}};
  struct Polar {
    double angle, radius;
    std::array<double, 4> row;
  };
  [[nodiscard]] Polar polar(const Point& x) const {
    const double angle = std::atan2(x[2] - centre[2], x[0] - centre[0]) * 180 / std::numbers::pi;
    return {angle, std::hypot(x[0] - centre[0], x[2] - centre[2]), profile(angle)};
  }
  [[nodiscard]] double operator()(const Point& x) const {
    const auto [angle, radius, row] = polar(x);
    if (angle < -64 || angle > 152) return 1;
    const auto [_, R, W, t] = row;
    const double outer = hmps::superellipse(radius, x[1], R, W, exponent);
    const double inner = hmps::superellipse(radius, x[1], R - t, W - t, exponent);
    return std::max({outer, -inner, lower_edge(row) - radius});
  }
  /// Half width (mm) of the shell at its lower edge, where it is widest: y of the tongue's rim.
  [[nodiscard]] static double rim(const std::array<double, 4>& row) {
    return row[2] * std::pow(1 - std::pow(lower_edge(row) / row[1], exponent), 1 / exponent);
  }

 private:
  static constexpr double exponent = 2.6;
  /// Radius (mm) at which the sides of the shell end.
  [[nodiscard]] static double lower_edge(const std::array<double, 4>& row) { return row[1] - row[3] - 4.5; }
};

/// The soft palate with the uvula: from the hard palate backwards and down.
struct SoftPalate {
  hmps::Plate<double> velum{{{Point(-29, 0, 97.2), 18, 2.6, 0},
                             {Point(-21, 0, 95.8), 17.5, 3.2, 0},
                             {Point(-14, 0, 93.4), 17, 3.9, 0},
                             {Point(-8, 0, 89.6), 16.5, 4.1, 0},
                             {Point(-3.4, 0, 84.4), 13.5, 3.8, 0},
                             {Point(-1, 0, 79), 8, 3.4, 0},
                             {Point(0.4, 0, 74.6), 5.2, 3.2, 0},
                             {Point(1, 0, 71), 4.6, 2.8, 0}},
                            Point::UnitY(),
                            3.0};
  [[nodiscard]] double arc(const Point& x) const { return velum.arc(x); }
  [[nodiscard]] double operator()(const Point& x) const { return velum(x); }
};

/// The hard palate: a vault with the alveolar ridge in front.
struct HardPalate {
  /// x, height of the middle surface in the midline, half width, depth of the vault.
  Rows<4> profile{{{-78, 78.3, 7, 1.5},
                   {-72, 85.3, 10, 5},
                   {-67, 89.3, 13, 9},
                   {-60, 93.5, 16.5, 12},
                   {-54, 96.4, 18.5, 13},
                   {-46, 97.8, 19.5, 13.5},
                   {-36, 98.4, 20, 13.5},
                   {-25, 98.2, 20, 13.5}}};
  [[nodiscard]] double operator()(const Point& x) const {
    const auto height = [this](double u, double v) {
      const auto [_, z, w, drop] = profile(u);
      return z - drop * std::pow(std::min(1.25, std::abs(v) / w), 3);
    };
    constexpr double e = 0.1;
    const double du = (height(x[0] + e, x[1]) - height(x[0] - e, x[1])) / (2 * e);
    const double dv = (height(x[0], x[1] + e) - height(x[0], x[1] - e)) / (2 * e);
    const double distance = (x[2] - height(x[0], x[1])) / std::sqrt(1 + du * du + dv * dv);
    return std::max({std::abs(distance) - wall / 2, std::abs(x[1]) - 1.1 * profile(x[0])[2], -76 - x[0], x[0] + 25});
  }
};

/// Larynx and upper trachea: a tube with the glottis, cut by the oblique rim of the inlet, and the
/// arytenoids on its back.
struct Larynx {
  static constexpr double bottom = -30;
  hmps::Stack<double> airway{{{-50, {-1.3, 0}, {7.2, 7.2}},
                              {-14, {-1.3, 0}, {7.1, 7.1}},
                              {-8, {-1.3, 0}, {7.0, 6.6}},
                              {-3, {-1.3, 0}, {6.8, 4.2}},
                              {2, {-1.3, 0}, {6.8, 4.4}},
                              {7, {-1.3, 0}, {7.1, 6.6}},
                              {40, {-1.3, 0}, {7.1, 7.1}}}};
  hmps::Stack<double> outside{{{-50, {-1.3, 0}, {12.0, 12.0}}, {40, {-1.3, 0}, {11.9, 11.9}}}};
  hmps::Ellipsoid<double, 3> arytenoid{{6.6, 6, 7}, {4.2, 4, 5.5}};

  [[nodiscard]] double inside_airway(const Point& x) const { return airway(x); }
  [[nodiscard]] double operator()(const Point& x) const {
    // The rim falls from 16.6 in front to 7.6 behind.
    const double rim = (x[2] - (16.6 - 9.0 * (x[0] + 13.2) / 23.8)) / std::hypot(1.0, 9.0 / 23.8);
    const double tube = std::max({outside(x), rim, bottom - x[2]});
    const double tips = arytenoid(Point(x[0], std::abs(x[1]), x[2]));
    return std::min(std::max(tube, -airway(x)), tips);
  }
};

/// The pharyngeal wall and the upper esophagus: a sheet around a channel. Above the vallecula it is
/// open to the front; below, its front wall is the floor of the vallecula and of the pyriform
/// sinuses, and further down the back of the cricoid.
struct Pharynx {
  static constexpr double bottom = -30;
  static constexpr double top = 96;
  static constexpr double posterior_wall = 10.8;  ///< mm, x of its surface beside the tip of the epiglottis
  static constexpr double closed_below = 31;      ///< mm, upper edge of the front wall
  static constexpr double esophagus_below = -9;
  /// z; x where the channel is widest; x of the posterior wall's surface; half width; x of the front wall's surface.
  Rows<5> profile{{{-40, 12.2, 13.4, 7, 11},
                   {-22, 12.2, 13.4, 7.5, 11},
                   {-16, 12.2, 13.6, 8.5, 10.8},
                   {-10, 10.5, 13.9, 10.5, 8},
                   {-5, 8, 13.9, 12.5, 1.5},
                   {0, 3, 13.8, 14.5, -4.5},
                   {5, -1, 13.7, 15.4, -8.8},
                   {10, -3, 13.4, 15.8, -10.2},
                   {20, -4.3, 12.2, 16, -11.3},
                   {31, -4.3, 11.2, 16.1, -12.5},
                   {40, -4.3, 10.8, 16.1, -12.5},
                   {70, -4.3, 10.8, 16.1, -12.5},
                   {78, -3.8, 10.2, 15.2, -12.5},
                   {87, -3.2, 9, 13.8, -12.5},
                   {98, -2.6, 8.5, 12.8, -12.5}}};

  /// Less than one inside the channel, homogeneous of degree one about its axis.
  [[nodiscard]] double level(const Point& x) const {
    const auto [_, widest, back, half_width, front] = profile(x[2]);
    const double side = x[1] / half_width;
    if (x[0] >= widest) return std::hypot((x[0] - widest) / (back - widest), side);
    if (x[2] > closed_below) return std::abs(side);
    const double ahead = (widest - x[0]) / (widest - front);
    const double a = std::abs(side);
    return std::pow(std::pow(ahead, 4) + std::pow(a, 4), 0.25);
  }
  /// The approximate distance to the surface of the channel, negative inside.
  [[nodiscard]] double channel(const Point& x) const {
    constexpr double e = 0.05;
    Point slope;
    for (int c = 0; c < 3; ++c) {
      Point shift = Point::Zero();
      shift[c] = e;
      slope[c] = (level(x + shift) - level(x - shift)) / (2 * e);
    }
    const double above = level(x) - 1;
    // Far outside, where the channel narrows quickly, the slope along z would make every distance too short.
    const double across = above / std::max(slope.head<2>().norm(), 1e-3);
    return across > 2 * wall ? across : above / std::max(slope.norm(), 1e-3);
  }
  [[nodiscard]] double ends(const Point& x) const {
    const double front = x[2] > closed_below ? (x[2] < 76 ? -16.0 : -14.0) - x[0] : -1.0;
    return std::max({front, bottom - x[2], x[2] - top});
  }
  [[nodiscard]] double operator()(const Point& x) const { return layer(x, 0, wall); }
  /// Negative between two distances (mm) from the channel.
  [[nodiscard]] double layer(const Point& x, double from, double to) const {
    const double d = channel(x);
    return std::max({from - d, d - to, ends(x)});
  }
};

/// All organs together.
struct Anatomy {
  Epiglottis epiglottis;
  Tongue tongue;
  SoftPalate soft_palate;
  HardPalate hard_palate;
  Larynx larynx;
  Pharynx pharynx;

  static constexpr double strip = 4.8;      ///< mm, thickness of region G
  static constexpr double strip_width = 5;  ///< mm, its half width
  static constexpr double plate = 3.6;      ///< mm, least thickness of the plates H
  static constexpr double plate_gap = 0.8;  ///< mm between the wall and the plates H
  static constexpr double plate_from = 25;  ///< degrees from the posterior axis, where the plates begin

  /// The organ of the deforming body at `x` (mm), `none` in the air and outside. Where shapes overlap they are one
  /// body, and the first in the order of the tests names the particle.
  [[nodiscard]] Organ organ_at(const Point& x) const {
    if (hard_palate(x) < 0) return Organ::hard_palate;
    if (soft_palate(x) < 0) return Organ::soft_palate;
    if (epiglottis(x) < 0) return Organ::epiglottis;
    const bool airway = x[2] < 30 && larynx.inside_airway(x) < 0;
    if (larynx(x) < 0) return Organ::larynx;
    if (airway) return Organ::none;
    const double channel = pharynx.channel(x);
    const double ends = pharynx.ends(x);
    if (ends < 0 && channel >= 0) {
      if (channel < wall) {
        const auto row = pharynx.profile(x[2]);
        if (x[2] < Pharynx::esophagus_below) return x[0] < row[4] ? Organ::larynx : Organ::esophagus;
        if (x[2] < Pharynx::closed_below && x[0] < row[4] + 1) return Organ::vallecula;
        return Organ::pharynx;
      }
      if (channel < wall + strip && std::abs(x[1]) < strip_width && x[0] > row_widest(x[2]) && x[2] > -12)
        return Organ::vertebrae;
    }
    // The tongue's lower surface ends where the channel begins.
    if (tongue(x) < 0 && (x[2] > Pharynx::closed_below || channel > 0)) return Organ::tongue;
    return Organ::none;
  }
  /// The approximate distance (mm) to the drawn surface of the organs between which the epiglottis folds, negative
  /// inside.
  [[nodiscard]] double surface(const Point& x) const {
    // Otherwise the leaf's faces would continue through the posterior wall.
    const double leaf = std::max(epiglottis.surface(x), std::abs(epiglottis.ahead(x)) - 3);
    return std::min({leaf, pharynx(x), tongue(x)});
  }

 private:
  [[nodiscard]] double row_widest(double z) const { return pharynx.profile(z)[1]; }
};

}  // namespace swallowing
