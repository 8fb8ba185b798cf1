// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <hmps/contact/surface_correction.hpp>
#include <hmps/core/error.hpp>
#include <hmps/core/types.hpp>
#include <limits>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "scene/anatomy.hpp"
#include "scene/cases.hpp"
#include "scene/fitted_organs.hpp"
#include "scene/motion.hpp"
#include "scene/organs.hpp"
#include "scene/regions.hpp"

namespace swallowing {

struct SceneSettings {
  double spacing = 2.4e-3;   ///< l0 in m
  double lattice_shift = 0;  ///< shift of the lattice along x and z from where `make_scene` puts it, in spacings
  Model model = Model::X;
  bool constrictors = true;              ///< with region H
  bool drawn_surfaces = true;            ///< contact sees the drawn surfaces; false: the lattice's own, as in the paper
  std::filesystem::path data;            ///< folder of the motion; its constrictors.csv shapes region H
  const FittedOrgans* fitted = nullptr;  ///< the particles to use in place of those of the lattice
};

/// The particles of two organs that may touch: each organ is slave of the other (\paper{43}). Where the two are one
/// body there is no contact: particles within `attachment` of the joint are left out.
struct ContactPair {
  Organ first, second;
  std::vector<hmps::Index> first_slaves, first_masters;  ///< surface particles; surface particles and the layer below
  std::vector<hmps::Index> second_slaves, second_masters;
};

namespace detail {
[[nodiscard]] inline std::array<hmps::Index, 2> ordered(std::size_t i, std::size_t j) {
  return {static_cast<hmps::Index>(std::min(i, j)), static_cast<hmps::Index>(std::max(i, j))};
}
}  // namespace detail

/// All particles of the swallow in their reference configuration. The deforming body comes first,
/// then the rigid plates of region H, which take part in contact only.
struct Scene {
  double spacing = 0;                      ///< m
  std::vector<Eigen::Vector3d> reference;  ///< m; x posterior, z superior, y = 0 is the midsagittal plane
  std::size_t elastic_count = 0;
  std::vector<Organ> organ;  ///< of each particle
  std::vector<Region> regions;
  std::vector<int> region;  ///< of each particle: index in `regions`, -1 if it is free
  std::vector<int> layers;  ///< of fitted particles: number through the wall there, 0 in bulk; otherwise empty
  std::vector<double> layer_spacings;           ///< distance of the layers in m
  std::vector<std::array<hmps::Index, 2>> cut;  ///< sorted pairs (i < j) within the effective radius that air separates
  std::vector<ContactPair> contacts;
  std::vector<hmps::Index> base, centre,
      tip;  ///< particles of the epiglottis in the midline, at region E, at region F, at the end
  std::optional<hmps::SurfaceCorrection<double, 3>>
      skin;  ///< moves the organs' particles to the drawn surface for contact; nothing: they stay in place
  std::size_t removed = 0;  ///< weakly supported particles that were left out

  /// Whether two particles of the body may be bonded if they are close enough: not across an air gap.
  [[nodiscard]] bool bonded(std::size_t i, std::size_t j) const {
    return !std::binary_search(cut.begin(), cut.end(), detail::ordered(i, j));
  }
  /// The particles of each region, in the order of `regions`.
  [[nodiscard]] std::vector<std::vector<hmps::Index>> particles_of_regions() const {
    std::vector<std::vector<hmps::Index>> lists(regions.size());
    for (std::size_t i = 0; i < region.size(); ++i)
      if (region[i] >= 0) lists[static_cast<std::size_t>(region[i])].push_back(static_cast<hmps::Index>(i));
    return lists;
  }
};

namespace detail {

/// The neighbours of particles on one lattice, as far as building the scene needs them.
class LatticeGraph {
 public:
  LatticeGraph(const std::vector<Point>& points, double spacing) : spacing_(spacing) {
    cells_.reserve(points.size());
    for (const Point& x : points) {
      std::array<int, 3> cell;
      for (int c = 0; c < 3; ++c)
        cell[static_cast<std::size_t>(c)] = static_cast<int>(std::lround((x[c] - points[0][c]) / spacing));
      cells_.push_back(cell);
    }
    index_.reserve(2 * points.size());
    for (std::size_t i = 0; i < points.size(); ++i) index_[key(cells_[i])] = i;
  }
  static constexpr std::size_t nobody = std::numeric_limits<std::size_t>::max();
  [[nodiscard]] std::size_t neighbour(std::size_t i, int a, int b, int c) const {
    const auto found = index_.find(key({cells_[i][0] + a, cells_[i][1] + b, cells_[i][2] + c}));
    return found == index_.end() ? nobody : found->second;
  }
  /// Calls visit(j, offset in m) for the particles at the 26 sites around `i`.
  template <class Visit>
  void around(std::size_t i, Visit&& visit) const {
    for (int a = -1; a <= 1; ++a)
      for (int b = -1; b <= 1; ++b)
        for (int c = -1; c <= 1; ++c)
          if (const std::size_t j = a || b || c ? neighbour(i, a, b, c) : nobody; j != nobody)
            visit(j, Point(spacing_ * Point(a, b, c)));
  }

 private:
  [[nodiscard]] static std::int64_t key(const std::array<int, 3>& c) {
    return ((c[0] + 4096LL) << 40) + ((c[1] + 4096LL) << 20) + c[2] + 4096LL;
  }
  double spacing_;
  std::vector<std::array<int, 3>> cells_;
  std::unordered_map<std::int64_t, std::size_t> index_;
};

/// Whether air lies between two points (mm): there is no tissue within `reach` mm of their midpoint along each axis.
/// The reach keeps bonds along a concave surface, whose midpoints lie a few tenths outside the tissue.
[[nodiscard]] inline bool air_between(const Anatomy& anatomy, const Point& a, const Point& b) {
  constexpr double reach = 0.5;
  const Point middle = (a + b) / 2;
  if (anatomy.organ_at(middle) != Organ::none) return false;
  for (int c = 0; c < 3; ++c)
    for (const double side : {-reach, reach}) {
      Point x = middle;
      x[c] += side;
      if (anatomy.organ_at(x) != Organ::none) return false;
    }
  return true;
}

}  // namespace detail
}  // namespace swallowing
