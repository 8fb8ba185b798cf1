// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/detail/fitted_field.hpp"

/// How a `FittedField` samples the body and its surface, and measures its thickness.
namespace hmps::inline HMPS_ABI::detail {

/// The part of a cut cell that lies inside the body, by 4^D points in 2^D blocks; `d` is the distance at its centre
/// `x`. A block is not sampled point by point if the distance in its middle shows that it lies entirely inside or
/// outside.
template <int D>
Sample<D> FittedField<D>::cut_cell(const Point& x, double d) const {
  constexpr int parts = samples_per_spacing, blocks = 1 << D, of_block = 1 << D;
  static_assert(parts == 4, "hmps: 2^D blocks of 2^D points are a cell of 4^D");
  const double edge = spacing_ / parts, fine = edge / parts, total = of_block * blocks;
  const double diagonal = std::sqrt(static_cast<double>(D)) * edge;
  const auto covered = [&](double distance) { return std::clamp(0.5 - distance / fine, 0.0, 1.0); };
  // The share that is covered anywhere within `reach` (m) of a point at this distance, if all or nothing; else -1.
  const auto covered_around = [&](double distance, double reach) {
    return std::abs(distance) > 0.5 * fine + steepest * reach ? covered(distance) : -1;
  };
  Sample<D> sample{Point::Zero(), 0};
  for (int block = 0; block < blocks; ++block) {
    double all = covered_around(d, 0.375 * diagonal);
    if (all < 0) all = covered_around((*this)(part(x, edge, 2, block)), 0.125 * diagonal);
    for (int k = 0; k < of_block; ++k) {
      const Point y = part(x, edge, parts, block * of_block + k);
      const double share = (all < 0 ? covered((*this)(y)) : all) / total;
      sample.volume += share;
      sample.place += share * y;
    }
  }
  if (sample.volume > 0) sample.place /= sample.volume;
  sample.volume *= std::pow(edge, D);
  return sample;
}

template <int D>
void FittedField<D>::sample_cell(const Point& centre, Found& found) const {
  constexpr int parts = samples_per_spacing;
  const double edge = spacing_ / parts, volume = std::pow(edge, D);
  const double half_diagonal = 0.5 * std::sqrt(static_cast<double>(D)) * edge;
  double nearest = std::numeric_limits<double>::infinity();
  bool inside = false;
  Point at = centre;
  Distances distances;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const Point x = part(centre, spacing_, parts, static_cast<int>(k));
    const double d = distances[k] = (*this)(x);
    inside = inside || d < 0;
    if (std::abs(d) < nearest) nearest = std::abs(d), at = x;
    if (d < -steepest * half_diagonal) {
      found.samples.push_back({x, volume});
    } else if (d < steepest * half_diagonal) {
      const Sample<D> cut = cut_cell(x, d);
      if (cut.volume > 0) found.samples.push_back(cut);
    }
  }
  const auto [least, most] = std::minmax_element(distances.begin(), distances.end());
  const double slope = (*most - *least) / ((parts - 1) * edge);
  found.is_distance = slope > 0.1 && slope < 4 * std::sqrt(static_cast<double>(D));
  // A change of sign is not required, because a face may lie between two cells.
  const bool is_close = nearest <= steepest * half_diagonal;
  found.at_surface = inside && (is_close || *most > 0);
  if (!inside || !is_close) return;
  if (const auto point = surface_at(at)) {
    found.surface.push_back(*point);
    find_other_side_of_gap(centre, distances, found);
  }
}

/// The point of the surface beside a `place` close to it; none at edges, where the shape has no outward direction.
template <int D>
std::optional<SurfacePoint<D>> FittedField<D>::surface_at(Point place) const {
  for (int step = 0; step < 4; ++step) {
    const Point g = gradient(place);
    if (!(g.squaredNorm() > 0.25)) return std::nullopt;
    place -= (*this)(place) / g.squaredNorm() * g;
  }
  const Point g = gradient(place - 0.05 * spacing_ * gradient(place));
  if (g.squaredNorm() > 0.8 && std::abs((*this)(place)) < 0.01 * spacing_)
    return SurfacePoint<D>{place, g.normalized()};
  return std::nullopt;
}

/// Adds a point of the other side where both sides of a narrow gap cross one cell: only one point of the surface was
/// found there, but each side has a part of the body behind it. `distances` are those of the parts of the cell.
template <int D>
void FittedField<D>::find_other_side_of_gap(const Point& centre, const Distances& distances, Found& found) const {
  constexpr int parts = samples_per_spacing;
  const SurfacePoint<D> first = found.surface.front();
  double nearest = steepest * 0.5 * std::sqrt(static_cast<double>(D)) * spacing_ / parts;
  Point at = first.place;
  bool second = false;
  for (std::size_t k = 0; k < distances.size(); ++k) {
    const Point x = part(centre, spacing_, parts, static_cast<int>(k));
    if ((x - first.place).dot(first.outward) <= 0) continue;
    const double d = std::abs(distances[k]);
    if (d < nearest && gradient(x).dot(first.outward) < -0.5) nearest = d, at = x, second = true;
  }
  if (!second) return;
  const auto other = surface_at(at);
  if (other && (other->place - first.place).dot(first.outward) > 0 && other->outward.dot(first.outward) < -0.5)
    found.surface.push_back(*other);
}

template <int D>
void FittedField<D>::sample(const AnyExecutor& execute) {
  std::array<std::size_t, std::size_t{D}> count{};
  std::size_t total = 1;
  for (int c = 0; c < D; ++c) {
    const double cells = std::ceil((box_.upper[c] - box_.lower[c]) / spacing_);
    count[static_cast<std::size_t>(c)] = std::max<std::size_t>(1, static_cast<std::size_t>(cells));
    total *= count[static_cast<std::size_t>(c)];
  }
  const std::size_t slabs = count[D - 1], slab = total / slabs;
  std::vector<std::vector<std::pair<std::uint64_t, Found>>> found(slabs);
  const double reach = 0.75 * std::sqrt(static_cast<double>(D)) * spacing_;
  guarded(execute)(slabs, [&](std::size_t s) {
    for (std::size_t k = 0; k < slab; ++k) {
      Cell cell{};
      std::size_t rest = s * slab + k;
      Point centre;
      for (std::size_t c = 0; c < D; ++c, rest /= count[c - 1]) {
        cell[c] = static_cast<std::int64_t>(rest % count[c]);
        const auto axis = static_cast<int>(c);
        centre[axis] = box_.lower[axis] + (static_cast<double>(cell[c]) + 0.5) * spacing_;
      }
      if ((*this)(centre) > reach) continue;
      Found here;
      sample_cell(centre, here);
      if (!here.samples.empty()) found[s].emplace_back(along_curve(cell), std::move(here));
    }
  });
  std::vector<std::pair<std::uint64_t, const Found*>> order;
  for (const auto& part : found)
    for (const auto& [code, here] : part) order.emplace_back(code, &here);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [code, here] : order) {
    samples_.insert(samples_.end(), here->samples.begin(), here->samples.end());
    surface_.insert(surface_.end(), here->surface.begin(), here->surface.end());
  }
  std::size_t at_surface = 0, odd = 0;
  for (const auto& [code, here] : order) {
    at_surface += here->at_surface;
    odd += here->at_surface && !here->is_distance;
  }
  require(
      4 * odd <= at_surface, "hmps: in ", odd, " of ", at_surface,
      " cells at the surface, the shape to fit particles in changes by less than 0.1 or more than 4 m per metre; it "
      "must be about the signed distance in metres: give redistanced(shape, box, spacing / 4)");
  require(!samples_.empty(), "hmps: the shape has no volume in the box from (", box_.lower, ") to (", box_.upper,
          "); give a shape that is negative inside, and a box around it in metres");
}

template <int D>
void FittedField<D>::measure(const AnyExecutor& execute) {
  // The two sides of a wall may meet at up to 60 degrees, as in a wedge. Faces that meet at more form an edge.
  constexpr double opposite = -0.5;
  const double most = most_layers * spacing_, step = spacing_ / 8;
  guarded(execute)(surface_.size(), [&](std::size_t k) {
    SurfacePoint<D>& point = surface_[k];
    // The largest ball that touches the surface here from within: it grows until it touches elsewhere.
    for (double r = step; r <= most / 2; r += step) {
      const Point centre = point.place - r * point.outward;
      const double depth = -(*this)(centre);
      if (depth > 0.9 * r && r + step <= most / 2) continue;
      if (depth > 0.9 * r) {
        point.least = point.thickness = most;
        break;
      }
      point.least = 1.9 * (r - step);  // no ball is larger than the wall
      // Slightly further in, so that the gradient is that of the other side.
      const Point other = point.place - (r + step / 2) * point.outward;
      const Point g = gradient(other);
      if (g.dot(point.outward) < opposite) point.thickness = std::min(most, r + step / 2 - (*this)(other));
      break;
    }
  });
  grid_.build(surface_.size(), 1.5 * spacing_, [&](std::size_t k) { return surface_[k].place; });
}

}  // namespace hmps::inline HMPS_ABI::detail
