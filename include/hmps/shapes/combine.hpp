// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// A shape that evaluates the function object `rule`. Wrapping the lambda keeps the names of the combinators short in
/// error messages and passes any position type through unconverted.
template <class Rule>
struct Combined {
  Rule rule;
  template <class V>
  [[nodiscard]] typename V::Scalar operator()(const V& x) const {
    return rule(x);
  }
};
template <class Rule>
Combined(Rule) -> Combined<Rule>;

/// The smaller or the larger of two distances, or NaN if one of them is: `std::min` and `std::max` drop a NaN in second
/// place, so that a shape that does not exist would be missing without an error.
template <class S>
[[nodiscard]] S smaller(const S& a, const S& b) {
  return is_nan(a) ? a : is_nan(b) ? b : std::min(a, b);
}
template <class S>
[[nodiscard]] S larger(const S& a, const S& b) {
  return is_nan(a) ? a : is_nan(b) ? b : std::max(a, b);
}

/// Polynomial smooth minimum: `smaller(a, b)` where they differ by more than `width`, at most `width / 4` below it
/// where they are equal; continuously differentiable.
template <class S>
[[nodiscard]] S smooth_min(S a, S b, S width) {
  const S least = smaller(a, b);
  if (is_nan(least) || !(width > S(0))) return least;
  const S overlap = std::max(width - std::abs(a - b), S(0)) / width;
  return least - overlap * overlap * width / S(4);
}

}  // namespace detail

/// Union of shapes. Exact outside if the shapes are exact. Here as in all combinations, the result is NaN where one of
/// the shapes is.
template <class A, class B, class... More>
[[nodiscard]] auto unite(A a, B b, More... more) {
  if constexpr (sizeof...(More) == 0)
    return detail::Combined{
        [a = std::move(a), b = std::move(b)](const auto& x) { return detail::smaller(a(x), b(x)); }};
  else
    return unite(unite(std::move(a), std::move(b)), std::move(more)...);
}

/// Union of a list of shapes of one type, such as `Ball`. Throws `InputError` for an empty list.
template <class A>
[[nodiscard]] auto unite_all(std::vector<A> shapes) {
  detail::require(!shapes.empty(), "hmps: unite_all was given no shapes; give at least one");
  return detail::Combined{[shapes = std::move(shapes)](const auto& x) {
    using S = std::decay_t<decltype(shapes.front()(x))>;
    if (shapes.empty()) return std::numeric_limits<S>::quiet_NaN();  // moved from
    S least = shapes.front()(x);
    for (std::size_t k = 1; k < shapes.size(); ++k) least = detail::smaller(least, shapes[k](x));
    return least;
  }};
}

/// Intersection of shapes. A lower bound of the distance if the shapes are exact.
template <class A, class B, class... More>
[[nodiscard]] auto intersect(A a, B b, More... more) {
  if constexpr (sizeof...(More) == 0)
    return detail::Combined{[a = std::move(a), b = std::move(b)](const auto& x) { return detail::larger(a(x), b(x)); }};
  else
    return intersect(intersect(std::move(a), std::move(b)), std::move(more)...);
}

/// Complement of a shape. Exact if the shape is.
template <class A>
[[nodiscard]] auto complement(A a) {
  return detail::Combined{[a = std::move(a)](const auto& x) { return -a(x); }};
}

/// Difference: the points of `a` that are in none of the other shapes. A lower bound of the distance if the shapes are
/// exact.
template <class A, class B, class... More>
[[nodiscard]] auto subtract(A a, B b, More... more) {
  if constexpr (sizeof...(More) == 0)
    return detail::Combined{
        [a = std::move(a), b = std::move(b)](const auto& x) { return detail::larger(a(x), -b(x)); }};
  else
    return subtract(subtract(std::move(a), std::move(b)), std::move(more)...);
}

/// The shape grown by `distance` metres (shrunk if negative).
template <class A, class S>
[[nodiscard]] auto offset(A a, S distance) {
  return detail::Combined{[a = std::move(a), distance](const auto& x) {
    return a(x) - static_cast<typename std::decay_t<decltype(x)>::Scalar>(distance);
  }};
}

/// The points whose signed distance to the shape lies between `from` and `to` metres: `layer(a, 0, t)` is a wall of
/// thickness t outside a, `layer(a, -t, 0)` one inside. Throws `InputError` if `from` is above `to`.
template <class A, class S>
[[nodiscard]] auto layer(A a, S from, S to) {
  detail::require(!detail::is_nan(from) && !detail::is_nan(to) && from <= to, "hmps: a layer reaches from ", from,
                  " to ", to, " m from its shape; give the smaller distance first, and a shell a positive thickness");
  return detail::Combined{[a = std::move(a), from, to](const auto& x) {
    using Scalar = typename std::decay_t<decltype(x)>::Scalar;
    const Scalar d = a(x);
    return std::max(static_cast<Scalar>(from) - d, d - static_cast<Scalar>(to));
  }};
}

/// A sheet of the given thickness with the surface of `a` as its middle surface. Throws `InputError` for a negative
/// thickness.
template <class A, class S>
[[nodiscard]] auto shell(A a, S thickness) {
  using Length = std::conditional_t<std::is_integral_v<S>, double, S>;  // half of an integer need not be one
  const auto half = static_cast<Length>(thickness) / 2;
  return layer(std::move(a), -half, half);
}

/// Union with a fillet: adds material where the two distances differ by less than `radius`, at most radius / 4. Smooth,
/// but not an exact distance near the fillet. Throws `InputError` for a radius that is negative or not finite.
template <class A, class B, class S>
[[nodiscard]] auto smooth_unite(A a, B b, S radius) {
  detail::require(detail::is_finite(radius) && radius >= 0, "hmps: the radius of a fillet is ", radius,
                  " m; give a positive number of metres, or 0 for a sharp edge");
  return detail::Combined{[a = std::move(a), b = std::move(b), radius](const auto& x) {
    using Scalar = typename std::decay_t<decltype(x)>::Scalar;
    return detail::smooth_min<Scalar>(a(x), b(x), static_cast<Scalar>(radius));
  }};
}

/// Intersection with a rounded edge; see `smooth_unite`.
template <class A, class B, class S>
[[nodiscard]] auto smooth_intersect(A a, B b, S radius) {
  return complement(smooth_unite(complement(std::move(a)), complement(std::move(b)), radius));
}

/// `a` without `b`, with a rounded edge; see `smooth_unite`.
template <class A, class B, class S>
[[nodiscard]] auto smooth_subtract(A a, B b, S radius) {
  return complement(smooth_unite(complement(std::move(a)), std::move(b), radius));
}

/// The shape moved by `by` metres. Exact if the shape is. Throws `InputError` unless `by` is finite.
template <class A, class S, int D>
[[nodiscard]] auto translated(A a, const Vector<S, D>& by) {
  detail::require(detail::all_finite(by), "hmps: a shape is moved by (", by, ") m; its components must be finite");
  return detail::Combined{[a = std::move(a), by](const auto& x) { return a(Vector<S, D>(x - by)); }};
}

/// The shape turned by the rotation matrix `rotation` about the point `pivot`. Exact if the shape
/// is. Throws `InputError` for a matrix that is not orthogonal or is a reflection: use `warped` to scale or shear.
template <class A, class S, int D>
[[nodiscard]] auto rotated(A a, const Matrix<S, D>& rotation, const Vector<S, D>& pivot) {
  const Matrix<S, D> excess = rotation * rotation.transpose() - Matrix<S, D>::Identity();
  detail::require(detail::all_finite(excess) && excess.norm() < S(1e-3) && determinant(rotation) > S(0),
                  "hmps: a shape is rotated by the matrix (by columns) ", rotation,
                  ", which is not orthogonal or is a reflection; give a rotation, or use mirrored or warped");
  return detail::Combined{[a = std::move(a), rotation, pivot](const auto& x) {
    return a(Vector<S, D>(pivot + rotation.transpose() * (x - pivot)));
  }};
}

/// The shape turned about the origin.
template <class A, class S, int D>
[[nodiscard]] auto rotated(A a, const Matrix<S, D>& rotation) {
  return rotated(std::move(a), rotation, Vector<S, D>(Vector<S, D>::Zero()));
}

/// The half of a shape where coordinate `axis` exceeds `at`, and its mirror image: describes left and right at once.
/// `axis` is 0, 1 or, in three dimensions, 2; throws `InputError` for others: for 2 in the plane when it is evaluated.
template <class A, class S = double>
[[nodiscard]] auto mirrored(A a, int axis, S at = S(0)) {
  detail::require(axis >= 0 && axis <= 2, "hmps: a shape is mirrored along the axis ", axis,
                  "; give 0, 1 or 2 for x, y or z");
  return detail::Combined{[a = std::move(a), axis, at](const auto& x) {
    using Scalar = typename std::decay_t<decltype(x)>::Scalar;
    typename std::decay_t<decltype(x)>::PlainObject folded = x;  // a copy, also of a column or a map
    detail::require(axis < x.size(), "hmps: a shape in ", x.size(), " dimensions is mirrored along the axis ", axis,
                    "; give 0 or 1 for x or y");
    folded[axis] = static_cast<Scalar>(at) + std::abs(x[axis] - static_cast<Scalar>(at));
    return a(folded);
  }};
}

/// The shape composed with `map`, a callable from positions to positions: `shape(map(x))`. The sign is exact; the
/// distance is correct only if the map preserves lengths.
template <class A, class Map>
[[nodiscard]] auto warped(A a, Map map) {
  return detail::Combined{[a = std::move(a), map = std::move(map)](const auto& x) { return a(map(x)); }};
}

}  // namespace hmps::inline HMPS_ABI
