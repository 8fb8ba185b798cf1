// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/carried_surface.hpp"
#include "hmps/search/nearest_spacing.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/surface_patch.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
/// Throws `InputError` if `distance` (m) is larger than the cloud of `points`, as where it is in millimetres.
template <class T>
void require_extent(const VectorView<T, 3>& points, double distance) {
  if (points.size() < 2) return;
  Vector<double, 3> low = points[0].template cast<double>(), high = low;
  for (std::size_t i = 1; i < points.size(); ++i) {
    low = low.cwiseMin(points[i].template cast<double>());
    high = high.cwiseMax(points[i].template cast<double>());
  }
  require(distance <= (high - low).norm(), "hmps: particles within ", distance,
          " m of a patch are asked for, but the particles themselves span ", (high - low).norm(),
          " m only, so that all would be near; give a distance such as the spacing, in metres");
}
}  // namespace detail

/// The particles that lie within `distance` (m) of the patch: those to be held, say, by `hold`, by `ControlRegion` or,
/// as `~particles_near(...)`, by the `moves` of `relax`. One layer, as README.md advises, is within 0.99 spacings of a
/// face along the lattice; of a face at an angle to it that takes one to two layers, of which
/// `surface_layers(...).outermost` are one. Throws `InputError` where there is none, for a distance that is not
/// positive or larger than the body, and for a broken surface.
template <class T, class S, Executor E = Serial>
[[nodiscard]] ParticleSet particles_near(const VectorView<T, 3>& points, const SurfaceMesh<S>& patch, double distance,
                                         const E& execute = {}) {
  detail::require(detail::is_finite(distance) && distance > 0, "hmps: particles within ", distance,
                  " m of a patch are asked for; give a positive distance, such as the spacing");
  require_finite(points, "the position");
  detail::require_extent(points, distance);
  const TriangleTree tree(patch);
  std::vector<char> is_near(points.size(), 0);
  execute(points.size(),
          [&](std::size_t i) { is_near[i] = tree.distance(points[i].template cast<double>()) <= distance ? 1 : 0; });
  ParticleSet found(points.size(), [&](std::size_t i) { return is_near[i] != 0; });
  detail::require(
      !found.empty(), "hmps: no particle lies within ", distance, " m of ", patch.source,
      "; check that both are in metres, and that the body has particles there: a part thinner than a spacing or two "
      "has none, or supported_particles leaves them out; else give a larger distance");
  return found;
}

/// A pressure on a patch of the surface of a body, as force densities on its particles. It follows the surface: it acts
/// across each triangle as it lies now, on its present area.
///
/// The patch is refined to edges of a spacing and carried along (`CarriedSurface`, y = sum phi x). Each triangle with
/// the area vector a gives -p a / 3 to each of its corners, and a corner hands its force on to the particles by the
/// same phi, so that the work of the force on the particles is that of the pressure on the surface. Since sum phi = 1
/// and sum phi x = y, force and torque are those of the pressure on the carried patch, to the rounding of the sums: the
/// force is p times the area vector of the patch; on a whole closed surface force and torque are zero, and the power is
/// -p dV/dt of the volume V in it. The patch itself lies where the body's surface is to the accuracy of
/// `CarriedSurface`.
///
///     const PatchPressure pressure(vectors(reference), patch, l0);
///     force(x, v, f);                            // internal forces, N/m3
///     pressure.add(x, f, 2e3, l0 * l0 * l0);     // 2 kPa pressing on the patch; a negative one pulls
class PatchPressure {
 public:
  /// @param reference  reference positions of the particles in m
  /// @param patch      see `surface_patch`; a whole surface too
  /// @param spacing    l0 in m
  /// @param belongs    `belongs(i)`: whether particle i is of the body; all are by default
  /// Throws as `CarriedSurface` and `refine` do, and `InputError` for a spacing far from that of the particles and a
  /// patch that faces them.
  template <class T, class S, class Belongs = bool (*)(std::size_t)>
  PatchPressure(
      const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch, double spacing,
      const Belongs& belongs = [](std::size_t) { return true; })
      : PatchPressure(reference, Refined<S>{refined(reference, patch, spacing)}, spacing, belongs) {}

  /// Adds to `f` (N/m3) the force densities of `pressure` (Pa, positive where it presses on the body) at the positions
  /// `x` in m, for particles of the `volume` in m3, a number or a `ScalarView`. Runs in order, so that the result does
  /// not depend on threads. Throws `InputError` for views of other sizes, a pressure that is not finite, a volume
  /// that is not positive, and volumes that are not about the cube of the spacing on average.
  template <class X, PerParticle Vol, class F>
  void add(const VectorView<X, 3>& x, const VectorView<F, 3>& f, double pressure, const Vol& volume) const {
    require_size(f, x.size(), "force densities");
    require_apart(f, "force densities", x, "positions");
    detail::require(detail::is_finite(pressure), "hmps: the pressure on a patch is ", pressure,
                    " Pa; give a finite number");
    require_positive(volume, x.size(), "volume", "m3");
    if (x.size() > 0) {
      constexpr double most = 8;
      const double mean = detail::mean_of(volume, x.size());
      const double share = mean / (spacing_ * spacing_ * spacing_);
      detail::require(share < most && share > 1 / most, "hmps: the `volume` of PatchPressure::add is ", mean,
                      " m3 a particle, but the cube of the spacing of ", spacing_,
                      " m that PatchPressure was made with has ", spacing_ * spacing_ * spacing_,
                      " m3; give the volume of one particle, behind the pressure, and the spacing l0 when it is made");
    }
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

  /// The sum of the area vectors of the patch in m2 as it lies at the positions `x`: the force of a pressure p is -p
  /// times it.
  template <class X>
  [[nodiscard]] Vector<double, 3> area_at(const VectorView<X, 3>& x) const {
    const std::vector<V> corner = corners(x);
    V sum = V::Zero();
    for (const auto& t : triangles_) sum += area_vector(corner[t[0]], corner[t[1]], corner[t[2]]);
    return sum;
  }

 private:
  using V = Vector<double, 3>;

  /// A patch that has edges of a spacing already.
  template <class S>
  struct Refined {
    SurfaceMesh<S> mesh;
  };

  /// `patch` with edges of a `spacing` (m), which is checked before: of one that is far too short it would make
  /// millions of triangles.
  template <class T, class S>
  [[nodiscard]] static SurfaceMesh<S> refined(const VectorView<T, 3>& reference, const SurfaceMesh<S>& patch,
                                              double spacing) {
    detail::require(detail::is_finite(spacing) && spacing > 0, "hmps: the spacing of PatchPressure is ", spacing,
                    " m; give the particles' positive distance in the reference configuration");
    require_finite(reference, "the reference position");
    detail::require_spacing_of(reference, spacing, "PatchPressure");
    return refine(patch, spacing);
  }

  template <class T, class S, class Belongs>
  PatchPressure(const VectorView<T, 3>& reference, const Refined<S>& fine, double spacing, const Belongs& belongs)
      : spacing_(spacing),
        carried_(reference, vectors(fine.mesh.vertices), spacing, belongs),
        triangles_(fine.mesh.triangles) {
    require_outward(reference, fine.mesh, spacing);
  }

  /// Throws `InputError` if, on the whole, the particles lie on that side of the patch to which its normals point.
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
    // On an outer surface they lie half a spacing and more behind it, on a middle surface neither ahead nor behind.
    detail::require(ahead <= 0.2 * spacing * whole, "hmps: the normals of ", mesh.source,
                    " point into the body, whose particles lie ", ahead / whole,
                    " m ahead of it: a pressure would pull; swap two corners of each triangle");
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
