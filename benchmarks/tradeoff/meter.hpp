// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "scenes/processor_time.hpp"
#include "tradeoff/scene.hpp"

namespace tradeoff {

/// Bytes that the program has allocated with `new` and not yet freed (memory.cpp).
[[nodiscard]] std::size_t allocated_bytes();
/// The largest number of allocated bytes since `forget_peak`.
[[nodiscard]] std::size_t peak_bytes();
void forget_peak();

/// Counts the cost of a run. Construct it first in the run: the memory of the scene is what has been allocated since
/// then and is still held when `hold` or `outcome` is called; the largest value counts.
class Meter {
 public:
  Meter() : bytes_(allocated_bytes()) { forget_peak(); }

  /// Processor time between `start` and `stop` counts. Enclose the steps, but not the measurements of the scene.
  void start() { begin_ = scenes::processor_seconds(); }
  void stop() { seconds_ += scenes::processor_seconds() - begin_; }
  /// Call it when all objects exist whose memory should count.
  void hold() { held_ = std::max(held_, allocated_bytes() - bytes_); }
  /// The largest memory held since the meter was constructed, for scenes that cannot call `hold`.
  [[nodiscard]] std::size_t peak() const { return peak_bytes() - bytes_; }
  /// Counts one step of `particles` particles.
  void count(std::size_t particles) { particle_steps_ += static_cast<double>(particles); }

  [[nodiscard]] Outcome outcome(std::vector<double> values) {
    hold();
    return {std::move(values), particle_steps_, seconds_, held_};
  }

 private:
  std::size_t bytes_, held_ = 0;
  double begin_ = 0, seconds_ = 0, particle_steps_ = 0;
};

}  // namespace tradeoff
