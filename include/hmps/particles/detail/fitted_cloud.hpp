// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/wall_layers.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/detail/fitted_field.hpp"
#include "hmps/particles/support.hpp"
#include "hmps/search/detail/grid.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// The particles of a `FittedField` while they are fitted: spread over the layers by volume, then pushed apart within
/// them.
template <int D>
class FittedCloud {
 public:
  using Point = Vector<double, D>;
  using Field = FittedField<D>;

  struct Particle {
    Point place;
    Point moved = Point::Zero();  // in the last iteration
    Point push = Point::Zero();
    Point safe = Point::Zero();  // its last place in the body where the body was thick enough
    // The results of the last `look`, and its place.
    Point seen = Point::Zero(), slope = Point::Zero();
    double depth = 0;
    Layering layers;
  };

  /// Walls with layers closer than `thinnest` (m) get no particles.
  FittedCloud(const Field& field, double thinnest) : field_(field), thinnest_(thinnest) {}

  [[nodiscard]] const std::vector<Particle>& particles() const { return particles_; }

  /// Puts a particle wherever a volume of spacing^D of the same layer has been passed along the samples.
  void seed(const AnyExecutor& execute) {
    const auto& samples = field_.samples();
    constexpr int most = most_layers;
    std::vector<Parts> parts(samples.size());
    guarded(execute)(samples.size(), [&](std::size_t k) { parts[k] = parts_of(samples[k]); });
    const double share = std::pow(field_.spacing(), D);
    std::array<std::array<double, std::size_t{most + 1}>, 2> passed;  // for each side, so that both get their share
    for (auto& of_side : passed) of_side.fill(0.5);
    for (std::size_t k = 0; k < samples.size(); ++k) {
      const double first = static_cast<double>(parts[k].first);
      for (int part = 0; part < (parts[k].layer < 0 ? 0 : 2); ++part) {
        const int layer = std::min(parts[k].layer + part, most);
        double& sum = passed[parts[k].side][static_cast<std::size_t>(layer)];
        sum += (part == 0 ? first : 1 - first) * samples[k].volume / share;
        if (sum < 1) continue;
        sum -= 1;
        particles_.push_back(in_layer(samples[k].place, layer));
      }
    }
    require(particles_.size() < std::numeric_limits<Index>::max(), "hmps: the shape holds ", particles_.size(),
            " particles, more than a 32-bit index can address; give a larger spacing");
  }

  /// One iteration, with the share `left` of all iterations still to go. Returns the longest move in m.
  double iterate(int iteration, double left, const AnyExecutor& execute) {
    if (iteration % between_looks == 0) {
      guarded(execute)(particles_.size(), [&](std::size_t i) { look(particles_[i]); });
      find_neighbours(execute);
    }
    guarded(execute)(particles_.size(), [&](std::size_t i) { push(i); });
    const double l0 = field_.spacing(), most = 0.2 * l0 * left, gain = 0.1 * l0 * std::min(1.0, 2 * left);
    guarded(execute)(particles_.size(), [&](std::size_t i) {
      Particle& p = particles_[i];
      p.moved = 0.8 * p.moved + gain * p.push;
      const double size = p.moved.norm();
      if (size > most) p.moved *= most / size;
      p.place += p.moved;
      level(p);
    });
    return reduce(
        particles_.size(), 0.0, [&](std::size_t i) { return particles_[i].moved.norm(); },
        [](double a, double b) { return std::max(a, b); }, execute);
  }

  /// Moves all particles exactly to the middle of their layers.
  void settle(const AnyExecutor& execute) {
    constexpr int most_corrections = 20;
    guarded(execute)(particles_.size(), [&](std::size_t i) {
      Particle& p = particles_[i];
      for (int k = 0; k < most_corrections; ++k) look(p), level(p);
      look(p);
      if (!(p.depth > 0)) go_back(p), look(p);
    });
  }

  /// Removes particles until each has at least the share `least` of the support in a full lattice.
  void remove_weak(double least) {
    if (particles_.empty()) return;
    const double l0 = field_.spacing();
    std::vector<Point> places;
    for (const Particle& p : particles_) places.push_back(p.place);
    const auto points = vectors(std::as_const(places));
    const SupportSettings settings{.spacing = l0, .threshold = least * full_support<D>(paper_radius_ratio)};
    const Supports<const double, D, EveryBond> supports(points, settings, EveryBond{});
    const auto present = without_weak(supports, places.size(), settings.threshold, KeepNone{});
    std::size_t left = 0;
    for (std::size_t i = 0; i < particles_.size(); ++i)
      if (present[i]) particles_[left++] = particles_[i];
    if (left == 0) fail_of_weakness();
    particles_.resize(left);
  }

 private:
  static constexpr int between_looks = 8;
  static constexpr double range = 1.6;        // of the repulsion in spacings
  static constexpr double least_slope = 0.3;  // squared; a smaller one means a middle surface

  /// How a sample is shared by two layers, the second of which lies deeper.
  struct Parts {
    int layer = -1;   // the first; -1: the wall is too thin for particles
    float first = 1;  // share of the volume
    unsigned char side = 0;
  };

  /// The diameter (m) of the largest ball in the body about the deepest particle, to a few hundredths of a spacing.
  [[nodiscard]] double thickest() const {
    const auto shallower = [](const Particle& a, const Particle& b) { return a.depth < b.depth; };
    Point centre = std::max_element(particles_.begin(), particles_.end(), shallower)->place;
    double depth = -field_(centre);
    const int directions = D == 2 ? 9 : 27;
    for (double step = field_.spacing() / 2; step > field_.spacing() / 100; step /= 2)
      for (int k = 0; k < directions; ++k) {
        Point next = centre;
        for (int c = 0, digits = k; c < D; ++c, digits /= 3) next[c] += step * (digits % 3 - 1);
        if (const double there = -field_(next); there > depth + 0.01 * step) centre = next, depth = there, k = -1;
      }
    return 2 * depth;
  }

  [[noreturn]] void fail_of_weakness() const {
    const double l0 = field_.spacing();
    // Two layers have support, in a needle too. At half of its diameter, a ball would get a few particles without.
    double finer = std::min(thickest() / 2.3, 0.9 * l0);
    bool single = true;
    for (const Particle& p : particles_) {
      finer = std::min(finer, p.layers.thickness / p.layers.count);
      single = single && !p.layers.thick && p.layers.count == 1;
    }
    throw InputError(message(
        "hmps: none of the ", particles_.size(), " particles that fit into the body at a spacing of ", l0,
        " m has enough neighbours to hold it",
        single ? ": they form a single layer, which least_layers = 1 allows but which has no support "
                 "across it; give a spacing of at most "
               : "; give a spacing of at most ",
        finer,
        single ? " m, for two layers, or keep one layer with least_support = 0" : " m, or a lower least_support"));
  }

  /// A sample that reaches across the face between two layers belongs to both. Otherwise, in a wall along the grid of
  /// samples, some layers would get whole rows of samples too many.
  [[nodiscard]] Parts parts_of(const Sample<D>& sample) const {
    const Layering here = field_.layering(sample.place);
    if (here.spacing < thinnest_) return {};
    const double edge = field_.spacing() / Field::samples_per_spacing, full = std::pow(edge, D);
    const double half = 0.5 * edge * std::min(1.0, sample.volume / full), depth = -field_(sample.place);
    const int layer = here.layer(depth - half), last = here.layer(depth + half);
    const auto side = static_cast<unsigned char>(here.side);
    if (last == layer) return {layer, 1, side};
    const double share = ((layer + 1) * here.spacing - depth + half) / (2 * half);
    return {layer, static_cast<float>(std::clamp(share, 0.0, 1.0)), side};
  }

  [[nodiscard]] Particle in_layer(const Point& place, int layer) const {
    Particle particle;
    particle.place = particle.safe = place;
    look(particle);
    const double slope = particle.slope.squaredNorm();
    // Below the counted layers lies the bulk, where particles stay in place.
    if (layer < most_layers && layer != particle.layers.layer(particle.depth) && slope > least_slope)
      particle.place += (particle.depth - particle.layers.level(layer)) / slope * particle.slope;
    return particle;
  }

  /// Evaluates depth, slope and layers again. A particle that has moved to where the body is too thin goes back.
  void look(Particle& p) const {
    p.layers = field_.layering(p.place);
    if (p.layers.spacing < thinnest_) go_back(p);
    p.seen = p.place;
    p.depth = -field_(p.place);
    p.slope = field_.gradient(p.place);
    if (p.depth > 0) p.safe = p.place;
  }

  void go_back(Particle& p) const {
    p.place = p.safe;
    p.moved.setZero();
    p.layers = field_.layering(p.place);
  }

  /// Moves a particle to the middle of its layer, as firmly as the layer holds it, by the surface of the last `look`.
  static void level(Particle& p) {
    const double slope = p.slope.squaredNorm();
    if (slope < least_slope) return;
    const double depth = p.depth - p.slope.dot(p.place - p.seen);
    const int layer = p.layers.layer(depth);
    const double hold = p.layers.hold(layer);
    p.place += hold * (depth - p.layers.level(layer)) / slope * p.slope;
    p.moved -= hold * p.moved.dot(p.slope) / slope * p.slope;
  }

  void find_neighbours(const AnyExecutor& execute) {
    const double reach = (range + 0.4) * field_.spacing();
    near_.resize(particles_.size());
    grid_.build(particles_.size(), reach / 2, [&](std::size_t i) { return particles_[i].place; });
    guarded(execute)(particles_.size(), [&](std::size_t i) {
      near_[i].clear();
      grid_.visit(particles_[i].place, reach, [&](Index j, double) {
        if (j != i) near_[i].push_back(j);
      });
    });
  }

  void push(std::size_t i) {
    const double reach = range * field_.spacing();
    Point sum = Point::Zero();
    for (const Index j : near_[i]) {
      const Point r = particles_[i].place - particles_[j].place;
      const double distance = r.norm(), share = 1 - distance / reach;
      if (share <= 0) continue;
      if (distance > 0)
        sum += share * share / distance * r;
      else  // coincident: apart along the first axis
        sum[0] += i < j ? -1 : 1;
    }
    particles_[i].push = sum;
  }

  const Field& field_;
  double thinnest_;
  std::vector<Particle> particles_;
  std::vector<std::vector<Index>> near_;
  Grid<double, D> grid_;
};

}  // namespace hmps::inline HMPS_ABI::detail
