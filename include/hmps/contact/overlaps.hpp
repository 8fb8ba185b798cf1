// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "hmps/contact/master_surface.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/penetration.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/search/detail/grid.hpp"

namespace hmps::inline HMPS_ABI {

/// How far the slaves of one organ reach into the wall of another: a result of `MetaballContact::overlaps`.
///
/// Near the surface the depth is the penetration of \paper{38}. Deeper inside it is estimated from the slaves of the
/// wall's organ, which must form its surface. This works to within about half a spacing, up to four spacings deep, but
/// not behind edges, so that `count` includes only slaves that are certainly inside. Slaves behind a thin wall whose
/// far side has no slaves count as inside. For a wall whose organ has no slaves, only the metaballs are used.
struct Overlap {
  std::size_t pair;             ///< As returned by `add_pair`.
  std::string slaves, masters;  ///< Names of the organs.
  std::size_t count = 0;        ///< Slaves that reach into the wall.
  Index deepest = 0;            ///< The deepest of these slaves.
  double depth = 0;             ///< The depth of that slave in m.
};

namespace detail {

/// The state of the particles for `find_overlap`.
template <int D>
struct OverlapParticles {
  std::vector<Index> particle;
  std::vector<Vector<double, D>> x;
  std::vector<Matrix<double, D>> F;
  std::vector<double> radius;  // r_0 in m, of slaves
};

/// The outward direction of a surface: for each particle of `skin`, the unit vector away from the surrounding masters;
/// zero if masters lie on all sides, as in a wall of one layer.
template <int D>
[[nodiscard]] HMPS_COLD std::vector<Vector<double, D>> outward_of(const OverlapParticles<D>& skin,
                                                                  const OverlapParticles<D>& masters, double spacing) {
  const double radius = 1.8 * spacing;  // the 26 neighbours of a cubic lattice
  Grid<double, D> grid;
  grid.build(masters.x.size(), radius, [&](std::size_t j) { return masters.x[j]; });
  std::vector<Vector<double, D>> outward;
  for (const Vector<double, D>& place : skin.x) {
    Vector<double, D> sum = Vector<double, D>::Zero();
    double count = 0;
    grid.visit(place, radius, [&](Index j, double) {
      sum += place - masters.x[j];
      ++count;
    });
    const double length = sum.norm();
    outward.push_back(length > 0.1 * spacing * count ? Vector<double, D>(sum / length) : Vector<double, D>::Zero());
  }
  return outward;
}

/// Sets `count`, `deepest` and `depth` of `overlap` for `slaves` at a wall of `masters` whose outermost layer is `skin`
/// (empty if unknown). Near the surface the depth is the penetration of \paper{38}. Further inside, where metaballs
/// give no distance, it is the distance of the slave behind the nearest particle of the outermost layer plus the radii
/// of both, if they are less than `deepest` spacings apart.
template <int D, Metaball Kernel>
HMPS_COLD void find_overlap(const NormalDensity<double, D, Kernel>& Z, const OverlapParticles<D>& slaves,
                            const OverlapParticles<D>& masters, const OverlapParticles<D>& skin,
                            const std::function<bool(Index, Index)>& excluded, Overlap& overlap) {
  constexpr double deepest = 4;
  const double l0 = Z.spacing(), radius = Kernel::radius * l0;
  std::vector<Matrix<double, D>> B, A;
  double widest = 0;
  for (const Matrix<double, D>& F : masters.F) {
    B.push_back(inverse<double, D>(F));
    A.push_back(right_cauchy_green<double, D>(B.back()));
    if (all_finite(A.back())) widest = std::max(widest, radius * F.norm());
  }
  Grid<double, D> near_masters, near_skin;
  near_masters.build(masters.x.size(), radius, [&](std::size_t j) { return masters.x[j]; });
  near_skin.build(skin.x.size(), l0, [&](std::size_t j) { return skin.x[j]; });
  const auto outward = outward_of(skin, masters, l0);

  for (std::size_t i = 0; i < slaves.x.size(); ++i) {
    const auto meets = [&](Index particle) { return !(excluded && excluded(slaves.particle[i], particle)); };
    MasterSurface<double, D, Kernel> surface;
    std::vector<Index> reaching;
    near_masters.visit(slaves.x[i], widest, [&](Index j, double) {
      if (all_finite(A[j]) && meets(masters.particle[j])) reaching.push_back(j);
    });
    for (const Index j : reaching) {
      const Vector<double, D> r = masters.x[j] - slaves.x[i];
      const double c = surface.reach(A[j], r, 1 / (radius * radius));
      surface.mean(c, B[j], Vector<double, D>::Zero());
    }
    const auto centres = Z.inverse(surface.density());
    double depth = 0;
    Vector<double, D> normal;
    if (centres.reached)
      depth = surface.normal(radius, normal)
                  ? penetration(slave_support<double, D>(slaves.F[i], normal, slaves.radius[i]),
                                surface_distance(surface.stretch(normal), centres.value, l0))
                  : l0 - centres.value;

    double nearest = deepest * l0, behind = 0;
    near_skin.visit(slaves.x[i], nearest, [&](Index s, double) {
      const Vector<double, D> r = slaves.x[i] - skin.x[s];
      if (!(r.norm() < nearest)) return;
      nearest = r.norm();
      const double height = r.dot(outward[s]);
      const bool below = height < 0 && (r - height * outward[s]).norm() < 0.9 * l0 && meets(skin.particle[s]);
      behind = below ? slaves.radius[i] + skin.radius[s] - height : 0;
    });
    depth = std::max(depth, behind);
    if (!(depth > 0)) continue;
    ++overlap.count;
    if (depth > overlap.depth) overlap.depth = depth, overlap.deepest = slaves.particle[i];
  }
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
