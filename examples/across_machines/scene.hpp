// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include <hmps/core/error.hpp>
#include <hmps/core/types.hpp>

#include "../common/error.hpp"

namespace across_machines {

using hmps::Index;
using Cell = std::array<std::int16_t, 3>;
inline constexpr Index no_particle = std::numeric_limits<Index>::max();
inline constexpr double l0 = 2e-3, rho = 1000, mu = 0.2;  // m, kg/m3, -

/// A particle near the surface of a body, as contact knows it.
struct SurfaceParticle {
  Index particle;
  int body;
  bool slave;  ///< in the outermost layer; all are masters
};

/// A block of soft tissue on a plate of the same: about `particles` particles of one lattice, numbered in the order of
/// the sweeps. The lowest layer of the plate is pulled sideways, the highest of the block is pressed down.
class Scene {
 public:
  explicit Scene(double particles) {
    examples::require(particles >= 1280 && particles <= 1e8, "hmps: a scene of ", particles,
                      " particles was asked for; give from 1280 to 1e8");
    const double k = std::cbrt(particles / 20);
    const auto whole = [](double x) { return static_cast<int>(std::lround(x)); };
    const int edge = whole(2 * k);
    // As wide as both are high, so that planes across y come first in the order of the sweeps.
    body_[0] = {{0, 0, 0}, {whole(4 * k), whole(k) + edge, whole(k)}};
    body_[1] = {{whole(k), whole(k / 2), body_[0].size[2]}, {edge, edge, edge}};
    extent_ = {body_[0].size[0], body_[0].size[1], body_[0].size[2] + edge};
    at_.assign(static_cast<std::size_t>(extent_[0]) * static_cast<std::size_t>(extent_[1]) *
                   static_cast<std::size_t>(extent_[2]),
               no_particle);
    for (int y = 0; y < extent_[1]; ++y)
      for (int z = 0; z < extent_[2]; ++z)
        for (int x = 0; x < extent_[0]; ++x)
          if (depth(0, {x, y, z}) >= 0 || depth(1, {x, y, z}) >= 0) {
            at_[place(x, y, z)] = static_cast<Index>(cell_.size());
            cell_.push_back({static_cast<std::int16_t>(x), static_cast<std::int16_t>(y), static_cast<std::int16_t>(z)});
          }
  }

  /// The axes of the order, the slowest first, for `BondSettings::axes`: those that `hmps::lattice_axes` chooses for
  /// the whole scene.
  [[nodiscard]] static std::array<int, 3> axes() { return {1, 2, 0}; }
  [[nodiscard]] std::size_t size() const { return cell_.size(); }
  [[nodiscard]] const Cell& cell(std::size_t i) const { return cell_[i]; }
  /// 0: the plate, 1: the block.
  [[nodiscard]] int body(std::size_t i) const { return cell_[i][2] < body_[0].size[2] ? 0 : 1; }
  /// The reference position in m.
  [[nodiscard]] hmps::Vector<double, 3> reference(std::size_t i) const {
    return l0 * (hmps::Vector<double, 3>(cell_[i][0], cell_[i][1], cell_[i][2]).array() + 0.5).matrix();
  }
  /// Whether the motion of particle `i` is prescribed.
  [[nodiscard]] bool prescribed(std::size_t i) const { return cell_[i][2] == 0 || cell_[i][2] == extent_[2] - 1; }

  /// Calls `visit(j)` for each particle that is bonded to `i`: of one body, within 1.75 spacings.
  template <class Visit>
  void for_each_neighbour(std::size_t i, Visit&& visit) const {
    const Cell c = cell_[i];
    const int own = body(i);
    for (int z = std::max(0, c[2] - 1); z <= std::min(extent_[2] - 1, c[2] + 1); ++z) {
      if ((z < body_[0].size[2] ? 0 : 1) != own) continue;
      for (int y = std::max(0, c[1] - 1); y <= std::min(extent_[1] - 1, c[1] + 1); ++y)
        for (int x = std::max(0, c[0] - 1); x <= std::min(extent_[0] - 1, c[0] + 1); ++x)
          if (const Index j = at_[place(x, y, z)]; j != no_particle && j != i) visit(j);
    }
  }

  /// The two outermost layers of both bodies, ascending.
  [[nodiscard]] std::vector<SurfaceParticle> surface() const {
    std::vector<SurfaceParticle> found;
    for (std::size_t i = 0; i < size(); ++i) {
      const int b = body(i), d = depth(b, {cell_[i][0], cell_[i][1], cell_[i][2]});
      if (d <= 1) found.push_back({static_cast<Index>(i), b, d == 0});
    }
    return found;
  }

 private:
  struct Brick {
    std::array<int, 3> low, size;  // cells
  };
  /// How many layers of `body` lie over a cell; negative outside.
  [[nodiscard]] int depth(int body, const std::array<int, 3>& c) const {
    const Brick& brick = body_[static_cast<std::size_t>(body)];
    int least = std::numeric_limits<int>::max();
    for (std::size_t d = 0; d < 3; ++d)
      least = std::min({least, c[d] - brick.low[d], brick.low[d] + brick.size[d] - 1 - c[d]});
    return least;
  }
  [[nodiscard]] std::size_t place(int x, int y, int z) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(extent_[2]) + static_cast<std::size_t>(z)) *
               static_cast<std::size_t>(extent_[0]) +
           static_cast<std::size_t>(x);
  }

  std::array<Brick, 2> body_;
  std::array<int, 3> extent_;  // cells of a box around both
  std::vector<Cell> cell_;     // of each particle
  std::vector<Index> at_;      // the particle in each cell of the box
};

}  // namespace across_machines
