// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <functional>
#include <hmps/motion/csv.hpp>
#include <hmps/motion/keyframes.hpp>
#include <hmps/motion/pose.hpp>
#include <hmps/motion/rigid_motion.hpp>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "../../common/error.hpp"
#include "scene/regions.hpp"
#include "scene/rows.hpp"

/// The motion model of sections 3.2 to 3.6 of the paper, from the CSV files of a data folder.
namespace swallowing {

/// The pose (m) of a control region at a time (s).
using RegionMotion = std::function<hmps::Pose<double, 3>(double)>;

namespace detail {
/// Rises from 0 at s = 0 to 1 at s = 1, with zero slope at both ends.
[[nodiscard]] inline double smooth(double s) {
  s = std::clamp(s, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}
}  // namespace detail

/// Region H over its height: rows of plates that turn inwards like doors, in one or two stages. The levels are those of
/// constrictors.csv, interpolated linearly.
struct Constrictors {
  /// z in mm; angle in degrees, start and duration in s of the first stage, then of the second, which adds to it;
  /// release and end in s; the share of the angle left at the end.
  Rows<10> levels;
  [[nodiscard]] double bottom() const { return levels.rows.front()[0]; }
  [[nodiscard]] double top() const { return levels.rows.back()[0]; }
  /// The angle in degrees at height `z` (mm) and time `t` (s).
  [[nodiscard]] double angle(double z, double t) const {
    const auto [_, angle, start, duration, further, later, lasting, release, end, opened] = levels(z);
    return (angle * detail::smooth((t - start) / duration) + further * detail::smooth((t - later) / lasting)) *
           (1 - (1 - opened) * detail::smooth((t - release) / (end - release)));
  }
};

namespace detail {

/// The rows of `table` whose first column is `region`.
[[nodiscard]] inline hmps::Table rows_of(const hmps::Table& table, int region) {
  hmps::Table part{table.source, table.names, {}, {}};
  for (std::size_t row = 0; row < table.rows(); ++row)
    if (table(row, table.column("region")) == region) {
      for (std::size_t c = 0; c < table.columns(); ++c) part.values.push_back(table(row, c));
      part.lines.push_back(table.lines[row]);
    }
  examples::require(part.rows() > 0, table.source, " has no row for region ", region);
  return part;
}

}  // namespace detail

/// Reads constrictors.csv, which also determines the shape of the plates.
[[nodiscard]] inline Constrictors read_constrictors(const std::filesystem::path& folder) {
  const auto table = hmps::read_csv((folder / "constrictors.csv").string());
  constexpr std::array columns{"z",     "angle",   "start",   "duration", "further",
                               "later", "lasting", "release", "end",      "opened"};
  Constrictors constrictors;
  auto& rows = constrictors.levels.rows;
  for (std::size_t r = 0; r < table.rows(); ++r) {
    std::array<double, columns.size()> row;
    for (std::size_t c = 0; c < columns.size(); ++c) row[c] = table(r, table.column(columns[c]));
    const auto [z, _, start, duration, further, later, lasting, release, end, opened] = row;
    examples::require((rows.empty() || rows.back()[0] < z) && duration > 0 && lasting > 0 &&
                          std::max(start + duration, later + lasting) < release && release < end,
                      table.source, " line ", table.lines[r],
                      ": a level needs a z above that of the row before, positive durations, and both stages to end "
                      "before release, and release before end");
    rows.push_back(row);
  }
  examples::require(rows.size() > 1, table.source, " needs at least two levels");
  return constrictors;
}

/// The prescribed motion of every control region.
class Motion {
 public:
  /// Reads the folder. Throws `hmps::InputError`, with file and line, if it is malformed.
  explicit Motion(const std::filesystem::path& folder)
      : hyoid_(track(folder, "hyoid")), larynx_(track(folder, "larynx")), constrictors_(read_constrictors(folder)) {
    const auto follow = hmps::read_csv((folder / "regions.csv").string());
    for (const char* file : {"tongue.csv", "soft_palate.csv", "larynx.csv", "epiglottis.csv"}) {
      const auto table = hmps::read_csv((folder / file).string());
      const bool sideways = table.has("medial");
      std::vector<int> ids;
      for (std::size_t r = 0; r < table.rows(); ++r) {
        const int id = static_cast<int>(table(r, table.column("region")));
        if (std::find(ids.begin(), ids.end(), id) == ids.end()) ids.push_back(id);
      }
      for (const int id : ids) {
        const auto part = detail::rows_of(table, id);
        const auto share = detail::rows_of(follow, id);
        moved_.push_back(
            {id, share(0, share.column("hyoid")), share(0, share.column("larynx")),
             1e-3 * hmps::Vector<double, 3>(share(0, share.column("pivot_x")), 0, share(0, share.column("pivot_z"))),
             hmps::keyframes<3>(part, {"posterior", "superior", sideways ? "medial" : "turn"}), sideways});
      }
    }
  }

  /// The pose of `region` at time `t` (s).
  [[nodiscard]] hmps::Pose<double, 3> operator()(const Region& region, double t) const {
    using Vector = hmps::Vector<double, 3>;
    hmps::Pose<double, 3> pose;
    const Vector placement = region.placement * detail::smooth(t / conform);
    if (region.kind == Region::fixed) {
      pose.translation = placement;
      return pose;
    }
    if (region.kind == Region::door) {
      const double angle = constrictors_.angle(region.height, t) * std::numbers::pi / 180;
      pose.pivot = 1e-3 * Vector(hinge_x, region.side * hinge_y, 0);
      pose.rotation = hmps::rotation<double>(Vector(0, 0, region.side * angle));
      pose.translation = pose.rotation * placement;  // It turns with the door.
      return pose;
    }
    for (const auto& m : moved_)
      if (m.id == region.number) {
        const Vector own = m.own.value(t);
        pose.pivot = m.pivot;
        pose.translation = m.hyoid * hyoid(t) + m.larynx * larynx(t) + 1e-3 * Vector(own[0], 0, own[1]);
        if (m.sideways)
          pose.translation[1] -= 1e-3 * region.side * own[2];
        else
          pose.rotation = hmps::rotation<double>(Vector(0, own[2] * std::numbers::pi / 180, 0));
        pose.translation += pose.rotation * placement;  // It turns with the region.
        return pose;
      }
    throw hmps::InputError(examples::message("no motion is given for region ", region.name));
  }

  /// Displacement (m) of the hyoid bone and of the larynx from rest at time `t`.
  [[nodiscard]] hmps::Vector<double, 3> hyoid(double t) const { return displacement(hyoid_, t); }
  [[nodiscard]] hmps::Vector<double, 3> larynx(double t) const { return displacement(larynx_, t); }

 private:
  static constexpr double hinge_x = 12.8;  ///< mm, calibrated
  static constexpr double hinge_y = 4;     ///< mm
  static constexpr double conform = 0.5;   ///< s, in which the body takes the shape from which the swallow starts

  struct Moved {
    int id;
    double hyoid, larynx;
    hmps::Vector<double, 3> pivot;
    hmps::Keyframes<3> own;
    bool sideways;
  };

  [[nodiscard]] static hmps::Keyframes<2> track(const std::filesystem::path& folder, const std::string& what) {
    const auto table = hmps::read_csv((folder / "larynx_hyoid_track.csv").string());
    return hmps::keyframes<2>(table, {what + "_anterior", what + "_superior"}, 1e-3);
  }
  [[nodiscard]] static hmps::Vector<double, 3> displacement(const hmps::Keyframes<2>& keys, double t) {
    const auto d = keys.value(t);
    return {-d[0], 0, d[1]};
  }
  hmps::Keyframes<2> hyoid_, larynx_;
  Constrictors constrictors_;
  std::vector<Moved> moved_;
};

}  // namespace swallowing
