// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/direction.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// A shape in `D` dimensions: `shape(x)` with `x` a `Vector<S, D>` in metres is negative inside, positive outside, and
/// approximates the signed distance to the surface in metres. Models: the primitives and combinators of this folder,
/// any lambda. Shapes are values that capture by value, so that a composed shape compiles to straight code.
/// A primitive of a negative size, or without the direction that it needs, is NaN everywhere; functions that sample
/// shapes refuse NaN.
///
/// *Exact* shapes return the Euclidean distance everywhere. *First-order* shapes return f / |grad f| of an implicit
/// function f: the zero surface is exact, the distance near it is correct to first order, and far away only the sign is
/// correct. `offset`, `layer` and `shell` of a first-order shape are therefore accurate only for offsets small compared
/// with the radius of curvature.
template <class F, class S, int D>
concept Shape = requires(const F& shape, const Vector<S, D>& x) {
  { shape(x) } -> std::convertible_to<S>;
};

namespace detail {
/// Fails to compile for a shape `F` that returns a truth value at a position `V`: as a number it is never negative, so
/// that the shape would be empty.
template <class F, class V>
struct RequireDistance {
  static_assert(!std::same_as<std::remove_cvref_t<std::invoke_result_t<const F&, const V&>>, bool>,
                "hmps: a shape returns its signed distance in m, negative inside, not whether a point is inside; write "
                "`return is_inside ? -1.0 : 1.0` if only the sign matters");
  static constexpr bool value = true;
};
/// `distance`, or NaN for a shape that does not exist because its size is negative. Functions that sample shapes refuse
/// NaN.
template <class S>
[[nodiscard]] S distance_if(bool exists, S distance) {
  return exists ? distance : std::numeric_limits<S>::quiet_NaN();
}

/// Parameter in [0, 1] of the point nearest to `x` on the segment from `from` to `to`; 0 if the segment is a point.
template <class S, int D>
[[nodiscard]] S nearest_on_segment(const Vector<S, D>& from, const Vector<S, D>& to, const Vector<S, D>& x) {
  const Vector<S, D> along = to - from;
  const S length = along.squaredNorm();
  return length > S(0) ? std::clamp((x - from).dot(along) / length, S(0), S(1)) : S(0);
}
}  // namespace detail

/// Disc or ball. Exact.
template <class S, int D>
struct Ball {
  Vector<S, D> centre = Vector<S, D>::Zero();  ///< m
  S radius{};                                  ///< m, positive
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    return detail::distance_if(radius >= S(0), (x - centre).norm() - radius);
  }
};

/// Ellipse or ellipsoid with axes along the coordinate axes (turn it with `rotated`). First order.
template <class S, int D>
struct Ellipsoid {
  Vector<S, D> centre = Vector<S, D>::Zero();  ///< m
  Vector<S, D> half_axes;                      ///< m, each positive
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    const Vector<S, D> scaled = (x - centre).cwiseQuotient(half_axes);
    const S level = scaled.norm();
    const S slope = scaled.cwiseQuotient(half_axes).norm();
    return detail::distance_if((half_axes.array() > S(0)).all(),
                               slope > S(0) ? level * (level - S(1)) / slope : -half_axes.minCoeff());
  }
};

/// Axis-parallel rectangle or box, also the region in which a lattice is filled. Exact.
template <class S, int D>
struct Box {
  Vector<S, D> lower;  ///< m
  Vector<S, D> upper;  ///< m, each component above that of `lower`
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    const Vector<S, D> beyond = (lower - x).cwiseMax(x - upper);
    return detail::distance_if(detail::none_above<S, D>(lower, upper),
                               beyond.cwiseMax(S(0)).norm() + std::min(beyond.maxCoeff(), S(0)));
  }
};

/// The half space behind the plane (2D: line) through `point` with the `outward` normal, of any length. Exact.
template <class S, int D>
struct HalfSpace {
  Vector<S, D> point = Vector<S, D>::Zero();  ///< m
  Vector<S, D> outward;                       ///< not zero
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    const Vector<S, D> normal = detail::measurable<S, D>(outward);
    const S length = normal.norm();
    return detail::distance_if(length > S(0), normal.dot(x - point) / length);
  }
};

/// All points within `radius` of a segment. Exact.
template <class S, int D>
struct Capsule {
  Vector<S, D> from;  ///< m
  Vector<S, D> to;    ///< m
  S radius{};         ///< m, positive
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    const S s = detail::nearest_on_segment(from, to, x);
    return detail::distance_if(radius >= S(0), (x - from - s * (to - from)).norm() - radius);
  }
};

/// Convex hull of two balls: a cone with round ends. Exact. If one ball contains the other, the larger one.
template <class S, int D>
struct RoundCone {
  Vector<S, D> from;  ///< m
  Vector<S, D> to;    ///< m
  S radius_from{};    ///< m, at `from`
  S radius_to{};      ///< m, at `to`
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    if (!(radius_from >= S(0) && radius_to >= S(0))) return std::numeric_limits<S>::quiet_NaN();
    const Vector<S, D> along = to - from;
    const S length = along.norm();
    const S fall = radius_from - radius_to;
    if (length <= std::abs(fall))
      return radius_from > radius_to ? (x - from).norm() - radius_from : (x - to).norm() - radius_to;
    // Works in the half plane of the axis, in coordinates (axial, radial) from the first centre. `sine` is that of half
    // the opening angle; the foot of the perpendicular on the lateral surface selects the piece.
    const Vector<S, D> arm = x - from;
    const S axial = arm.dot(along) / length;
    const S radial = std::sqrt(std::max(arm.squaredNorm() - axial * axial, S(0)));
    const S sine = fall / length;
    const S cosine = std::sqrt(S(1) - sine * sine);
    const S foot = axial * cosine - radial * sine;
    if (foot <= S(0)) return arm.norm() - radius_from;
    if (foot >= length * cosine) return (x - to).norm() - radius_to;
    return axial * sine + radial * cosine - radius_from;
  }
};

/// Cylinder with flat ends around a segment; in 2D a rectangle at any angle. Exact.
template <class S, int D>
struct Cylinder {
  Vector<S, D> from;  ///< m
  Vector<S, D> to;    ///< m, not `from`
  S radius{};         ///< m, positive
  [[nodiscard]] S operator()(const Vector<S, D>& x) const {
    const Vector<S, D> along = to - from;
    const S length = along.norm();
    const Vector<S, D> arm = x - from;
    const S axial = arm.dot(along) / length;
    const S side = (arm - axial / length * along).norm() - radius;
    const S end = std::max(-axial, axial - length);
    return detail::distance_if(
        radius >= S(0) && length > S(0),
        Vector<S, 2>(std::max(side, S(0)), std::max(end, S(0))).norm() + std::min(std::max(side, end), S(0)));
  }
};

/// Torus around the z axis (turn it with `rotated`). Exact.
template <class S>
struct Torus {
  Vector<S, 3> centre = Vector<S, 3>::Zero();  ///< m
  S ring{};                                    ///< m, radius of the centre line
  S radius{};                                  ///< m, of the tube
  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    const Vector<S, 3> arm = x - centre;
    return detail::distance_if(ring >= S(0) && radius >= S(0),
                               std::hypot(std::hypot(arm[0], arm[1]) - ring, arm[2]) - radius);
  }
};

}  // namespace hmps::inline HMPS_ABI
