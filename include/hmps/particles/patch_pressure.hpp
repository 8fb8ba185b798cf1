// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/carried_surface.hpp"
#include "hmps/particles/detail/patch_place.hpp"
#include "hmps/search/nearest_spacing.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/surface_patch.hpp"

namespace hmps::inline HMPS_ABI {

/// A pressure on a patch of the surface of a body, as force densities on its particles. It follows the surface: it acts
/// normal to each triangle in its current position, on its current area.
///
/// The patch is refined to edges of a spacing and carried along (`CarriedSurface`, y = sum phi x). Each triangle with
/// the area vector a gives -p a / 3 to each of its corners, and a corner distributes its force to the particles by the
/// same phi, so that the forces on the particles do the same work as the pressure on the surface. Since sum phi = 1 and
/// sum phi x = y, force and torque are those of the pressure on the carried patch, up to the rounding of the sums: the
/// force is -p times the area vector of the patch; on a whole closed surface force and torque are zero, and the power
/// is -p dV/dt with the enclosed volume V. The carried patch follows the surface of the body to the accuracy of
/// `CarriedSurface`.
///
/// The patch must lie on the surface of the body, or be the middle surface of a sheet. Means over its area are judged,
/// so that a part of it may lie elsewhere:
///
/// - The distance of the nearest particle must be at most 1.75 spacings. On surfaces of balls of 1.2 to 9 spacings
///   radius, boxes and tubes of one to five layers, filled by lattices at several offsets and fitted, it is 0.4 to 1.1.
///   A patch two spacings further out has 2.1 to 3.0, and sums of |phi| of 5 to 9 instead of 1 to 4: the forces on the
///   particles alternate, and `relax` may end in NaN.
/// - The particles ahead of the patch must not reach further than 1.2 spacings. Those in a column of 0.75 spacings
///   radius about its normal count, up to the first gap of more than 1.3 spacings. On those surfaces there are none;
///   on a ball of 9 spacings radius with a patch of 20 triangles they reach 0.9. A dome sinks 17 % too little under a
///   patch two spacings inside, which has 1.3.
/// - On a middle surface, with as many particles ahead as behind to half a spacing, they may reach 2.2 spacings.
///
///     const PatchPressure pressure(vectors(reference), patch, l0);
///     force(x, v, f);                            // internal forces, N/m3
///     pressure.add(x, f, 2e3, l0 * l0 * l0);     // 2 kPa pressing on the patch; a negative one pulls
class PatchPressure {
 public:
  /// @param reference  reference positions of the particles in m
  /// @param patch      see `surface_patch`; may be a whole surface
  /// @param spacing    l0 in m
  /// @param belongs    `belongs(i)`: whether particle i belongs to the body; by default all do
  /// Throws as `CarriedSurface` and `refine` do, and `InputError` for a spacing far from that of the particles, a patch
  /// more than 20 times as large as the cloud of particles, one whose normals point into the body, and one that does
  /// not lie on the body.
  template <class T, class S, class Belongs = bool (*)(std::size_t)>
  PatchPressure(
      const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch, double spacing,
      const Belongs& belongs = [](std::size_t) { return true; })
      : PatchPressure(reference, Refined<S>{refined(reference, patch, spacing)}, spacing, belongs) {}

  /// Adds to `f` (N/m3) the force densities of `pressure` (Pa, positive if it presses on the body) at the positions `x`
  /// in m. `volume` is that of a particle in m3, a number or a `ScalarView`. Runs serially, so that the result does not
  /// depend on threads. Throws `InputError` for views of the wrong size, a pressure that is not finite, a volume that
  /// is not positive, and volumes that are not about the cube of the spacing on average.
  template <class X, PerParticle Vol, class F>
  void add(const VectorView<X, 3>& x, const VectorView<F, 3>& f, double pressure, const Vol& volume) const {
    require_size(f, x.size(), "force densities");
    require_apart(f, "force densities", x, "positions");
    detail::require(detail::is_finite(pressure), "hmps: the pressure on a patch is ", pressure,
                    " Pa; give a finite number");
    require_positive(volume, x.size(), "volume", "m3");
    if (x.size() > 0)
      detail::require_cell_volume<3>(detail::mean_of(volume, x.size()), spacing_, detail::volume_factor_of_spacing,
                                     "the `volume` of PatchPressure::add", "the spacing");
    const std::vector<V> corner = corners(x);
    std::vector<V> force(corner.size(), V::Zero());
    for (const auto& t : triangles_) {
      const V third = area_vector(corner[t[0]], corner[t[1]], corner[t[2]]) * (-pressure / 3);
      for (const Index k : t) force[k] += third;
    }
    for (std::size_t p = 0; p < force.size(); ++p)
      for (const auto& share : carried_.shares(p))
        f.add(share.particle, V(force[p] * (share.weight / static_cast<double>(at_particle(volume, share.particle)))));
  }

  /// The sum of the area vectors of the patch in m2 at the particle positions `x`. A pressure p exerts the force
  /// -p times this vector.
  template <class X>
  [[nodiscard]] Vector<double, 3> area_at(const VectorView<X, 3>& x) const {
    const std::vector<V> corner = corners(x);
    V sum = V::Zero();
    for (const auto& t : triangles_) sum += area_vector(corner[t[0]], corner[t[1]], corner[t[2]]);
    return sum;
  }

 private:
  using V = Vector<double, 3>;

  /// A patch whose edges are already no longer than a spacing.
  template <class S>
  struct Refined {
    SurfaceMesh<S> mesh;
  };

  /// `patch` refined to edges of a `spacing` (m). The spacing is checked first, because one that is far too short would
  /// make millions of triangles.
  template <class T, class S>
  [[nodiscard]] static SurfaceMesh<S> refined(const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch,
                                              double spacing) {
    detail::require_spacing(spacing, "PatchPressure");
    require_finite(reference, "the reference position");
    detail::require_spacing_of(reference, spacing, "PatchPressure");
    detail::require_same_unit(reference, patch, spacing);
    return refine(patch, spacing);
  }

  template <class T, class S, class Belongs>
  PatchPressure(const VectorView<T, 3>& reference, const Refined<S>& fine, double spacing, const Belongs& belongs)
      : spacing_(spacing),
        carried_(reference, vectors(fine.mesh.vertices), spacing, belongs),
        triangles_(fine.mesh.triangles) {
    require_outward(reference, fine.mesh, spacing);
    detail::require_on_surface(detail::place_of(reference, fine.mesh, spacing, belongs), spacing, fine.mesh.source);
  }

  /// Throws `InputError` if, on the whole, the particles lie on the side of the patch to which its normals point.
  template <class T, class S>
  void require_outward(const VectorView<T, 3>& reference, const SurfaceMesh<S>& mesh, double spacing) const {
    double ahead = 0, whole = 0;
    for (const auto& t : triangles_) {
      V middle = V::Zero(), particles = V::Zero();
      for (const Index k : t) {
        middle += mesh.vertices[k].template cast<double>() / 3;
        for (const auto& share : carried_.shares(k))
          particles += share.mean / 3 * reference[share.particle].template cast<double>();
      }
      const V across =
          area_vector(mesh.vertices[t[0]].template cast<double>(), mesh.vertices[t[1]].template cast<double>(),
                      mesh.vertices[t[2]].template cast<double>());
      ahead += across.dot(particles - middle);
      whole += across.norm();
    }
    // The particles lie half a spacing or more behind an outer surface, and neither ahead of nor behind a middle one.
    detail::require(ahead <= 0.2 * spacing * whole, "hmps: the normals of ", mesh.source,
                    " point into the body, whose particles lie ", ahead / whole,
                    " m ahead of the patch: a pressure would pull; swap two corners of each triangle");
  }

  template <class X>
  [[nodiscard]] std::vector<V> corners(const VectorView<X, 3>& x) const {
    std::vector<V> corner(carried_.size());
    carried_(x, vectors(corner));
    return corner;
  }

  double spacing_;  // m
  CarriedSurface<3> carried_;
  std::vector<std::array<Index, 3>> triangles_;
};

}  // namespace hmps::inline HMPS_ABI
