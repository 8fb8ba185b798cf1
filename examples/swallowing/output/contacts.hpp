// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "output/lumen.hpp"
#include "output/observe.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

/// The contents of contacts.csv: how organs act on each other and how the epiglottis lies, from which the mechanisms of
/// section 3.5 of the paper can be told apart.
namespace swallowing {

/// The organs that may turn the epiglottis, in the order of the columns `moment_...`.
inline constexpr std::array turning{Organ::tongue, Organ::pharynx, Organ::larynx, Organ::vallecula};

/// The name of an organ as part of a column name.
[[nodiscard]] inline std::string column_name(Organ organ) {
  std::string text(name(organ));
  std::replace(text.begin(), text.end(), ' ', '_');
  return text;
}
[[nodiscard]] inline std::string column_name(const ContactPair& pair) {
  return column_name(pair.first) + '-' + column_name(pair.second);
}

/// The first line of contacts.csv.
[[nodiscard]] inline std::string contacts_header(const Scene& scene) {
  std::string header =
      "time,centre_height,tip_height,leaf_to_larynx,glottis,tongue_to_wall,width_upper,width_middle,width_lower,"
      "open_upper,open_middle,open_lower";
  for (const Organ organ : turning) header += ",moment_" + column_name(organ);
  for (const ContactPair& pair : scene.contacts)
    for (const char* what : {"area", "normal", "tangential"}) header += ',' + column_name(pair) + '_' + what;
  return header;
}

/// A row of contacts.csv for the present state and the contact of the previous step. Heights, gaps and widths are in
/// mm, open areas in mm2. Moments are in mN m, about the middle of the leaf, of the forces that press on its upper
/// half; a positive moment turns the tip backwards and down. For each pair of organs: the area in mm2 that touches, as
/// the mean of the areas that the touching slaves of both organs cover at rest, and the sums in N of the normal and of
/// the friction forces on them.
template <class S>
[[nodiscard]] std::vector<double> observe_contacts(Simulation<S>& simulation, const Scene& scene) {
  const auto& x = simulation.position_array();
  const Eigen::Vector3d middle = mean_position(x, scene.centre), tip = mean_position(x, scene.tip),
                        tipward = tip - middle;
  struct Load {
    double touching = 0, normal = 0, tangential = 0;
  };
  std::vector<Load> loads(scene.contacts.size());
  std::array<double, turning.size()> moments{};
  simulation.for_each_touch([&](const hmps::Touch<3>& touch) {
    const ContactPair& pair = scene.contacts[touch.pair];
    Load& load = loads[touch.pair];
    const double normal = touch.force.dot(touch.normal);
    load.touching += 1;
    load.normal += normal;
    load.tangential += (touch.force - normal * touch.normal).norm();
    const Eigen::Vector3d arm = x[touch.slave] - middle;
    if (pair.first != Organ::epiglottis || arm.dot(tipward) <= 0) return;
    const auto by = std::find(turning.begin(), turning.end(), pair.second);
    if (by == turning.end()) return;
    const double sign = touch.slave_is_first ? 1 : -1;  // on the leaf, as slave or as wall
    moments[static_cast<std::size_t>(by - turning.begin())] += sign * 1e3 * arm.cross(touch.force)[1];
  });
  std::vector<double> row{simulation.time(),
                          1e3 * middle[2],
                          1e3 * tip[2],
                          1e3 * leaf_to_larynx(scene, x, middle, tipward),
                          1e3 * glottis(scene, x),
                          1e3 * tongue_to_wall(scene, x)};
  for (const double height : observed_heights) row.push_back(1e3 * channel_width(scene, x, height));
  for (const double height : observed_heights) row.push_back(1e6 * open_area(scene, x, height));
  row.insert(row.end(), moments.begin(), moments.end());
  for (const Load& load : loads) {
    row.push_back(load.touching / 2 * 1e6 * scene.spacing * scene.spacing);
    row.push_back(load.normal);
    row.push_back(load.tangential);
  }
  return row;
}

}  // namespace swallowing
