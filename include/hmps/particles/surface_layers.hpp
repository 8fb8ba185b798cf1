// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/detail/plausible_spacing.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace hmps::inline HMPS_ABI {

/// The layers at the surface of a body, for contact: the slaves and the masters of an `Organ`.
struct SurfaceLayers {
  std::vector<Index> outermost;      ///< the outermost layer, sorted
  std::vector<Index> two_outermost;  ///< the two outermost layers, sorted

  /// The part of the layers that belongs to `body`, one of several that were passed together. Throws `InputError` if
  /// that set was made for fewer particles.
  [[nodiscard]] SurfaceLayers of(const ParticleSet& body) const {
    SurfaceLayers own;
    for (const auto& [from, to] :
         {std::pair(&outermost, &own.outermost), std::pair(&two_outermost, &own.two_outermost)})
      for (const Index i : *from) {
        detail::require(i < body.scene_size(), "hmps: the layers contain particle ", i,
                        ", but the set of a body was made for a scene of ", body.scene_size(),
                        " particles; make it for all of them");
        if (body.contains(i)) to->push_back(i);
      }
    return own;
  }
};

namespace detail {

/// Directions spread evenly over the circle or the sphere (Fibonacci).
template <int D>
[[nodiscard]] std::vector<Vector<double, D>> spread_directions(std::size_t n) {
  std::vector<Vector<double, D>> directions(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double part = (static_cast<double>(k) + 0.5) / static_cast<double>(n);
    if constexpr (D == 2) {
      directions[k] = {std::cos(2 * std::numbers::pi * part), std::sin(2 * std::numbers::pi * part)};
    } else {
      const double z = 1 - 2 * part, r = std::sqrt(1 - z * z);
      const double turn = 2 * std::numbers::pi * static_cast<double>(k) / std::numbers::phi;
      directions[k] = {r * std::cos(turn), r * std::sin(turn), z};
    }
  }
  return directions;
}

/// Whether one of `directions` makes an angle with each of `neighbours` (unit vectors) whose cosine is at most `limit`.
template <int D>
[[nodiscard]] bool sees_out(const std::vector<Vector<double, D>>& neighbours,
                            const std::vector<Vector<double, D>>& directions, double limit) {
  return std::any_of(directions.begin(), directions.end(), [&](const Vector<double, D>& direction) {
    return std::all_of(neighbours.begin(), neighbours.end(),
                       [&](const Vector<double, D>& to) { return to.dot(direction) <= limit; });
  });
}

}  // namespace detail

/// Finds the outermost layer of a body and its two outermost layers from the particle positions alone: on a lattice or
/// in any evenly spaced cloud, in walls of any thickness.
///
///     const auto layers = surface_layers(vectors(points), l0);
///     contact.add_organ({.name = "organ", .slaves = layers.outermost, .masters = layers.two_outermost});
///
/// A particle belongs to the outermost layer if a cone with its tip at the particle and a half angle of 56 degrees
/// contains no other particle within 1.8 spacings. At a flat surface such a cone opens to 90 degrees, and at the foot
/// of a step of a surface cut out of a lattice to 67 (60 where two steps meet in a corner). Below the outermost layer
/// the free cone is at most 55 degrees in a cubic lattice (under a surface across the diagonal of its cells), and
/// inside the body 28. In a wall two particles thick every particle is therefore outermost, as in a sheet of one. A
/// cone of less than 60 degrees (2D: 57) may be missed, because a finite number of directions is tested. The second
/// layer consists of the particles within 1.5 spacings of the outermost layer: one layer along a lattice, and two or
/// more across its diagonals, where layers lie closer. Both reach about equally deep, two spacings below the surface.
///
/// Empty cavities have a surface too, and so do gaps in a cloud where neighbours are further apart than about 1.5
/// spacings.
///
/// @param points   reference positions in m
/// @param spacing  l0 in m
/// @param bonded   `bonded(i, j)`: whether two particles belong to one body; symmetric
/// Throws `InputError` for a spacing that is not positive or does not fit the particles (such as one in another unit),
/// a predicate that is not symmetric, positions that are not finite, and coincident particles.
template <class T, int D, class Bonded = EveryBond, Executor E = Serial>
[[nodiscard]] SurfaceLayers surface_layers(const VectorView<T, D>& points, double spacing, const Bonded& bonded = {},
                                           const E& execute = {}) {
  static_assert(D == 2 || D == 3, "hmps: layers are found in 2 or 3 dimensions");
  using S = typename VectorView<T, D>::Scalar;
  detail::require_spacing(spacing, "surface layers");
  // Every direction lies within 3.5 degrees (2D: 1) of one of these.
  const auto directions = detail::spread_directions<D>(D == 2 ? 180 : 2000);
  const double limit = std::cos(56 * std::numbers::pi / 180);
  // 1.8 lies between the neighbours across the diagonal of a cell, at 1.73, and the next ones, at 2.
  const FixedRadiusSearch<T, D> search(points);
  detail::require_plausible_spacing(search, {spacing, 1.8}, static_cast<S>(1.8 * spacing));
  const NeighbourList nearby = find_neighbours(search, static_cast<S>(1.8 * spacing), execute);
  const auto for_each = [&](std::size_t i, auto&& visit) {
    const Vector<double, D> here = points[i].template cast<double>();
    for (const Index j : nearby[i])
      if (detail::are_bonded(bonded, i, static_cast<std::size_t>(j)))
        visit(j, Vector<double, D>(points[j].template cast<double>() - here));
  };
  std::vector<char> layer(points.size(), 0);
  detail::guarded(execute)(points.size(), [&](std::size_t i) {
    std::vector<Vector<double, D>> to;
    for_each(i, [&](Index, const Vector<double, D>& r) { to.push_back(r); });
    // The nearest neighbours block most directions.
    std::stable_sort(to.begin(), to.end(),
                     [](const auto& a, const auto& b) { return a.squaredNorm() < b.squaredNorm(); });
    for (auto& r : to) r.normalize();
    layer[i] = detail::sees_out<D>(to, directions, limit) ? 1 : 0;
  });
  if constexpr (!std::is_same_v<Bonded, EveryBond>)
    if (std::all_of(layer.begin(), layer.end(),
                    [](char outermost) { return outermost != 0; })) {  // a sheet, or nothing is bonded
      bool any = points.size() < 2;
      for (std::size_t i = 0; i < points.size() && !any; ++i)
        for_each(i, [&](Index, const Vector<double, D>&) { any = true; });
      detail::require(any, "hmps: `bonded` of surface_layers holds for no two of the ", points.size(),
                      " particles, so that all are outermost; it must hold for particles of one body");
    }
  std::vector<char> second(points.size(), 0);
  detail::guarded(execute)(points.size(), [&](std::size_t i) {
    if (layer[i] == 1) return;
    bool found = false;
    for_each(
        i, [&](Index j, const Vector<double, D>& r) { found = found || (layer[j] == 1 && r.norm() <= 1.5 * spacing); });
    second[i] = found ? 1 : 0;
  });
  SurfaceLayers result;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (layer[i] == 1) result.outermost.push_back(static_cast<Index>(i));
    if (layer[i] == 1 || second[i] == 1) result.two_outermost.push_back(static_cast<Index>(i));
  }
  return result;
}

}  // namespace hmps::inline HMPS_ABI
