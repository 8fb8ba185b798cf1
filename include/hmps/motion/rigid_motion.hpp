// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/direction.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/motion/keyframes.hpp"
#include "hmps/motion/pose.hpp"

namespace hmps::inline HMPS_ABI {

/// A motion in `D` dimensions: `motion(t)(X)` is the position at time `t` (s) of the material point with reference
/// position `X` (m), both in double. Models: anything that returns a `Pose`; a lambda that returns a lambda, which need
/// not be rigid. A motion that returns a `Pose` may have `rate(t)`, its `PoseRate`: `ControlRegion::place` then takes
/// the velocities from it.
template <class M, int D>
concept Motion = requires(const M& motion, double t, const Vector<double, D>& reference) {
  { motion(t)(reference) } -> std::convertible_to<Vector<double, D>>;
};

namespace detail {
/// A motion that knows the velocities of its points.
template <class M, int D>
concept RatedMotion = requires(const M& motion, double t, const Vector<double, D>& reference) {
  { velocity(motion(t), motion.rate(t), reference) } -> std::convertible_to<Vector<double, D>>;
};
}  // namespace detail

/// No motion.
template <int D>
struct Fixed {
  [[nodiscard]] Pose<double, D> operator()(double) const { return {}; }
  [[nodiscard]] PoseRate<double, D> rate(double) const { return {}; }
};

/// Translation along a track in metres.
template <int D>
struct Translation {
  Keyframes<D> translation;
  [[nodiscard]] Pose<double, D> operator()(double t) const {
    Pose<double, D> pose;
    pose.translation = translation.value(t);
    return pose;
  }
  /// The rate of change of the pose at `t`.
  [[nodiscard]] PoseRate<double, D> rate(double t) const {
    PoseRate<double, D> rate;
    rate.linear = translation.rate(t);
    return rate;
  }
};

/// Rotation about `axis` (of any length) through `pivot` by a track of angles in rad. Throws `InputError` for an axis
/// that is zero or not finite.
struct Turn {
  Vector<double, 3> pivot;
  Vector<double, 3> axis;
  Track angle;
  /// A template, so that it is compiled only in programs that call it.
  template <std::same_as<double> T = double>
  [[nodiscard]] Pose<T, 3> operator()(std::type_identity_t<T> t) const {
    return {rotation<T>(Vector<T, 3>(angle.value(t) * unit_axis<T>())), pivot, Vector<T, 3>::Zero()};
  }
  /// The rate of change of the pose at `t`.
  template <std::same_as<double> T = double>
  [[nodiscard]] PoseRate<T, 3> rate(std::type_identity_t<T> t) const {
    return {angle.rate(t) * unit_axis<T>(), Vector<T, 3>::Zero()};
  }

 private:
  template <class T>
  [[nodiscard]] Vector<T, 3> unit_axis() const {
    const Vector<T, 3> about = detail::measurable<T, 3>(axis);
    const T length = about.norm();
    detail::require(detail::is_finite(length) && length > 0, "hmps: the axis of a turn is (", axis,
                    "); give a direction of finite, nonzero length");
    return about.normalized();
  }
};

/// Translation of a pivot along a track (m) and rotation about it: by an angle in 2D, by a rotation
/// vector in 3D (rad).
template <int D>
struct RigidMotion {
  Vector<double, D> pivot;
  Keyframes<D> translation;
  Keyframes<D == 2 ? 1 : 3> turn;

  [[nodiscard]] Pose<double, D> operator()(double t) const {
    return {rotation<double>(turn.value(t)), pivot, translation.value(t)};
  }
  /// The rate of change of the pose at `t`.
  [[nodiscard]] PoseRate<double, D> rate(double t) const {
    PoseRate<double, D> rate;
    rate.linear = translation.rate(t);
    if constexpr (D == 2)
      rate.angular[0] = turn.rate(t);
    else
      rate.angular = angular_velocity<double>(turn.value(t), turn.rate(t));
    return rate;
  }
};

/// The motion of a region that moves with `carrier` and by `own` relative to it, such as the arytenoids on the larynx.
/// `own` is described in the reference configuration of the carrier.
template <class Carrier, class Own>
[[nodiscard]] auto carried(Carrier carrier, Own own) {
  return [carrier = std::move(carrier), own = std::move(own)](double t) {
    if constexpr (requires { compose(carrier(t), own(t)); })
      return compose(carrier(t), own(t));
    else
      return [outer = carrier(t), inner = own(t)](const auto& reference) { return outer(inner(reference)); };
  };
}

}  // namespace hmps::inline HMPS_ABI
