// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "scenes/pressed_block.hpp"
#include "scenes/processor_time.hpp"
#include "walls/wall.hpp"

namespace walls {

inline constexpr double spacing = 2e-3, density = 1000, gravity = 9.81;  // m, kg/m3, m/s2
inline constexpr double young = 20e3, bulk = 1e5, viscosity = 5e-3;      // Pa, Pa, m2/s
inline constexpr double pressure = 1e3, speed = 0.1;                     // Pa and m/s, of the plate
inline constexpr int side = 6, height = 4;                               // of the block, in particles
inline constexpr double width = side * spacing;                          // m, of the block
inline constexpr double lead = 3 * spacing;  // m, before and behind the stretch of wall that is measured

/// What is not along a lattice.
enum class Part { wall, block, both };

/// A block of soft tissue on a wall: pressed by a rigid plate on its top, that slides along x, or free on an incline.
struct Scene {
  double degrees = 0;        ///< between surface and lattice, or the samples of a fit
  Made made = Made::cut;     ///< of the part below
  Part part = Part::wall;    ///< the other part is along its lattice
  int layers = 4;            ///< of a fitted wall
  double layer_spacing = 1;  ///< of a fitted wall, in spacings
  double friction = 0;
  double incline = 0;  ///< degrees; free if not zero
  bool viscous = true;
  double settled = 0.08;  ///< s, after which a free block is measured

  [[nodiscard]] bool free() const { return incline != 0; }
  [[nodiscard]] bool along_lattice() const { return degrees == 0 && made != Made::fitted; }
  /// Length in m of the stretch of wall that is measured.
  [[nodiscard]] double stretch() const { return Wall{.degrees = degrees, .made = made, .spacing = spacing}.stretch(); }
  [[nodiscard]] Wall wall() const {
    if (part == Part::block) return {.spacing = spacing};
    return {.degrees = degrees, .made = made, .spacing = spacing, .layers = layers, .layer_spacing = layer_spacing};
  }
};

/// The block, with its lower surface in z = 0 or, if along its lattice, a tenth of a spacing above.
[[nodiscard]] inline scenes::BlockOnWall block_of(const Scene& scene) {
  scenes::BlockOnWall parts;
  const double angle = scene.degrees * std::numbers::pi / 180;
  const auto add = [&](const Point& place, bool is_bottom) {
    const double z = place[2] / spacing;
    parts.add(place, is_bottom, z < 3, !scene.free() && z > height - 1);
  };
  if (scene.part != Part::wall && scene.made == Made::fitted) {
    for (const Point& place : fitted(angle, {Point::Zero(), {width, width, height * spacing}}, spacing))
      add(place, place[2] < spacing);
  } else if (scene.part != Part::wall) {
    for (const Point& place : lattice(angle, 0.13, {0, 0}, {width, width}, spacing))
      if (place[2] > 0 && place[2] < height * spacing) add(place, place[2] < spacing * std::cos(angle));
  } else {
    for (int k = 0; k < height; ++k)
      for (int j = 0; j < side; ++j)
        for (int i = 0; i < side; ++i) add(spacing * Point(i, j, k + 0.6), k == 0);
  }
  return parts;
}

[[nodiscard]] inline scenes::BlockOnWall parts_of(const Scene& scene) {
  scenes::BlockOnWall parts = block_of(scene);
  Wall wall = scene.wall();
  const double rim = 4 * spacing;
  wall.fill({-rim, -rim}, {width + rim + 2 * lead + scene.stretch(), width + rim});
  for (std::size_t i = 0; i < wall.places.size(); ++i)
    parts.add_to_wall(wall.places[i], std::binary_search(wall.skin.begin(), wall.skin.end(), i));
  return parts;
}

inline constexpr double measured = 0.08;  // s, of a free block

/// The result of a run. Means are over whole steps of the staircase; on the incline, over the time after the block has
/// settled.
struct Outcome {
  double friction = 0;      ///< mean tangential over mean normal force
  double ripple = 0;        ///< rms of the normal force about the load, over the load
  double acceleration = 0;  ///< of the free block, m/s2
  double moved = 0;         ///< of the free block, m, in `measured`
  double shaking = 0;       ///< of the free block, rms of its particles' speed, m/s
  double seconds = 0;       ///< of processor time, per step, for contact
};

/// A running scene. The plate moves to and fro, so that the work of climbing does not count as drag.
template <class Ball, class Friction>
class Slide {
 public:
  explicit Slide(const Scene& scene)
      : scene_(scene),
        stretch_(scene.stretch()),
        block_(parts_of(scene), settings(scene),
               [](auto& force, const auto& x, const auto& v) {
                 return 0.6 * std::sqrt(1 - ratio) * hmps::stable_step(force, x, v, density, {.spacing = spacing}).step;
               }),
        reference_(block_.position),
        seen_(block_.position),
        raise_(
            block_.block(hmps::vectors(reference_)),
            scene.part == Part::block && scene.made == Made::raised ? block_.parts.bottom : std::vector<hmps::Index>{},
            hmps::HalfSpace<double, 3>{Point::Zero(), -Point::UnitZ()}, spacing) {
    set_down();
  }

  [[nodiscard]] Outcome run() {
    const double settled = scene_.settled, until = settled + measured;
    double normal = 0, tangential = 0, squares = 0, shaking = 0, start_place = 0, start_speed = 0;
    int samples = 0, steps = 0;
    for (double time = 0; scene_.free() ? time < until : !back_ || way_ > lead; time += block_.dt, ++steps) {
      step(time);
      if (scene_.free() ? time < settled : way_ < lead || way_ > lead + stretch_) continue;
      if (samples++ == 0) start_place = mean(block_.position), start_speed = mean(block_.velocity);
      const Point on_wall = block_.on_wall();
      normal -= on_wall[2];
      tangential += back_ ? -on_wall[0] : on_wall[0];
      squares += std::pow(-on_wall[2] / (pressure * area) - 1, 2);
      for (std::size_t i = 0; i < count(); ++i)
        shaking += block_.velocity[i].squaredNorm() / static_cast<double>(count());
    }
    return {.friction = tangential / normal,
            .ripple = std::sqrt(squares / samples),
            .acceleration = (mean(block_.velocity) - start_speed) / (samples * block_.dt),
            .moved = mean(block_.position) - start_place,
            .shaking = std::sqrt(shaking / samples),
            .seconds = seconds_ / steps};
  }

 private:
  static constexpr double ratio = 0.05, area = width * width;

  static scenes::BlockSettings settings(const Scene& scene) {
    return {.spacing = spacing,
            .density = density,
            .young = young,
            .d1 = bulk,
            .modulus = young / 2,
            .viscosity = scene.viscous ? viscosity : 0,
            .pressure = pressure,
            .area = area,
            .friction = scene.friction,
            .ratio = ratio};
  }
  [[nodiscard]] std::size_t count() const { return block_.parts.block; }
  [[nodiscard]] double mean(const std::vector<Point>& of) const {
    double sum = 0;
    for (std::size_t i = 0; i < count(); ++i) sum += of[i][0];
    return sum / static_cast<double>(count());
  }

  /// Adds the force of contact, with the particles at the positions that contact uses.
  void touch() {
    raise_(block_.x(), block_.F(), hmps::vectors(seen_));
    block_.touch(hmps::vectors(seen_), block_.dt);
  }
  /// Moves the block to the height at which the wall carries its weight.
  void set_down() {
    double low = -0.5 * spacing, high = 1.5 * spacing;
    const double weight = density * gravity * static_cast<double>(count()) * (spacing * spacing * spacing);
    while (high - low > 1e-6 * spacing) {
      for (std::size_t i = 0; i < count(); ++i) block_.position[i] = reference_[i] + (low + high) / 2 * Point::UnitZ();
      block_.unload();
      touch();
      (-block_.on_wall()[2] > weight ? low : high) = (low + high) / 2;
    }
  }

  /// Applies the weight, or the load and the slide of the plate.
  void drive() {
    constexpr double turning = 5e-3;  // s
    const double slope = scene_.incline * std::numbers::pi / 180;
    if (scene_.free())
      for (std::size_t i = 0; i < count(); ++i)
        block_.load[i] += Point(density * gravity * Point(std::sin(slope), 0, -std::cos(slope)));
    block_.sink();
    pace_ = std::clamp(pace_ + (back_ ? -block_.dt : block_.dt) / turning, -1.0, 1.0);
    way_ += block_.dt * speed * pace_;
    back_ = back_ || way_ > lead + stretch_ + lead;
  }
  void step(double time) {
    const auto x = block_.block(block_.x()), v = block_.block(block_.v());
    block_.force(x, v, block_.block(block_.f()));
    drive();
    block_.kick(block_.dt, speed * pace_);
    block_.unload();
    const double before = scenes::processor_seconds();
    touch();
    seconds_ += scenes::processor_seconds() - before;
    block_.kick(block_.dt, speed * pace_);
    block_.drift();
    hmps::check_state(x, v, hmps::StateLimits{.time = time, .speed_limit = 10});
  }

  Scene scene_;
  double stretch_;
  scenes::PressedBlock<hmps::BondList<double, 3>, double, Ball, Friction> block_;
  std::vector<Point> reference_, seen_;
  hmps::SurfaceCorrection<double, 3> raise_;
  double pace_ = 0, way_ = 0, seconds_ = 0;
  bool back_ = false;
};

template <class Ball, class Friction>
[[nodiscard]] Outcome run(const Scene& scene) {
  return Slide<Ball, Friction>(scene).run();
}

}  // namespace walls
