// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "scenes/processor_time.hpp"
#include "tradeoff/scene.hpp"

namespace tradeoff {

/// Bytes that the program has allocated with `new` and not yet given back (memory.cpp).
[[nodiscard]] std::size_t allocated_bytes();
/// The most that this has been since `forget_peak`.
[[nodiscard]] std::size_t peak_bytes();
void forget_peak();

/// Counts what a run costs. Make it first in the run: what is allocated from then on and still held
/// when `hold` or `outcome` is called is the memory of the scene; the most counts.
class Meter {
 public:
  Meter() : bytes_(allocated_bytes()) { forget_peak(); }

  /// Steps cost processor time between `start` and `stop`; what is measured of the scene should not.
  void start() { begin_ = scenes::processor_seconds(); }
  void stop() { seconds_ += scenes::processor_seconds() - begin_; }
  /// Says that all is still there whose memory counts.
  void hold() { held_ = std::max(held_, allocated_bytes() - bytes_); }
  /// The most memory that was held since the meter was made, for scenes of which only that can be seen.
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
