// SPDX-License-Identifier: MIT
#include "output/model.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "output/labels.hpp"
#include "output/panels.hpp"
#include "scene/organs.hpp"

namespace swallowing {

namespace {

using examples::Canvas;

/// One panel: the organs that it shows, from where they are seen (see `seen_from`), and what is written above.
struct Part {
  std::string words, figure;
  std::vector<Organ> organs;
  double left, above;
  bool half = false;  ///< only the right half, from inside
};

[[nodiscard]] View view_of(const Snapshot& s, const Part& part) {
  const auto shows = [part](const Snapshot& shot, std::size_t i) {
    return (!part.half || shot.positions[i][1] >= 0) &&
           std::any_of(part.organs.begin(), part.organs.end(),
                       [&](Organ organ) { return shot.organ_of(i) == name(organ); });
  };
  // The particle nearest to the viewer does not fade.
  constexpr double beyond = 1;  // m, more than any distance in the body
  double in_front = 0;
  const auto distance = seen_from(part.left, part.above, {}, beyond);
  for (std::size_t i = 0; i < s.positions.size(); ++i)
    if (shows(s, i)) in_front = std::max(in_front, beyond - distance(s.positions[i])[2]);
  return {.project = seen_from(part.left, part.above, {}, in_front), .shows = shows, .cuts = false};
}

/// The window of a grid's panels that holds all that the view shows.
[[nodiscard]] Window window_of(const Snapshot& s, const View& view, const Grid& grid) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::array lower{infinite, infinite}, upper{-infinite, -infinite};
  for (const Ball& ball : shown_balls(s, view))
    for (std::size_t c = 0; c < 2; ++c)
      lower[c] = std::min(lower[c], ball.at[c]), upper[c] = std::max(upper[c], ball.at[c]);
  if (lower[0] > upper[0]) lower = {-0.1, -0.1}, upper = {0.1, 0.1};  // nothing is shown
  return Window::holding(grid.width, grid.height, lower, upper);
}

}  // namespace

std::set<std::string> draw_model(const std::filesystem::path& path, const Snapshot& at_rest, const std::string& title) {
  const std::vector<Part> parts{
      {"Tongue, from the front", "Fig. 8", {Organ::tongue}, 140, 40},
      {"Tongue, from behind", "Fig. 8", {Organ::tongue}, 40, 5},
      {"Soft palate, from behind", "", {Organ::soft_palate}, 40, 25},
      {"Larynx and epiglottis", "Fig. 9", {Organ::larynx, Organ::epiglottis}, 40, 25},
      {"The same, right half", "Fig. 9", {Organ::larynx, Organ::epiglottis}, 75, 15, true},
      {"Pharynx, from behind",
       "Fig. 10",
       {Organ::pharynx, Organ::vallecula, Organ::esophagus, Organ::vertebrae, Organ::constrictors},
       35,
       15}};
  Grid grid{.title = title, .columns = 4, .width = 430, .height = 560};
  std::set<std::string> letters;
  View half = from_midsagittal_plane();
  half.darkens = false;
  const auto add = [&](const std::string& words, const std::string& figure, const View& view, bool labels) {
    const Window window = window_of(at_rest, view, grid);
    if (labels)
      for (const Label& label : visible_regions(at_rest, view, window)) letters.insert(label.letter);
    grid.panels.push_back({words, figure, [&at_rest, view, window, labels](Canvas& canvas) {
                             draw_particles(canvas, at_rest, view, window);
                             if (labels) draw_labels(canvas, at_rest, view, window);
                             draw_scale(canvas, window);
                           }});
  };
  add("All organs, right half", "Fig. 7", half, false);
  for (const Part& part : parts) add(part.words, part.figure, view_of(at_rest, part), true);
  grid.draw(path, [&](Canvas& canvas) {
    const auto [x, y] = grid.corner(grid.panels.size());
    draw_legend(canvas, x + 30, y + 76, at_rest, true);
  });
  return letters;
}

}  // namespace swallowing
