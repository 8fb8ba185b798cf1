// SPDX-License-Identifier: MIT
#include "output/labels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace swallowing {

namespace {

/// The control region that is seen in each cell of a panel, where the particles are drawn over each other.
class Cover {
 public:
  Cover(const Snapshot& snapshot, const View& view, const Window& window)
      : cell_(snapshot.spacing * window.scale / cells_per_spacing),
        columns_(static_cast<std::size_t>(std::ceil(window.px(window.right) / cell_))),
        rows_(static_cast<std::size_t>(std::ceil(window.height() / cell_))),
        region_(columns_ * rows_, Snapshot::no_region) {
    for (const Ball& ball : shown_balls(snapshot, view))
      cover(window.px(ball.at[0]) / cell_, window.py(ball.at[1]) / cell_, snapshot.region[ball.particle]);
  }
  [[nodiscard]] static constexpr double cells_of_ball() { return std::numbers::pi * radius * radius; }

  /// The cells of each connected part of a region, which are then no longer there.
  [[nodiscard]] std::vector<std::vector<std::size_t>> take_parts(std::uint8_t region) {
    std::vector<std::vector<std::size_t>> parts;
    for (std::size_t cell = 0; cell < region_.size(); ++cell)
      if (region_[cell] == region) parts.push_back(take_part(cell));
    return parts;
  }

  /// The middle in pixels of the cell nearest to the mean of `part`: the mean itself may lie outside it.
  [[nodiscard]] std::array<double, 2> middle(const std::vector<std::size_t>& part) const {
    std::array<double, 2> mean{};
    for (const std::size_t cell : part)
      for (std::size_t c = 0; c < 2; ++c) mean[c] += at(cell)[c] / static_cast<double>(part.size());
    const auto distance = [&](std::size_t cell) { return std::hypot(at(cell)[0] - mean[0], at(cell)[1] - mean[1]); };
    return at(*std::min_element(part.begin(), part.end(),
                                [&](std::size_t a, std::size_t b) { return distance(a) < distance(b); }));
  }

 private:
  static constexpr int cells_per_spacing = 5;
  static constexpr double radius = cells_per_spacing * Ball::radius;  // of a ball, in cells

  void cover(double x, double y, std::uint8_t region) {
    const auto from = [](double middle) { return static_cast<std::size_t>(std::max(0., middle - radius)); };
    for (std::size_t row = from(y); row < rows_ && static_cast<double>(row) < y + radius; ++row)
      for (std::size_t column = from(x); column < columns_ && static_cast<double>(column) < x + radius; ++column)
        if (std::hypot(static_cast<double>(column) + 0.5 - x, static_cast<double>(row) + 0.5 - y) < radius)
          region_[row * columns_ + column] = region;
  }
  [[nodiscard]] std::vector<std::size_t> take_part(std::size_t first) {
    const std::uint8_t region = std::exchange(region_[first], Snapshot::no_region);
    std::vector<std::size_t> part{first};
    for (std::size_t k = 0; k < part.size(); ++k) {
      const std::size_t column = part[k] % columns_, row = part[k] / columns_;
      const auto take = [&](bool exists, std::size_t cell) {
        if (!exists || region_[cell] != region) return;
        region_[cell] = Snapshot::no_region;
        part.push_back(cell);
      };
      take(column > 0, part[k] - 1), take(column + 1 < columns_, part[k] + 1);
      take(row > 0, part[k] - columns_), take(row + 1 < rows_, part[k] + columns_);
    }
    return part;
  }
  [[nodiscard]] std::array<double, 2> at(std::size_t cell) const {
    return {(static_cast<double>(cell % columns_) + 0.5) * cell_, (static_cast<double>(cell / columns_) + 0.5) * cell_};
  }

  double cell_;  // pixels
  std::size_t columns_, rows_;
  std::vector<std::uint8_t> region_;
};

}  // namespace

std::string letter_of(const std::string& region) { return region.substr(0, region.find(' ')); }

std::vector<Label> visible_regions(const Snapshot& snapshot, const View& view, const Window& window) {
  Cover cover(snapshot, view, window);
  std::vector<Label> labels;
  for (std::size_t region = 0; region < snapshot.regions.size(); ++region) {
    const auto parts = cover.take_parts(static_cast<std::uint8_t>(region));
    std::size_t largest = 0;
    for (const auto& part : parts) largest = std::max(largest, part.size());
    for (const auto& part : parts) {
      if (4 * part.size() < largest || static_cast<double>(part.size()) < 2 * cover.cells_of_ball()) continue;
      const auto [x, y] = cover.middle(part);
      labels.push_back({letter_of(snapshot.regions[region]), x, y});
    }
  }
  return labels;
}

void draw_labels(examples::Canvas& canvas, const Snapshot& snapshot, const View& view, const Window& window) {
  constexpr double size = 17, rise = 0.36 * size;  // from the base line to the middle of a capital letter
  for (const Label& label : visible_regions(snapshot, view, window))
    canvas.text_with_halo(label.x, label.y + rise, label.letter, size, ink, {1, 1, 1}, examples::Anchor::middle, true);
}

}  // namespace swallowing
