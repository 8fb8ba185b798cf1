// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` if a `patch` is more than 20 times as large as the cloud of particles at `reference` (m), with
/// a `spacing` (m): then one of them is in a different unit.
template <class T, class S>
void require_same_unit(const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch, double spacing) {
  if (reference.size() == 0 || patch.vertices.empty()) return;  // reported elsewhere
  Vector<double, 3> lower = reference[0].template cast<double>(), upper = lower;
  for (std::size_t i = 1; i < reference.size(); ++i) {
    lower = lower.cwiseMin(reference[i].template cast<double>());
    upper = upper.cwiseMax(reference[i].template cast<double>());
  }
  const Box<S, 3> box = bounds(patch);
  const double size = (box.upper - box.lower).template cast<double>().maxCoeff();
  const double body = (upper - lower).maxCoeff() + spacing;
  require(size <= 20 * body, "hmps: ", patch.source, " is ", size, " m large, ", size / body,
          " times the particles, which reach over ", body,
          " m: give both in metres (a file in millimetres is read with a scale of 1e-3)");
}

/// Where a patch lies relative to the particles of a body: means over its area in m.
struct PatchPlace {
  double nearest = 0;  ///< distance of the nearest particle
  double ahead = 0;    ///< how far particles reach without a gap to the side to which its normals point
  double behind = 0;   ///< the same to the other side
};

/// How far sorted `heights` (m) reach from 0 without a gap longer than `gap` (m).
[[nodiscard]] inline double reach_of(const std::vector<double>& heights, double gap) {
  double reach = 0;
  for (const double height : heights) {
    if (height > reach + gap) break;
    reach = height;
  }
  return reach;
}

/// The place of a `patch`, whose edges are not longer than a `spacing` (m), in the body of the particles at
/// `reference` (m) for which `belongs(i)` holds. It looks 4 spacings far, and up to 9 for the nearest particle.
template <class T, class S, class Belongs>
[[nodiscard]] PatchPlace place_of(const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch, double spacing,
                                  const Belongs& belongs) {
  using V = Vector<double, 3>;
  using Coordinate = typename VectorView<T, 3>::Scalar;
  const FixedRadiusSearch<T, 3> search(reference);
  std::vector<Index> found;
  std::vector<double> ahead, behind;
  PatchPlace sum;
  double whole = 0;
  for (const auto& t : patch.triangles) {
    const V a = patch.vertices[t[0]].template cast<double>(), b = patch.vertices[t[1]].template cast<double>(),
            c = patch.vertices[t[2]].template cast<double>(), across = area_vector(a, b, c), middle = (a + b + c) / 3;
    const double area = across.norm();
    if (!(area > 0)) continue;
    double nearest = std::numeric_limits<double>::infinity();
    for (double radius = 4.1 * spacing; radius < 9.5 * spacing && !is_finite(nearest); radius += 2 * spacing) {
      search(middle.template cast<Coordinate>(), static_cast<Coordinate>(radius), found);
      std::erase_if(found, [&](Index k) { return !belongs(std::size_t{k}); });
      for (const Index k : found) nearest = std::min(nearest, (reference[k].template cast<double>() - middle).norm());
    }
    ahead.clear();
    behind.clear();
    for (const Index k : found) {
      const V from = reference[k].template cast<double>() - middle;
      const double height = from.dot(across) / area;
      if (std::abs(height) > 4 * spacing || (from - height / area * across).norm() > 0.75 * spacing) continue;
      (height > 0 ? ahead : behind).push_back(std::abs(height));
    }
    std::sort(ahead.begin(), ahead.end());
    std::sort(behind.begin(), behind.end());
    whole += area;
    sum.nearest += area * std::min(nearest, 9 * spacing);
    sum.ahead += area * reach_of(ahead, 1.3 * spacing);
    sum.behind += area * reach_of(behind, 1.3 * spacing);
  }
  if (!(whole > 0)) return {};
  return {sum.nearest / whole, sum.ahead / whole, sum.behind / whole};
}

/// Throws `InputError` if a patch of `source` at this place is neither on the surface of the body nor a middle surface.
inline void require_on_surface(const PatchPlace& place, double spacing, const std::string& source) {
  const double nearest = place.nearest / spacing, ahead = place.ahead / spacing, behind = place.behind / spacing;
  require(nearest <= 1.75, "hmps: ", source, " lies outside the body of PatchPressure: the nearest particles are ",
          place.nearest, " m away, ", nearest,
          " spacings in the mean over its area, at most 1.75 are permitted; take a patch of the surface from which the "
          "body was filled, at the same place, and check `belongs`");
  require(ahead <= 1.2 || (ahead <= 2.2 && behind <= ahead + 0.5), "hmps: ", source,
          " lies inside the body of PatchPressure: particles reach ", place.ahead, " m ahead of it, ", ahead,
          " spacings in the mean over its area, at most 1.2 are permitted; take a patch of the surface from which the "
          "body was filled, at the same place, whose normals point out of the body");
}

}  // namespace hmps::inline HMPS_ABI::detail
