// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

/// Rotation matrix of `angle` (rad, counter-clockwise) in the plane.
template <class S>
[[nodiscard]] Matrix<S, 2> rotation(S angle) {
  static_assert(detail::RequireReal<S>::value);
  const S c = std::cos(angle);
  const S s = std::sin(angle);
  Matrix<S, 2> r;
  r << c, -s, s, c;
  return r;
}

namespace detail {
/// sin(a)/a, (1 - cos a)/a^2 and (a - sin a)/a^3, as series where the quotients would suffer cancellation.
template <class S>
struct RotationCoefficients {
  S first, second, third;
  explicit RotationCoefficients(S a) {
    const S a2 = a * a;
    if (a < S(0.1)) {
      first = S(1) - a2 / S(6) * (S(1) - a2 / S(20) * (S(1) - a2 / S(42)));
      second = (S(1) - a2 / S(12) * (S(1) - a2 / S(30) * (S(1) - a2 / S(56)))) / S(2);
      third = (S(1) - a2 / S(20) * (S(1) - a2 / S(42) * (S(1) - a2 / S(72)))) / S(6);
    } else {
      first = std::sin(a) / a;
      second = (S(1) - std::cos(a)) / a2;
      third = (a - std::sin(a)) / (a2 * a);
    }
  }
};
}  // namespace detail

/// Rotation matrix of a rotation vector: its direction is the axis, its length the angle in rad
/// (right-handed).
template <class S>
[[nodiscard]] Matrix<S, 3> rotation(const Vector<S, 3>& vector) {
  const detail::RotationCoefficients<S> k(vector.norm());
  const Matrix<S, 3> w = skew(vector);
  return Matrix<S, 3>::Identity() + k.first * w + k.second * w * w;
}

/// Angular velocity (rad/s, spatial) of a rotation vector that changes at `rate` (rad/s). The two differ if the axis
/// turns.
template <class S>
[[nodiscard]] Vector<S, 3> angular_velocity(const Vector<S, 3>& vector, const Vector<S, 3>& rate) {
  const detail::RotationCoefficients<S> k(vector.norm());
  const Vector<S, 3> first = vector.cross(rate);
  return rate + k.second * first + k.third * vector.cross(first);
}

/// A rigid displacement of a body: `pose(X)` is rotation (X - pivot) + pivot + translation. The default is the
/// identity.
template <class S, int D>
struct Pose {
  Matrix<S, D> rotation = Matrix<S, D>::Identity();  ///< orthogonal, determinant 1
  Vector<S, D> pivot = Vector<S, D>::Zero();         ///< in m; the reference point that only translates
  Vector<S, D> translation = Vector<S, D>::Zero();   ///< m

  /// The position of the material point with reference position `reference`.
  [[nodiscard]] Vector<S, D> operator()(const Vector<S, D>& reference) const {
    return pivot + translation + rotation * (reference - pivot);
  }
};

namespace detail {
/// Throws `InputError` if the matrix of `pose` at `time` (s) is not a rotation. Accepts a matrix that is not finite,
/// and any map other than a `Pose`, which need not be rigid.
template <class S, int D>
void require_rigid(const Pose<S, D>& pose, double time) {
  const Matrix<S, D>& R = pose.rotation;
  bool finite = true;
  S excess = 0;  // the square of the norm of R R^T - 1
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) {
      S entry = r == c ? S(-1) : S(0);
      for (int k = 0; k < D; ++k) entry += R(r, k) * R(c, k);
      finite = finite && is_finite(entry);
      excess += entry * entry;
    }
  require(
      !finite || (std::sqrt(excess) < S(1e-3) && determinant(R) > S(0)), "hmps: the rotation of a pose at ", time,
      " s is the matrix (by columns) ", pose.rotation,
      ", which is not a rotation; give an orthogonal matrix with determinant 1, such as rotation(vector) returns, or "
      "return a lambda instead of a Pose for a motion that is not rigid");
}
template <class Map>
void require_rigid(const Map&, double) {}
}  // namespace detail

/// The composition of two poses: `compose(second, first)(X) == second(first(X))`.
template <class S, int D>
[[nodiscard]] Pose<S, D> compose(const Pose<S, D>& second, const Pose<S, D>& first) {
  return {second.rotation * first.rotation, first.pivot, second(first(first.pivot)) - first.pivot};
}

/// The inverse of `pose`.
template <class S, int D>
[[nodiscard]] Pose<S, D> inverse(const Pose<S, D>& pose) {
  return {pose.rotation.transpose(), pose.pivot + pose.translation, -pose.translation};
}

/// The rate of change of a pose. `ControlRegion::prescribe` does not need it, because it moves particles from where
/// they are to where the pose puts them; `ControlRegion::place` does, and so do time integrations of your own that set
/// velocities, such as velocity Verlet.
template <class S, int D>
struct PoseRate {
  /// rad/s: one number in 2D, a vector in 3D.
  Vector<S, D == 2 ? 1 : 3> angular = Vector < S, D == 2 ? 1 : 3 > ::Zero();
  Vector<S, D> linear = Vector<S, D>::Zero();  ///< m/s, of the pivot
};

/// Velocity (m/s) of the material point with reference position `reference` in a body at `pose`
/// that moves at `rate`.
template <class S, int D>
[[nodiscard]] Vector<S, D> velocity(const Pose<S, D>& pose, const PoseRate<S, D>& rate, const Vector<S, D>& reference) {
  const Vector<S, D> arm = pose.rotation * (reference - pose.pivot);
  if constexpr (D == 2)
    return rate.linear + rate.angular[0] * Vector<S, 2>(-arm[1], arm[0]);
  else
    return rate.linear + rate.angular.cross(arm);
}

}  // namespace hmps::inline HMPS_ABI
