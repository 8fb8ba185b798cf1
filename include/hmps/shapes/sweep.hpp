// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/direction.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

/// Signed distance, to first order, of the point (u, v) to the superellipse
/// |u / a|^n + |v / b|^n = 1 with half axes a, b > 0 (m) and exponent n >= 1: 1 is a rhombus, 2 an
/// ellipse, large n a rectangle. NaN for other axes and exponents, which functions that sample shapes refuse.
template <class S>
[[nodiscard]] S superellipse(S u, S v, S a, S b, S n) {
  if (!(a > S(0) && b > S(0) && n >= S(1))) return detail::distance_if(false, S(0));
  const S p = std::abs(u) / a;
  const S q = std::abs(v) / b;
  const S level = n == S(2) ? std::sqrt(p * p + q * q)
                            : std::max(p, q) * std::pow(S(1) + std::pow(std::min(p, q) / std::max(p, q), n), S(1) / n);
  if (!(std::max(p, q) > std::numeric_limits<S>::epsilon())) return -std::min(a, b);
  const S slope = std::hypot(std::pow(p / level, n - S(1)) / a, std::pow(q / level, n - S(1)) / b);
  return (level - S(1)) / slope;
}

/// Centre and radius of a `Tube` at one vertex of its centre line.
template <class S, int D>
struct TubeRow {
  Vector<S, D> centre;  ///< m
  S radius{};           ///< m, positive
};

/// A tube along a polyline, with interpolated radii and round ends: a union of `RoundCone`s. Exact outside.
template <class S, int D>
class Tube {
 public:
  /// Throws `InputError` if there is no row, or if a row is not finite or has no positive radius.
  explicit Tube(std::vector<TubeRow<S, D>> rows) {
    detail::require(!rows.empty(), "hmps: a tube needs at least one row of centre and radius");
    for (std::size_t k = 0; k < rows.size(); ++k)
      detail::require(detail::all_finite(rows[k].centre) && detail::is_finite(rows[k].radius) && rows[k].radius > S(0),
                      "hmps: row ", k, " of a tube has radius ", rows[k].radius, " at (", rows[k].centre,
                      "); give finite centres and positive radii in metres");
    if (rows.size() == 1) rows.push_back(rows.front());
    for (std::size_t k = 0; k + 1 < rows.size(); ++k)
      pieces_.push_back({rows[k].centre, rows[k + 1].centre, rows[k].radius, rows[k + 1].radius});
  }

  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    if (pieces_.empty()) return std::numeric_limits<S>::quiet_NaN();  // moved from
    S least = pieces_.front()(x);
    for (std::size_t k = 1; k < pieces_.size(); ++k) least = std::min(least, pieces_[k](x));
    return least;
  }

 private:
  std::vector<RoundCone<S, D>> pieces_;
};

/// Section of a `Stack` at one level.
template <class S>
struct StackRow {
  S level{};               ///< m, coordinate along the axis of the stack
  Vector<S, 2> centre;     ///< m, in the two other coordinates, in the order x, y, z
  Vector<S, 2> half_axes;  ///< m, each positive, in the same order
};

/// A body of superelliptic sections stacked along a coordinate axis, with flat ends at the first and the last level.
/// Centre and half axes are interpolated linearly between the rows. First order within a section; ignores the slope of
/// the lateral surface along the axis.
template <class S>
class Stack {
 public:
  /// Rows in any order of levels; `axis` 0, 1 or 2; `exponent` as for `superellipse`. Throws
  /// `InputError` for fewer than two rows, equal levels, or a row that is not finite and positive.
  explicit Stack(std::vector<StackRow<S>> rows, S exponent = S(2), int axis = 2)
      : rows_(std::move(rows)), exponent_(exponent), axis_(axis) {
    detail::require(rows_.size() >= 2, "hmps: a stack has ", rows_.size(), " rows; give at least two levels");
    detail::require(detail::is_finite(exponent) && exponent >= S(1), "hmps: a stack has the exponent ", exponent,
                    "; give one from 1 (rhombus) on, 2 is an ellipse");
    detail::require(axis >= 0 && axis <= 2, "hmps: a stack has the axis ", axis, "; give 0, 1 or 2 for x, y or z");
    std::sort(rows_.begin(), rows_.end(), [](const auto& a, const auto& b) { return a.level < b.level; });
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto& row = rows_[k];
      detail::require(detail::is_finite(row.level) && detail::all_finite(row.centre) &&
                          detail::all_finite(row.half_axes) && row.half_axes.minCoeff() > S(0),
                      "hmps: the stack's section at level ", row.level, " has half axes ", row.half_axes,
                      "; give finite centres and positive half axes in metres");
      detail::require(k == 0 || rows_[k - 1].level < row.level, "hmps: a stack has two sections at level ", row.level,
                      "; give each level once");
    }
  }

  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    if (rows_.empty()) return std::numeric_limits<S>::quiet_NaN();  // moved from
    const S level = x[axis_];
    const StackRow<S> row = section(level);
    const int first = axis_ == 0 ? 1 : 0;
    const int second = axis_ == 2 ? 1 : 2;
    const S inside = superellipse(x[first] - row.centre[0], x[second] - row.centre[1], row.half_axes[0],
                                  row.half_axes[1], exponent_);
    const S end = std::max(rows_.front().level - level, level - rows_.back().level);
    return std::max(inside, end);
  }

  /// The interpolated section at `level`; beyond the ends, the end rows. Throws `InputError` for a stack moved from.
  [[nodiscard]] StackRow<S> section(S level) const {
    detail::require(!rows_.empty(), "hmps: a stack that was moved from has no sections; use the one it was moved to");
    if (level <= rows_.front().level) return rows_.front();
    if (level >= rows_.back().level) return rows_.back();
    const auto above =
        std::upper_bound(rows_.begin(), rows_.end(), level, [](S l, const auto& row) { return l < row.level; });
    const auto& b = *above;
    const auto& a = *(above - 1);
    const S s = (level - a.level) / (b.level - a.level);
    return {level, a.centre + s * (b.centre - a.centre), a.half_axes + s * (b.half_axes - a.half_axes)};
  }

 private:
  std::vector<StackRow<S>> rows_;
  S exponent_;
  int axis_;
};

/// Section of a `Plate` at one point of its centre line.
template <class S>
struct PlateRow {
  Vector<S, 3> centre;  ///< m
  S half_width{};       ///< m, along `across`, positive
  S half_thickness{};   ///< m, normal to the centre line and to `across`, positive
  S bow{};              ///< m, by which the edges |u| = half_width stand ahead of the middle, along across x tangent
};

/// A plate or strip swept along a polyline in a plane normal to `across`: superelliptic sections `half_width` by
/// `half_thickness`, interpolated linearly, optionally bent like a trough by bow (u / half_width)^2, with flat ends.
/// First order near the surface.
template <class S>
class Plate {
 public:
  /// Throws `InputError` for fewer than two rows, coincident neighbouring centres, a centre line
  /// that leaves its plane, or a row that is not finite and positive.
  explicit Plate(std::vector<PlateRow<S>> rows, const Vector<S, 3>& across = Vector<S, 3>::UnitY(), S exponent = S(2))
      : rows_(std::move(rows)), across_(detail::measurable<S, 3>(across).normalized()), exponent_(exponent) {
    detail::require(rows_.size() >= 2, "hmps: a plate has ", rows_.size(),
                    " rows; give at least two points of its centre line");
    detail::require(detail::is_finite(exponent) && exponent >= S(1), "hmps: a plate has the exponent ", exponent,
                    "; give one from 1 (rhombus) on, 2 is an ellipse");
    detail::require(detail::all_finite(across_) && across_.norm() > S(0.5), "hmps: the width direction of a plate is (",
                    across, "); give a vector that is not zero");
    for (std::size_t k = 0; k < rows_.size(); ++k) {
      const auto& row = rows_[k];
      detail::require(detail::all_finite(row.centre) && detail::is_finite(row.bow) &&
                          detail::is_finite(row.half_width) && detail::is_finite(row.half_thickness) &&
                          row.half_width > S(0) && row.half_thickness > S(0),
                      "hmps: row ", k, " of a plate has half width ", row.half_width, " and half thickness ",
                      row.half_thickness, "; give finite centres and positive sizes in metres");
      if (k == 0) continue;
      const Vector<S, 3> along = row.centre - rows_[k - 1].centre;
      detail::require(along.norm() > S(0), "hmps: rows ", k - 1, " and ", k,
                      " of a plate have the same centre; give each point once");
      detail::require(std::abs(along.dot(across_)) <= S(1e-3) * along.norm(),
                      "hmps: the centre line of a plate leaves its plane between rows ", k - 1, " and ", k,
                      "; it must be normal to the width direction (", across_, ")");
    }
  }

  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    if (rows_.empty()) return std::numeric_limits<S>::quiet_NaN();  // moved from
    const S u = (x - rows_.front().centre).dot(across_);
    const Vector<S, 3> flat = x - u * across_;
    std::size_t piece = 0;
    S fraction{};
    S least = std::numeric_limits<S>::max();
    for (std::size_t k = 0; k + 1 < rows_.size(); ++k) {
      const S s = detail::nearest_on_segment(rows_[k].centre, rows_[k + 1].centre, flat);
      const S distance = (flat - rows_[k].centre - s * (rows_[k + 1].centre - rows_[k].centre)).squaredNorm();
      if (distance < least) least = distance, piece = k, fraction = s;
    }
    const auto& a = rows_[piece];
    const auto& b = rows_[piece + 1];
    const Vector<S, 3> along = (b.centre - a.centre).normalized();
    const Vector<S, 3> arm = flat - a.centre - fraction * (b.centre - a.centre);
    const S before = piece == 0 && fraction <= S(0) ? -arm.dot(along) : S(0);
    const S behind = piece + 2 == rows_.size() && fraction >= S(1) ? arm.dot(along) : S(0);
    const S end = std::max(before, behind);
    // Beyond an inner corner the offset is the whole distance to the corner, otherwise its component along the normal;
    // beyond an end the rest is `end`.
    const S normal_part = arm.dot(across_.cross(along));
    const S v = end > S(0) ? normal_part : std::copysign(std::sqrt(least), normal_part);
    const S width = a.half_width + fraction * (b.half_width - a.half_width);
    const S thickness = a.half_thickness + fraction * (b.half_thickness - a.half_thickness);
    const S bow = a.bow + fraction * (b.bow - a.bow);
    const S lean = u / width;
    const S section = superellipse(u, v - bow * lean * lean, width, thickness, exponent_);
    return end > S(0) ? std::max(section, end) : section;
  }

  /// Arc length in metres of the centre line from its first row to the point nearest to `x`: the coordinate for control
  /// regions along an organ. Throws `InputError` for a plate moved from.
  [[nodiscard]] S arc(const Vector<S, 3>& x) const {
    detail::require(!rows_.empty(),
                    "hmps: a plate that was moved from has no centre line; use the one it was moved to");
    const Vector<S, 3> flat = x - (x - rows_.front().centre).dot(across_) * across_;
    S least = std::numeric_limits<S>::max();
    S length{};
    S result{};
    for (std::size_t k = 0; k + 1 < rows_.size(); ++k) {
      const Vector<S, 3> along = rows_[k + 1].centre - rows_[k].centre;
      const S s = detail::nearest_on_segment(rows_[k].centre, rows_[k + 1].centre, flat);
      const S distance = (flat - rows_[k].centre - s * along).squaredNorm();
      if (distance < least) least = distance, result = length + s * along.norm();
      length += along.norm();
    }
    return result;
  }

 private:
  std::vector<PlateRow<S>> rows_;
  Vector<S, 3> across_;
  S exponent_;
};

}  // namespace hmps::inline HMPS_ABI
