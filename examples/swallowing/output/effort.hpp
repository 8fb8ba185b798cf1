// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace swallowing {

/// Seconds that a run took for each simulated tenth of a second, in total and for contact.
struct Effort {
  static constexpr double tenth = 0.1;  // s
  std::vector<double> wall, contact;

  /// Adds the time spent until the simulated time reached `time`.
  void add(double time, double wall_seconds, double contact_seconds) {
    const auto bin = static_cast<std::size_t>(std::max(std::ceil(time / tenth - 1e-6), 1.0)) - 1;
    wall.resize(std::max(wall.size(), bin + 1));
    contact.resize(wall.size());
    wall[bin] += wall_seconds;
    contact[bin] += contact_seconds;
  }
  [[nodiscard]] double seconds() const { return std::accumulate(wall.begin(), wall.end(), 0.0); }
  [[nodiscard]] double contact_share() const {
    return std::accumulate(contact.begin(), contact.end(), 0.0) / std::max(seconds(), 1e-9);
  }
  [[nodiscard]] std::vector<double> contact_share_per_tenth() const {
    std::vector<double> shares;
    for (std::size_t bin = 0; bin < wall.size(); ++bin) shares.push_back(contact[bin] / std::max(wall[bin], 1e-9));
    return shares;
  }
};

}  // namespace swallowing
