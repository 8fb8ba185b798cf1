// SPDX-License-Identifier: MIT
#pragma once

// The normal density Z(y) of the paper's Fig. 3, and how it varies over a wall.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <hmps/contact/metaball.hpp>
#include <hmps/contact/normal_density.hpp>
#include <string>
#include <vector>

#include "report/chart.hpp"
#include "report/table.hpp"
#include "report/text.hpp"

namespace walls {

/// The sum of metaballs at one height above a wall along its lattice.
struct Density {
  double y;             ///< distance from the outermost layer, in spacings
  double mean;          ///< Z
  double least, most;   ///< over the position along the wall
  double mean_of_sums;  ///< of the sums of which `least` and `most` are two
};

template <class Ball>
[[nodiscard]] Density density_at(double y) {
  constexpr int samples = 16, reach = 4;
  static_assert(Ball::radius < reach - 1);
  const hmps::NormalDensity<double, 3, Ball> Z(1.0);
  Density found{y, Z(y), 1e9, 0, 0};
  for (int a = 0; a < samples; ++a)
    for (int b = 0; b < samples; ++b) {
      double sum = 0;
      for (int i = -reach; i <= reach; ++i)
        for (int j = -reach; j <= reach; ++j)
          for (int k = 0; k <= reach + 1; ++k) {
            const double across = i - (a + 0.5) / samples, along = j - (b + 0.5) / samples, up = -k - y;
            const double s = (across * across + along * along + up * up) / (Ball::radius * Ball::radius);
            if (s < 1) sum += Ball::value(s);
          }
      found.least = std::min(found.least, sum);
      found.most = std::max(found.most, sum);
      found.mean_of_sums += sum / (samples * samples);
    }
  return found;
}

[[nodiscard]] inline report::Table density_table() {
  using report::places;
  report::Table table{"density", {"Metaball", "y, l0", "Z", "Least over the wall", "Most over the wall"}};
  const auto add = [&](const char* name, const std::vector<Density>& all) {
    for (const Density& at : all) {
      table.rows.push_back({name, places(at.y, 1), places(at.mean), places(at.least), places(at.most)});
      table.check(std::abs(at.mean_of_sums - at.mean) < 2e-3 * all.front().mean,
                  "density: Z of " + std::string(name) + " is the mean of the sums over the wall");
    }
  };
  std::vector<Density> paper, smooth;
  for (const double y : {-0.5, 0., 0.5, 1., 1.5, 2.}) {
    paper.push_back(density_at<hmps::PaperMetaball>(y));
    smooth.push_back(density_at<hmps::SmoothMetaball>(y));
  }
  add("paper", paper);
  add("smooth", smooth);
  return table;
}

/// Z(y) of both metaballs, each over Z(0), as the paper's Fig. 3, with the range over the wall.
inline void draw_density(const std::filesystem::path& path) {
  using report::Anchor, report::Colour;
  constexpr double left = 80, top = 50, across_all = 520, up_all = 300;
  report::Canvas canvas(860, 420);
  auto panel = report::Panel::with_large_labels(canvas, left, top, across_all, up_all);
  const auto across = report::Axis::linear(-0.5, 2.5, left, left + across_all);
  const auto up = report::Axis::linear(0, 1.3, top + up_all, top);
  canvas.text(left, 28, "The normal density of a wall", 15, panel.ink, Anchor::left, true);
  for (const double tick : {0., 0.25, 0.5, 0.75, 1., 1.25}) panel.tick_up(up(tick), report::places(tick, 2));
  for (const double y : {-0.5, 0., 0.5, 1., 1.5, 2., 2.5}) panel.tick_across(across(y), report::places(y, 1), true);
  panel.caption("distance y from the outermost layer, in spacings", 42, 12);
  double words = top + 20;
  const auto draw = [&](const char* name, const Colour& colour, const auto& at) {
    report::Points mean, least, most;
    for (int k = 0; k <= 60; ++k) {
      const Density here = at(-0.5 + 0.05 * k);
      const double unit = at(0).mean;
      mean.emplace_back(across(here.y), up(std::min(1.3, here.mean / unit)));
      least.emplace_back(across(here.y), up(std::min(1.3, here.least / unit)));
      most.emplace_back(across(here.y), up(std::min(1.3, here.most / unit)));
    }
    panel.curve(mean, colour, 2, 0);
    for (const auto& edge : {least, most}) panel.curve(edge, colour, 1, 0, {4, 3});
    for (const bool range : {false, true}) {
      canvas.line(left + across_all + 30, words - 4, left + across_all + 70, words - 4, colour, range ? 1 : 2,
                  range ? std::vector<double>{4, 3} : std::vector<double>{});
      canvas.text(left + across_all + 80, words, std::string(name) + (range ? ", range" : ", Z(y) / Z(0)"), 13,
                  panel.ink);
      words += 24;
    }
  };
  draw("paper", Colour::hex(0xc0392b), density_at<hmps::PaperMetaball>);
  draw("smooth", Colour::hex(0x2060b0), density_at<hmps::SmoothMetaball>);
  canvas.save(path);
}

}  // namespace walls
