// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Tells how far the particles that move have moved as a whole since `start`: by the translation and rotation that fit
/// their positions best. What is left is their deformation.
template <class Body, int D>
class MotionAsAWhole {
 public:
  explicit MotionAsAWhole(const Body& body) : body_(body) {}

  void start(int iteration) {
    places_ = places();
    from_ = iteration;
  }
  /// What the error of a search says about the motion; empty unless the body has moved as a whole by a hundredth of a
  /// `spacing` (m) or more and by 50 times its deformation, as root mean squares. A bending cantilever moves by 6 times
  /// its deformation.
  [[nodiscard]] std::string remark(double spacing) const {
    const std::vector<V> now = places();
    if (now.empty() || now.size() != places_.size()) return "";
    const auto count = static_cast<double>(now.size());
    const V before = mean(places_), after = mean(now);
    M correlation = M::Zero();
    double spread = 0, moved = 0;
    for (std::size_t k = 0; k < now.size(); ++k) {
      const V p = places_[k] - before, q = now[k] - after;
      correlation += p * q.transpose();
      spread += p.squaredNorm() + q.squaredNorm();
      moved += (now[k] - places_[k]).squaredNorm();
    }
    const double path = std::sqrt(moved / count);
    const double deformed = std::sqrt(std::max(spread - 2 * turned(correlation), 0.0) / count);
    if (!(path >= 0.01 * spacing) || !(path >= 50 * deformed)) return "";
    return message("since iteration ", from_, " the body has moved as a whole, its centre by (", V(after - before),
                   ") m and its particles by ", path, " m, and deformed by ", deformed, " m");
  }

 private:
  using V = Vector<double, D>;
  using M = Matrix<double, D>;
  [[nodiscard]] std::vector<V> places() const {
    std::vector<V> places;
    for (std::size_t i = 0; i < body_.size(); ++i)
      if (body_.follows()[i] != 0) places.push_back(body_.place(i));
    return places;
  }
  [[nodiscard]] static V mean(const std::vector<V>& places) {
    V sum = V::Zero();
    for (const V& place : places) sum += place;
    return sum / static_cast<double>(places.size());
  }

  /// The largest trace of a product R `C` with a rotation R: in three dimensions the largest eigenvalue of a matrix of
  /// quaternions (Horn 1987), by repeated squaring.
  [[nodiscard]] static double turned(const M& C) {
    if constexpr (D == 2) {
      return std::hypot(C(0, 0) + C(1, 1), C(0, 1) - C(1, 0));
    } else {
      using Four = Eigen::Matrix4d;
      Four N;
      N << C(0, 0) + C(1, 1) + C(2, 2), C(1, 2) - C(2, 1), C(2, 0) - C(0, 2), C(0, 1) - C(1, 0),  //
          C(1, 2) - C(2, 1), C(0, 0) - C(1, 1) - C(2, 2), C(0, 1) + C(1, 0), C(2, 0) + C(0, 2),   //
          C(2, 0) - C(0, 2), C(0, 1) + C(1, 0), C(1, 1) - C(0, 0) - C(2, 2), C(1, 2) + C(2, 1),   //
          C(0, 1) - C(1, 0), C(2, 0) + C(0, 2), C(1, 2) + C(2, 1), C(2, 2) - C(0, 0) - C(1, 1);
      const double size = N.norm();
      if (!(size > 0)) return 0;
      Four power = N / size + Four::Identity();  // no eigenvalue is negative
      for (int k = 0; k < 60; ++k) power = (power * power).eval() / power.squaredNorm();
      int longest = 0;
      for (int k = 1; k < 4; ++k)
        if (power.col(k).squaredNorm() > power.col(longest).squaredNorm()) longest = k;
      const Eigen::Vector4d q = power.col(longest).normalized();
      return q.dot(N * q);
    }
  }

  const Body& body_;
  std::vector<V> places_;
  int from_ = 0;
};

}  // namespace hmps::inline HMPS_ABI::detail
