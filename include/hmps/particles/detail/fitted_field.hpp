// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/central_gradient.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/wall_layers.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/search/detail/grid.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// A sample of the body: the volume of a cell of the sampling grid that lies inside, and the centroid of that volume.
template <int D>
struct Sample {
  Vector<double, D> place;  // m
  double volume;            // m3
};

/// A point of the surface, and how thick the body is behind it.
template <int D>
struct SurfacePoint {
  Vector<double, D> place, outward;
  double least = 0;      // m, twice the radius of the largest ball inside that touches the surface here
  double thickness = 0;  // m; 0: that ball touches no opposite side but an edge

  /// 0 or 1, by whether the surface faces a fixed direction, to which few surfaces are parallel.
  [[nodiscard]] int side() const {
    double along = 0;
    for (int c = 0; c < D; ++c) along += (1 + 0.618 * c) * outward[c];
    return along > 0 ? 1 : 0;
  }
};

/// How the layers lie at a place: `count` of them across, `spacing` apart, or any number where the body is thick.
struct Layering {
  double thickness = 0;  // m
  double spacing = 0;    // m
  int count = 0;
  bool thick = true;
  int side = 0;     // 0 or 1: which way the nearest part of the surface faces, so that opposite faces of a wall differ
  double edge = 0;  // 0 to 1: the share of the surface nearby that is the edge of a wall; 0 where the body is thick

  /// The layer of a particle at `depth`, counted from the nearest surface.
  [[nodiscard]] int layer(double depth) const {
    const int at = std::max(static_cast<int>(depth / spacing), 0);
    return thick ? at : std::min(at, (count - 1) / 2);
  }
  /// The depth of the middle of a layer.
  [[nodiscard]] double level(int layer) const { return (layer + 0.5) * spacing; }
  /// How firmly particles are held there: in thick parts the inner layers fade into the bulk.
  [[nodiscard]] double hold(int layer) const { return !thick || layer == 0 ? 1 : layer < 4 ? std::pow(0.5, layer) : 0; }
};

/// The part of a shape that lies in a box, in double whatever the scalar of the shape, with its samples, its surface
/// and its thickness. The type of the shape is erased, so that the fit is compiled once for all shapes.
template <int D>
class FittedField {
 public:
  using Point = Vector<double, D>;
  static constexpr int samples_per_spacing = 4;
  static constexpr double steepest = 1.25;  // the largest gradient of the distance with which no cut cell is missed

  /// The shape must outlive the field.
  template <class F, class S>
  FittedField(const F& shape, const Box<S, D>& box, double spacing, int least_layers)
      : shape_([&shape](const Point& x) {
          return static_cast<double>(static_cast<S>(shape(Vector<S, D>(x.template cast<S>()))));
        }),
        box_{box.lower.template cast<double>(), box.upper.template cast<double>()},
        spacing_(spacing),
        least_layers_(least_layers) {
    static_assert(RequireDistance<F, Vector<S, D>>::value);
    (void)lattice_sites<S, D>(box, static_cast<S>(spacing), box.lower);  // for its errors
    require((box.lower.array() < box.upper.array()).all(), "hmps: the box to fit particles in reaches from (",
            box.lower, ") to (", box.upper, ") and has no volume; give an upper corner above the lower one");
  }

  /// Signed distance in m, negative inside. Throws `InputError` where the shape is NaN.
  [[nodiscard]] double operator()(const Point& x) const {
    const double d = shape_(x);
    if (is_nan(d)) throw_input_error({"hmps: the shape is NaN at (", x, "); it must have a value in the whole box"});
    return std::max(d, box_(x));
  }

  /// Gradient of the distance by central differences over a fiftieth of a spacing to either side: zero across a middle
  /// surface.
  [[nodiscard]] Point gradient(const Point& x) const { return central_gradient(*this, x, 0.02 * spacing_); }

  /// Samples the body and its surface: cells of one spacing along a space-filling curve, and 4^D samples in each.
  void sample(const AnyExecutor& execute);

  /// Measures the thickness behind every point of the surface.
  void measure(const AnyExecutor& execute);

  /// The layers at a place, from the mean thickness behind the points of the surface around it.
  [[nodiscard]] Layering layering(const Point& x) const {
    if (-(*this)(x) >= most_layers * spacing_ / 2) return {most_layers * spacing_, spacing_, most_layers, true};
    const double nearby = 1.5 * spacing_, farthest = 13 * spacing_;
    double weight = 0, sum = 0, least = 0, edges = 0, edge = -1, closest = std::numeric_limits<double>::infinity();
    int side = 0;
    for (double radius = nearby; radius < farthest && !(weight > 0); radius *= 2) {
      grid_.visit(x, radius, [&](Index k, double squared) {
        const SurfacePoint<D>& point = surface_[k];
        if ((point.place - x).dot(point.outward) < 0) return;  // it faces x: it belongs to another part, across a gap
        if (squared < closest) closest = squared, side = point.side();
        if (radius > nearby) least = std::max(least, point.least);
        const double w = 1 - std::sqrt(squared) / radius;
        if (point.thickness > 0) {
          weight += w * w;
          sum += w * w * point.thickness;
        } else {
          edges += w * w;
        }
      });
      // Of the surface nearest to the particle: further away, the faces of the wall are more and more of it.
      if (edge < 0 && edges + weight > 0) edge = edges / (edges + weight);
      if (least >= most_layers * spacing_) break;
    }
    const double thickness = std::max(weight > 0 ? sum / weight : most_layers * spacing_, least);
    // Walls half a layer thicker than a whole number are rounded up throughout, whatever the rounding of the thickness.
    const int count = std::max(least_layers_, static_cast<int>(thickness / spacing_ + 0.501));
    const bool thick = thickness > (most_layers - 0.01) * spacing_;
    return {thickness, thickness / count, count, thick, side, thick ? 0 : std::max(edge, 0.0)};
  }

  [[nodiscard]] const std::vector<Sample<D>>& samples() const { return samples_; }
  [[nodiscard]] double spacing() const { return spacing_; }

 private:
  using Cell = std::array<std::int64_t, std::size_t{D}>;
  static constexpr std::size_t parts_per_axis = samples_per_spacing;
  /// The distances of the parts of a cell.
  using Distances = std::array<double, parts_per_axis * parts_per_axis*(D == 3 ? parts_per_axis : 1)>;
  struct Found {
    std::vector<Sample<D>> samples;
    std::vector<SurfacePoint<D>> surface;
    bool at_surface = false;  // whether the surface crosses the cell
    bool is_distance = true;  // whether the shape changes there by about a metre per metre
  };

  /// Interleaves the bits of the indices of a cell: cells that are close in this order are close in space.
  [[nodiscard]] static std::uint64_t along_curve(const Cell& cell) {
    std::uint64_t code = 0;
    for (int bit = 0; bit < 63 / D; ++bit)
      for (int c = 0; c < D; ++c)
        code |= (static_cast<std::uint64_t>(cell[static_cast<std::size_t>(c)]) >> bit & 1U) << (bit * D + c);
    return code;
  }

  /// The centre of part `k` of the cube around `centre`, which is divided into `parts`^D parts, numbered along the same
  /// curve. `parts` is a power of two.
  [[nodiscard]] static Point part(const Point& centre, double edge, int parts, int k) {
    Point x = centre;
    for (int c = 0; c < D; ++c) {
      int at = 0;
      for (int bit = 0; 1 << bit < parts; ++bit) at |= (k >> (bit * D + c) & 1) << bit;
      x[c] += edge * ((at + 0.5) / parts - 0.5);
    }
    return x;
  }

  [[nodiscard]] Sample<D> cut_cell(const Point& x, double d) const;
  void sample_cell(const Point& centre, Found& found) const;
  [[nodiscard]] std::optional<SurfacePoint<D>> surface_at(Point place) const;
  void find_other_side_of_gap(const Point& centre, const Distances& distances, Found& found) const;

  std::function<double(const Point&)> shape_;
  Box<double, D> box_;
  double spacing_;
  int least_layers_;
  std::vector<Sample<D>> samples_;
  std::vector<SurfacePoint<D>> surface_;
  Grid<double, D> grid_;
};

}  // namespace hmps::inline HMPS_ABI::detail
