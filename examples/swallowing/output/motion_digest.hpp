// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "output/digest.hpp"
#include "scene/motion.hpp"
#include "scene/scene.hpp"
#include "simulation/step_clock.hpp"

namespace swallowing {

/// A hash of the particles at rest and of the poses of their control regions on every beat of a run so far. Runs with
/// the same settings whose hashes agree at some time are the same run until then, whatever their tracks say about later
/// times.
class MotionDigest {
 public:
  /// Keeps references to `scene` and `motion`, which must outlive it.
  MotionDigest(const Scene& scene, const Motion& motion) : scene_(&scene), motion_(&motion) {
    for (const Eigen::Vector3d& x : scene.reference) add(x);
  }
  /// The hash up to the last beat that is not after `time` (s); `time` must not decrease from call to call.
  [[nodiscard]] std::uint64_t until(double time) {
    for (; static_cast<double>(beat_) * StepClock::beat <= time + StepClock::beat / 1e3; ++beat_)
      for (const Region& region : scene_->regions) {
        const auto pose = (*motion_)(region, static_cast<double>(beat_) * StepClock::beat);
        add(pose.rotation);
        add(pose.translation);
        add(pose.pivot);
      }
    return digest_.value();
  }

 private:
  template <class Matrix>
  void add(const Matrix& matrix) {
    for (const double value : std::span(matrix.data(), static_cast<std::size_t>(matrix.size()))) {
      const double positive_zero = value + 0.0;  // -0 is the same place as 0.
      digest_.add(std::string_view(reinterpret_cast<const char*>(&positive_zero), sizeof positive_zero));
    }
  }

  const Scene* scene_;
  const Motion* motion_;
  Digest digest_;
  std::uint64_t beat_ = 0;
};

}  // namespace swallowing
