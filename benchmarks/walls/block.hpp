// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <hmps/hmps.hpp>
#include <vector>

#include "wall.hpp"

namespace walls {

inline constexpr double spacing = 2e-3, density = 1000, gravity = 9.81;  // m, kg/m3, m/s2
inline constexpr double young = 20e3, bulk = 1e5, viscosity = 5e-3;      // Pa, Pa, m2/s
inline constexpr double pressure = 1e3, speed = 0.1;                     // Pa and m/s, of the plate
inline constexpr int side = 6, height = 4;                               // of the block, in particles

/// A block of soft tissue on a wall: pressed by a rigid plate on its top, that slides along x, or free on an incline.
struct Scene {
  double degrees = 0;   ///< between surface and lattice
  bool raised = false;  ///< contact sees the skin that is cut raised to the surface
  double friction = 0;
  double incline = 0;  ///< degrees; free if not zero
  bool soft = false;   ///< it is the block that is cut, not the wall
};

/// The particles of a scene, those of the block first.
struct Bodies {
  std::vector<Point> reference = {};
  std::size_t count = 0;                               ///< of the block
  std::vector<hmps::Index> bottom, lower, plate = {};  ///< of the block: slaves, masters, what is led
  std::vector<hmps::Index> skin, masters = {};         ///< of the wall
};
[[nodiscard]] inline Bodies bodies(const Scene& scene, const Wall& wall) {
  Bodies all;
  const auto add = [&](const Point& place, bool is_bottom, bool is_lower, bool is_top) {
    const auto index = static_cast<hmps::Index>(all.reference.size());
    if (is_bottom) all.bottom.push_back(index);
    if (is_lower) all.lower.push_back(index);
    if (is_top && scene.incline == 0) all.plate.push_back(index);
    all.reference.push_back(place);
  };
  if (scene.soft) {
    const double width = side * spacing, angle = scene.degrees * std::numbers::pi / 180;
    for (const Point& place : lattice(angle, 0.13, {0, 0}, {width, width}, spacing))
      if (const double z = place[2] / spacing; z > 0 && z < height) add(place, z < std::cos(angle), z<3, z> height - 1);
  } else {
    for (int k = 0; k < height; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) add(spacing * Point(i, j, k + 0.6), k == 0, k < 3, k == height - 1);
  }
  all.count = all.reference.size();
  for (const hmps::Index i : wall.skin) all.skin.push_back(static_cast<hmps::Index>(i + all.count));
  for (const hmps::Index i : wall.all) all.masters.push_back(static_cast<hmps::Index>(i + all.count));
  all.reference.insert(all.reference.end(), wall.places.begin(), wall.places.end());
  return all;
}

/// What a run gave. Means are over whole steps of the stairs, on the incline over the second half.
struct Outcome {
  double friction = 0;      ///< mean tangential over mean normal force
  double ripple = 0;        ///< rms of the normal force about the load, over the load
  double acceleration = 0;  ///< of the free block, m/s2
  double moved = 0;         ///< of the free block, m
  double shaking = 0;       ///< of the free block, rms of its particles' speed, m/s
  double seconds = 0;       ///< of the processor, per step, for the contact
};

[[nodiscard]] inline double processor_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

template <class Ball, class Friction>
[[nodiscard]] Outcome run(const Scene& scene) {
  const bool free = scene.incline != 0;
  const Wall cut{.degrees = scene.degrees, .spacing = spacing};
  Wall wall{.degrees = scene.soft ? 0 : scene.degrees, .raised = scene.raised && !scene.soft, .spacing = spacing};
  const double lead = 3 * spacing, rim = 4 * spacing, width = side * spacing, measured = cut.stretch();
  wall.fill({-rim, -rim}, {width + rim + 2 * lead + measured, width + rim});
  const auto [reference, count, bottom, lower, plate, skin, masters] = bodies(scene, wall);
  auto position = reference, places = reference;
  std::vector<Point> velocity(position.size(), Point::Zero()), load = velocity;
  std::vector<hmps::Matrix<double, 3>> gradient(position.size(), hmps::Matrix<double, 3>::Identity());
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto F = hmps::matrices(gradient);
  const auto block = [count = count](const auto& view) { return view.part(0, count); };

  const hmps::BondList<double, 3> bonds(block(hmps::vectors(reference)), {.spacing = spacing});
  auto force =
      hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(young, bulk)),
                           hmps::artificial(young / 2), hmps::viscous(density, viscosity), hmps::record(block(F)));
  constexpr double ratio = 0.05;
  const double dt =
      0.6 * std::sqrt(1 - ratio) * hmps::stable_step(force, block(x), block(v), density, {.spacing = spacing}).step;
  hmps::MetaballContact<double, 3, Ball, Friction> contact(
      {.spacing = spacing,
       .density = density,
       .friction = scene.friction,
       .stiffness = hmps::PenaltyStiffness::fixed(ratio * density / (dt * dt))});
  const auto below = contact.add_organ({"wall", skin, masters, [](hmps::Index) { return true; }});
  const auto above = contact.add_organ({"block", bottom, lower});
  const auto pair = contact.add_pair(below, above);

  // What contact sees.
  const hmps::HalfSpace<double, 3> above_surface{Point::Zero(), -Point::UnitZ()};
  const std::vector<hmps::Index> none;
  const hmps::SurfaceCorrection<double, 3> raise(block(hmps::vectors(reference)),
                                                 scene.soft && scene.raised ? bottom : none, above_surface, spacing);
  const auto touch = [&] {
    raise(x, F, hmps::vectors(places));
    (void)contact(hmps::vectors(places), v, F, dt, f);
  };

  // The block starts where the wall bears its weight.
  const double volume = spacing * spacing * spacing, area = width * width;
  const auto clear = [&] { std::fill(load.begin(), load.end(), Point::Zero()); };
  double low = -0.5 * spacing, high = 1.5 * spacing;
  const auto lift_to = [&](double up) {
    for (std::size_t i = 0; i < count; ++i) position[i] = reference[i] + up * Point::UnitZ();
  };
  while (high - low > 1e-6 * spacing) {
    lift_to((low + high) / 2);
    clear();
    touch();
    (-contact.force_on_first(pair)[2] > density * gravity * static_cast<double>(count) * volume ? low : high) =
        (low + high) / 2;
  }

  // Weight, or load and slide of the plate, which sinks as the block lets it. The plate goes to and fro, so that what
  // climbing takes is not counted as drag.
  const double slope = scene.incline * std::numbers::pi / 180;
  const Point weight = free ? Point(density * gravity * Point(std::sin(slope), 0, -std::cos(slope))) : Point(0, 0, 0);
  constexpr double settled = 0.08, until = 0.16, turning = 5e-3;  // s
  double sinking = 0, pace = 0, way = 0;
  const auto lead_plate = [&] {
    for (const hmps::Index i : plate) velocity[i] = Point(speed * pace, 0, sinking);
  };
  const auto mean = [&](const std::vector<Point>& of) {
    double sum = 0;
    for (std::size_t i = 0; i < count; ++i) sum += of[i][0];
    return sum / static_cast<double>(count);
  };
  double normal = 0, tangential = 0, squares = 0, shaking = 0, seconds = 0, start_place = 0, start_speed = 0;
  int samples = 0, steps = 0;
  bool back = false;
  for (double time = 0; free ? time < until : !back || way > lead; time += dt, ++steps) {
    force(block(x), block(v), block(f));
    for (std::size_t i = 0; i < count; ++i) load[i] += weight;
    double lift = -pressure * area;
    for (const hmps::Index i : plate) lift += load[i][2] * volume;
    if (!plate.empty()) sinking += dt * lift / (static_cast<double>(plate.size()) * volume * density);
    pace = std::clamp(pace + (back ? -dt : dt) / turning, -1.0, 1.0);
    way += dt * speed * pace;
    back = back || way > lead + measured + lead;
    hmps::kick(block(v), block(f), density, dt);
    lead_plate();
    clear();
    const double before = processor_seconds();
    touch();
    seconds += processor_seconds() - before;
    hmps::kick(block(v), block(f), density, dt);
    lead_plate();
    hmps::drift(block(x), block(v), dt);
    hmps::check_state(block(x), block(v), hmps::StateLimits{.time = time, .speed_limit = 10});
    if (free ? time < settled : way < lead || way > lead + measured) continue;
    if (samples++ == 0) start_place = mean(position), start_speed = mean(velocity);
    const Point on_wall = contact.force_on_first(pair);
    normal -= on_wall[2];
    tangential += back ? -on_wall[0] : on_wall[0];
    squares += std::pow(-on_wall[2] / (pressure * area) - 1, 2);
    for (std::size_t i = 0; i < count; ++i) shaking += velocity[i].squaredNorm() / static_cast<double>(count);
  }
  return {.friction = tangential / normal,
          .ripple = std::sqrt(squares / samples),
          .acceleration = (mean(velocity) - start_speed) / (samples * dt),
          .moved = mean(position) - start_place,
          .shaking = std::sqrt(shaking / samples),
          .seconds = seconds / steps};
}

}  // namespace walls
