// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "frames.hpp"
#include "measure.hpp"
#include "pictures.hpp"
#include "scene.hpp"
#include "series.hpp"
#include "simulation.hpp"
#include "summary.hpp"

/// What is looked at while the swallow runs: samples for the series, frames, pictures.
namespace swallowing {

/// Mean position (m) of a set of particles.
[[nodiscard]] inline Eigen::Vector3d mean_position(const std::vector<Eigen::Vector3d>& x,
                                                   const std::vector<hmps::Index>& particles) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const hmps::Index i : particles) sum += x[i];
  return sum / static_cast<double>(particles.size());
}

/// det F of the free particles.
template <class S>
[[nodiscard]] DetF volume(Simulation<S>& simulation, const Scene& scene) {
  DetF d{0, 0, 1e9, -1e9};
  double count = 0, within = 0;
  const auto F = simulation.gradients();
  for (std::size_t i = 0; i < scene.elastic_count; ++i) {
    if (scene.region[i] >= 0) continue;
    const auto J = static_cast<double>(hmps::determinant(F[i]));
    d.mean += J, count += 1, within += std::abs(J - 1) <= 0.02;
    d.min = std::min(d.min, J), d.max = std::max(d.max, J);
  }
  d.mean /= count;
  d.share_within_0_98_1_02 = within / count;
  return d;
}

template <class S>
[[nodiscard]] Sample observe(Simulation<S>& simulation, const Scene& scene, const Materials& materials,
                             double penetration) {
  const auto& x = simulation.position_array();
  const auto base = mean_position(x, scene.base), centre = mean_position(x, scene.centre),
             tip = mean_position(x, scene.tip);
  Sample sample;
  sample.time = simulation.time();
  sample.tip_angle = angle_above_horizontal(centre, tip);
  sample.base_angle = angle_above_horizontal(base, tip);
  const DetF J = volume(simulation, scene);
  sample.smallest_j = J.min, sample.largest_j = J.max, sample.mean_j = J.mean;
  const auto v = simulation.velocities();
  double squared = 0;
  for (std::size_t i = 0; i < scene.elastic_count; ++i) {
    const double s = v[i].template cast<double>().squaredNorm();
    squared += s;
    sample.largest_speed = std::max(sample.largest_speed, std::sqrt(s));
  }
  sample.kinetic_energy = 0.5 * materials.density * std::pow(scene.spacing, 3) * squared;
  sample.contacts = static_cast<double>(simulation.contact_report().contacts);
  sample.penetration = penetration;
  return sample;
}

/// Stops the run where it no longer means anything.
template <class S>
void check(Simulation<S>& simulation, const Scene& scene, const Materials&) {
  const auto F = simulation.gradients();
  for (std::size_t i = 0; i < scene.elastic_count; ++i) {
    const auto J = static_cast<double>(hmps::determinant(F[i]));
    if (!(J > 0))
      throw hmps::StateError(hmps::message("at ", simulation.time(), " s particle ", i, " of the ",
                                           name(scene.organ[i]), " has det F = ", J));
  }
}

template <class S>
[[nodiscard]] Snapshot snapshot(Simulation<S>& simulation, const Scene& scene) {
  Snapshot shot;
  shot.time = simulation.time();
  shot.spacing = scene.spacing;
  const auto& x = simulation.position_array();
  for (std::size_t i = 0; i < x.size(); ++i) {
    shot.positions.push_back({static_cast<float>(x[i][0]), static_cast<float>(x[i][1]), static_cast<float>(x[i][2])});
    shot.organ.push_back(static_cast<std::uint8_t>(scene.organ[i]));
    shot.role.push_back(i >= scene.elastic_count ? Role::plate : scene.region[i] >= 0 ? Role::control : Role::free);
  }
  for (int o = 0; o < organ_count; ++o) shot.organs.emplace_back(name(static_cast<Organ>(o)));
  const auto centre = mean_position(x, scene.centre), tip = mean_position(x, scene.tip);
  shot.centre = {centre[0], centre[1], centre[2]};
  shot.tip = {tip[0], tip[1], tip[2]};
  shot.tip_angle = angle_above_horizontal(centre, tip);
  return shot;
}

template <class S>
void add_frame(Frames& frames, Simulation<S>& simulation, const Scene& scene) {
  const auto& x = simulation.position_array();
  std::vector<float> position, velocity, displacement, jacobian;
  std::vector<std::int32_t> organ, region;
  const auto v = simulation.velocities();
  const auto F = simulation.gradients();
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      position.push_back(static_cast<float>(x[i][c]));
      velocity.push_back(static_cast<float>(v(i, c)));
      displacement.push_back(static_cast<float>(x[i][c] - scene.reference[i][c]));
    }
    jacobian.push_back(static_cast<float>(hmps::determinant(F[i])));
    organ.push_back(static_cast<std::int32_t>(scene.organ[i]));
    region.push_back(scene.region[i]);
  }
  using examples::Field;
  const std::array<Field, 5> fields{Field::of("velocity", 3, "Float32", velocity),
                                    Field::of("displacement", 3, "Float32", displacement),
                                    Field::of("J", 1, "Float32", jacobian), Field::of("organ", 1, "Int32", organ),
                                    Field::of("region", 1, "Int32", region)};
  frames.add(simulation.time(), Field::of("position", 3, "Float32", position), fields);
}

}  // namespace swallowing
