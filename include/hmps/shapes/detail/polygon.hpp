// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"

/// How the polygons of surface files become triangles.
namespace hmps::inline HMPS_ABI::detail {

/// Why a polygon is not the border of a surface.
enum class PolygonFault { none, no_area, crosses_itself };

/// The part of a polygon's extent below which its shape does not count: files commonly have six digits, and `weld`
/// merges vertices that are as close.
inline constexpr double polygon_tolerance = 1e-6;

/// Splits one polygon into triangles, corners numbered from 0: into the fan of its corner 0 if that represents it (it
/// does for every convex polygon), else by clipping ears in the plane of its Newell normal. Warped polygons for which
/// that fails, and those whose corners lie on a line, also become the fan. Lengths are in units of the
/// largest distance from corner 0. Corners may coincide, and edges that are traversed in both directions may lead to
/// holes. There are always two triangles fewer than corners; some have no area where corners lie on a line.
template <class R>
class BasicPolygonSplit {
 public:
  using Triangle = std::array<std::size_t, 3>;

  /// `resolution`: by how much rounding may have moved the corners, in their unit.
  BasicPolygonSplit(std::vector<Vector<R, 3>> corners, double resolution) : points_(std::move(corners)) {
    make_fan();
    if (triangles_.size() < 2) return;
    const Vector<R, 3> origin = points_[0];
    double reach = 0;
    for (auto& point : points_) reach = std::max(reach, (point -= origin).stableNorm());
    if (!(reach > 0) || !std::isfinite(reach)) return;  // checked with all vertices of the surface
    for (auto& point : points_) point /= reach;
    Vector<R, 3> normal = Vector<R, 3>::Zero();
    for (const auto& [a, b, c] : triangles_) normal += points_[b].cross(points_[c]);
    if (!(normal.norm() > resolution / reach)) {
      fault_ = is_on_a_line() ? PolygonFault::none : PolygonFault::no_area;
      return;
    }
    normal.normalize();
    if (!is_fan(normal)) clip(normal);
  }

  [[nodiscard]] PolygonFault fault() const { return fault_; }
  /// The triangles, if there is no fault.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }

 private:
  using Point = Vector<R, 2>;

  void make_fan() {
    triangles_.clear();
    for (std::size_t k = 2; k < points_.size(); ++k) triangles_.push_back({0, k - 1, k});
  }

  /// Whether all corners lie on a line, as those of a face that closes the gap where edges of unlike division meet.
  [[nodiscard]] bool is_on_a_line() const {
    const Vector<R, 3> farthest = *std::max_element(
        points_.begin(), points_.end(), [](const auto& p, const auto& q) { return p.squaredNorm() < q.squaredNorm(); });
    return std::all_of(points_.begin(), points_.end(),
                       [&](const auto& p) { return p.cross(farthest).norm() <= polygon_tolerance; });
  }
  /// Whether the corners lie in a plane, to within a twentieth of the extent.
  [[nodiscard]] bool is_flat(const Vector<R, 3>& normal) const {
    double low = 0, high = 0;
    for (const auto& p : points_) {
      low = std::min(low, p.dot(normal));
      high = std::max(high, p.dot(normal));
    }
    return high - low <= 0.05;
  }

  /// Whether the fan covers nothing twice and nothing outside, except for slivers: seen against the normal, no triangle
  /// is turned over, and together they go around corner 0 at most once.
  [[nodiscard]] bool is_fan(const Vector<R, 3>& normal) const {
    double angle = 0;
    const Vector<R, 3>* last = nullptr;  // the last corner apart from corner 0
    bool returned = false;               // whether corner 0 came again since then
    for (std::size_t k = 1; k < points_.size(); ++k) {
      const Vector<R, 3>&p = points_[k - 1], &q = points_[k];
      if (p.cross(q).dot(normal) < -polygon_tolerance * std::max({p.norm(), q.norm(), (q - p).norm()})) return false;
      if (q.norm() <= polygon_tolerance) {
        returned = last != nullptr;
        continue;
      }
      if (last) {
        const double turned = std::atan2(last->cross(q).dot(normal), last->dot(q));
        angle += returned && turned < 0 ? turned + 2 * std::numbers::pi : std::abs(turned);
      }
      last = &q;
      returned = false;
    }
    return angle < 2 * std::numbers::pi + polygon_tolerance;
  }

  /// Twice the area of a triangle; positive if it is counter-clockwise.
  [[nodiscard]] static double turn(const Point& a, const Point& b, const Point& c) {
    const Point p = b - a, q = c - a;
    return p[0] * q[1] - p[1] * q[0];
  }
  /// The height of a triangle above its longest side, with the sign of its area.
  [[nodiscard]] static double height(const Point& a, const Point& b, const Point& c) {
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    return longest > 0 ? turn(a, b, c) / longest : 0;
  }
  /// How far `c` lies to the left of the line from `a` to `b`.
  [[nodiscard]] static double left(const Point& a, const Point& b, const Point& c) {
    const double length = (b - a).norm();
    return length > 0 ? turn(a, b, c) / length : 0;
  }

  void clip(const Vector<R, 3>& normal) {
    const Vector<R, 3> first = normal.unitOrthogonal(), second = normal.cross(first);
    for (const auto& point : points_) plane_.emplace_back(point.dot(first), point.dot(second));
    if (turns_once() && !crosses() && clip_ears() && !covers_twice()) return;
    if (is_flat(normal))
      fault_ = PolygonFault::crosses_itself;
    else
      make_fan();  // a warped face that no plane shows
  }

  /// Whether the border turns by one full angle. At the tip of a spike it may turn to either side.
  [[nodiscard]] bool turns_once() const {
    std::vector<Point> edges;
    for (std::size_t k = 0; k < plane_.size(); ++k) {
      const Point edge = plane_[(k + 1) % plane_.size()] - plane_[k];
      if (edge.norm() > polygon_tolerance) edges.push_back(edge);
    }
    double sum = 0, doubt = 1;
    for (std::size_t k = 0; k < edges.size(); ++k) {
      const Point &a = edges[k], &b = edges[(k + 1) % edges.size()];
      const double angle = std::atan2(a[0] * b[1] - a[1] * b[0], a.dot(b));
      if (std::abs(angle) > std::numbers::pi - 1e-3) doubt += 2 * std::numbers::pi;
      sum += angle;
    }
    return std::abs(sum - 2 * std::numbers::pi) < doubt;
  }

  /// Whether two edges cross, not only touch.
  [[nodiscard]] bool crosses() const {
    const std::size_t n = plane_.size();
    const auto parted = [&](std::size_t k, std::size_t m) {  // whether the ends of edge m lie to both sides of edge k
      const Point &a = plane_[k], &b = plane_[(k + 1) % n];
      const double p = left(a, b, plane_[m]), q = left(a, b, plane_[(m + 1) % n]);
      return std::min(p, q) < -polygon_tolerance && std::max(p, q) > polygon_tolerance;
    };
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t m = k + 2; m < n; ++m)
        if (parted(k, m) && parted(m, k)) return true;
    return false;
  }

  /// Whether a corner in `rest` other than those of the triangle lies in it, more than `margin` from its edges, or less
  /// than that outside of it if `margin` is negative: rounding must not hide a corner on an edge.
  [[nodiscard]] bool holds_corner(const Triangle& t, const std::vector<std::size_t>& rest, double margin) const {
    const Point &a = plane_[t[0]], &b = plane_[t[1]], &c = plane_[t[2]];
    return std::any_of(rest.begin(), rest.end(), [&](std::size_t k) {
      const Point& p = plane_[k];
      return p != a && p != b && p != c && left(a, b, p) >= margin && left(b, c, p) >= margin &&
             left(c, a, p) >= margin;
    });
  }

  /// Whether the corner in the middle of `t` may be cut off. The tip of a spike always comes first: it would hide that
  /// its neighbours are no ears. Of a simple polygon all other corners go the second way; the last two help if corners
  /// touch edges, and if nothing but slivers is left.
  enum Way { spike, ear, touched_ear, sliver, none };
  [[nodiscard]] bool is_ear(const Triangle& t, const std::vector<std::size_t>& rest, int way) const {
    const Point &a = plane_[t[0]], &b = plane_[t[1]], &c = plane_[t[2]];
    const double high = height(a, b, c);
    if (way == spike) return std::abs(high) <= polygon_tolerance && (b - a).dot(c - b) <= 0;
    if (way == sliver) return std::abs(high) <= polygon_tolerance;
    return high > polygon_tolerance && !holds_corner(t, rest, way == ear ? -polygon_tolerance : polygon_tolerance);
  }

  [[nodiscard]] bool clip_ears() {
    triangles_.clear();
    std::vector<std::size_t> rest(plane_.size());
    for (std::size_t k = 0; k < rest.size(); ++k) rest[k] = k;
    std::size_t at = 0, tried = 0;
    for (int way = spike; rest.size() > 3;) {
      const std::size_t n = rest.size();
      const Triangle t{rest[at % n], rest[(at + 1) % n], rest[(at + 2) % n]};
      if (is_ear(t, rest, way)) {
        triangles_.push_back(t);
        rest.erase(rest.begin() + static_cast<std::ptrdiff_t>((at + 1) % n));
        at = at % n < rest.size() ? at % n : 0;
        tried = 0;
        way = spike;
      } else {
        ++at;
        if (++tried < n) continue;
        tried = 0;
        if (++way == none) return false;
      }
    }
    triangles_.push_back({rest[0], rest[1], rest[2]});
    return height(plane_[rest[0]], plane_[rest[1]], plane_[rest[2]]) >= -polygon_tolerance;
  }

  /// Whether triangles lie upon each other, as where a border crosses itself in a corner.
  [[nodiscard]] bool covers_twice() const {
    const auto holds = [&](const Triangle& t, const Point& p) {
      const Point &a = plane_[t[0]], &b = plane_[t[1]], &c = plane_[t[2]];
      return std::min({left(a, b, p), left(b, c, p), left(c, a, p)}) > polygon_tolerance;
    };
    return std::any_of(triangles_.begin(), triangles_.end(), [&](const Triangle& t) {
      if (height(plane_[t[0]], plane_[t[1]], plane_[t[2]]) <= polygon_tolerance) return false;
      const Point middle = (plane_[t[0]] + plane_[t[1]] + plane_[t[2]]) / 3;
      return std::any_of(triangles_.begin(), triangles_.end(),
                         [&](const Triangle& u) { return u != t && holds(u, middle); });
    });
  }

  std::vector<Vector<R, 3>> points_;
  std::vector<Point> plane_;
  std::vector<Triangle> triangles_;
  PolygonFault fault_ = PolygonFault::none;
};
/// A template, so that only programs that read polygons compile it.
using PolygonSplit = BasicPolygonSplit<double>;

}  // namespace hmps::inline HMPS_ABI::detail
