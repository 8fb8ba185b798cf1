// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <hmps/diagnostics/energy.hpp>
#include <hmps/diagnostics/jacobian.hpp>
#include <hmps/diagnostics/monitor.hpp>
#include <string>
#include <vector>

#include "output/carried_organs.hpp"
#include "output/frames.hpp"
#include "output/measure.hpp"
#include "output/series.hpp"
#include "output/snapshots.hpp"
#include "scene/scene.hpp"
#include "simulation/simulation.hpp"

/// What is observed while the swallow runs: samples for the series, frames, pictures.
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
[[nodiscard]] hmps::JacobianStatistics volume(Simulation<S>& simulation, const Scene& scene) {
  return hmps::jacobian_statistics(
      simulation.body(simulation.gradients()), {.low = 0.98, .high = 1.02},
      [&](std::size_t i) { return scene.region[i] < 0; }, simulation.executor());
}

/// The sample of the present state for the series; `penetration` (spacings) is the largest since the previous sample.
template <class S>
[[nodiscard]] Sample observe(Simulation<S>& simulation, const Scene& scene, double penetration) {
  const auto& x = simulation.position_array();
  const auto base = mean_position(x, scene.base), centre = mean_position(x, scene.centre),
             tip = mean_position(x, scene.tip);
  const auto velocities = simulation.body(simulation.velocities());
  const double particle_volume = std::pow(scene.spacing, 3);
  const auto& execute = simulation.executor();
  const auto J = volume(simulation, scene);
  Sample sample;
  sample.time = simulation.time();
  sample.tip_angle = angle_above_horizontal(centre, tip);
  sample.base_angle = angle_above_horizontal(base, tip);
  sample.kinetic_energy = hmps::kinetic_energy(velocities, simulation.materials().density, particle_volume, execute);
  const StoredEnergy stored = simulation.stored_energy();
  sample.strain_energy = stored.strain, sample.artificial_energy = stored.artificial;
  sample.smallest_j = J.min, sample.largest_j = J.max, sample.mean_j = J.mean;
  for (std::size_t i = 0; i < velocities.size(); ++i)
    sample.largest_speed = std::max(sample.largest_speed, velocities[i].template cast<double>().norm());
  sample.contacts = static_cast<double>(simulation.contact_report().contacts);
  sample.penetration = penetration;
  return sample;
}

/// Throws `hmps::StateError`, naming the particle and its organ, once the state is meaningless.
template <class S>
void check(Simulation<S>& simulation, const Scene& scene) {
  hmps::check_state(simulation.positions(), simulation.velocities(), simulation.gradients(),
                    {.time = simulation.time(),
                     .speed_limit = simulation.materials().speed_limit,
                     .organ_name = [&](std::size_t i) { return "the " + std::string(name(scene.organ[i])); }},
                    simulation.executor());
}

/// Names the regions of the scene in `shot`, and of each particle its own. The rows of plates, which may be more than a
/// byte counts, are one region.
inline void note_regions(Snapshot& shot, const Scene& scene) {
  std::size_t body = 0;
  for (const Region& region : scene.regions)
    if (region.kind != Region::door) shot.regions.push_back(region.name), ++body;
  if (body < scene.regions.size()) shot.regions.emplace_back("H");
  for (const int region : scene.region)
    shot.region.push_back(region < 0 ? Snapshot::no_region
                                     : static_cast<std::uint8_t>(std::min(static_cast<std::size_t>(region), body)));
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
  note_regions(shot, scene);
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

/// Adds the surfaces of the organs as the particles of `shot` carry them.
inline void add_surfaces(Frames& frames, const CarriedOrgans& organs, const Snapshot& shot) {
  const auto vertices = organs.vertices(shot.positions);
  const std::array fields{examples::whole_numbers("organ", organs.organ())};
  frames.add(shot.time, examples::numbers("position", hmps::vectors(vertices)), fields, organs.triangles());
}

}  // namespace swallowing
