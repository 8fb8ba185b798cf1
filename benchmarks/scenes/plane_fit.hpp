// SPDX-License-Identifier: MIT
#pragma once

#include <hmps/hmps.hpp>

namespace scenes {

/// The plane through values at places near a point, by least squares.
class PlaneFit {
 public:
  /// Adds a value at a place `from` the point, in spacings.
  void add(const hmps::Vector<double, 3>& from, double value) {
    const Eigen::Vector4d one(1, from[0], from[1], from[2]);
    squares_ += one * one.transpose();
    values_ += value * one;
  }
  /// The value at the point.
  [[nodiscard]] double at_point() const { return squares_.ldlt().solve(values_)[0]; }

 private:
  // The small numbers make the plane level across the places if these lie in a line.
  Eigen::Matrix4d squares_ = Eigen::Vector4d(0, 1e-9, 1e-9, 1e-9).asDiagonal();
  Eigen::Vector4d values_ = Eigen::Vector4d::Zero();
};

}  // namespace scenes
