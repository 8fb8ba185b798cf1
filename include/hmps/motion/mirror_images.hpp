// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/direction.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace hmps::inline HMPS_ABI {

/// A plane of symmetry: half a body and, behind the plane, the images of the particles next to it, so that those have
/// all their bonds. The half then moves as the whole body does, at the cost of the images, whereas `hold_component`
/// alone leaves a surface at the plane.
///
///     const hmps::MirrorImages<3> images(hmps::vectors(X), l0, plane, towards_images);
///     ...
///     hmps::drift(x, v, dt);
///     images.place(x, v);
///
/// `force.restrict_to(~images.particles())` saves the forces on the images.
///
/// Fill the body up to two effective radii behind the plane, which are two layers of a lattice along it: F and the
/// force of the images next to the plane must be right as well. The plane may pass through a layer of particles or
/// between two. Count energies, loads and masses of the particles outside `particles()` only, and half of those on the
/// plane. For `relax` and `stable_step`, whose positions are read-only, leave the images out by `moves`, and place them
/// in a copy of the positions before the force is evaluated.
template <int D>
class MirrorImages {
 public:
  /// @param reference  reference positions of all particles in m
  /// @param spacing    l0 in m
  /// @param point      a point of the plane in m
  /// @param normal     of the plane, towards the images, of any nonzero length
  /// Throws `InputError` for a spacing that is not that of the particles, a normal that is zero or not finite, a plane
  /// without particles behind it, and a particle behind the plane that is no image: within a hundredth of a spacing of
  /// its mirrored position there must be a particle.
  template <class T>
  MirrorImages(const VectorView<T, D>& reference, double spacing, const Vector<double, D>& point,
               const Vector<double, D>& normal)
      : point_(point), images_(reference.size(), std::vector<Index>{}), on_plane_(images_) {
    using S = typename VectorView<T, D>::Scalar;
    const Vector<double, D> direction = detail::measurable<double, D>(normal);
    const double length = direction.norm();
    detail::require(detail::all_finite(point) && detail::is_finite(length) && length > 0,
                    "hmps: the plane of mirror images passes through (", point, ") and has the normal (", normal,
                    "); give finite numbers and a normal of nonzero length");
    detail::require_spacing(spacing, "the mirrored particles");
    normal_ = direction / length;
    const double tolerance = 0.01 * spacing;
    const auto height = [&](std::size_t i) { return (reference[i].template cast<double>() - point_).dot(normal_); };
    const FixedRadiusSearch<T, D> search(reference);
    std::vector<Index> images, on_plane, found;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double behind = height(i);
      if (std::abs(behind) <= tolerance / 2) on_plane.push_back(static_cast<Index>(i));
      if (!(behind > tolerance / 2)) continue;
      const Vector<double, D> mirrored = reference[i].template cast<double>() - 2 * behind * normal_;
      search(mirrored.template cast<S>(), static_cast<S>(tolerance), found);
      detail::require(
          found.size() == 1, "hmps: particle ", i, " at (", reference[i], ") m lies ", behind,
          " m behind the plane of symmetry, but ", found.empty() ? "no particle lies" : "several lie",
          " at its mirrored position (", mirrored,
          ") m; fill the body so that it is symmetric there, with a site or the middle of two on the plane");
      images.push_back(static_cast<Index>(i));
      original_.push_back(found.front());
    }
    detail::require(!images.empty(), "hmps: no particle lies behind the plane of symmetry through (", point,
                    ") m; let the normal point towards the images, and fill the body up to two effective radii beyond");
    images_ = ParticleSet(reference.size(), images);
    on_plane_ = ParticleSet(reference.size(), on_plane);
  }

  /// The images.
  [[nodiscard]] const ParticleSet& particles() const { return images_; }

  /// Moves the images to the mirrored positions of their originals in `x` (m), and particles on the plane back to it.
  /// Throws `InputError` for a view of the wrong size.
  template <class X>
  void place(const VectorView<X, D>& x) const {
    mirror(x, "positions", point_);
  }
  /// The same, and gives the images the mirrored velocities `v` (m/s), and particles on the plane none across it.
  template <class X, class V>
  void place(const VectorView<X, D>& x, const VectorView<V, D>& v) const {
    require_size(v, images_.scene_size(), "velocities");
    mirror(x, "positions", point_);
    mirror(v, "velocities", Vector<double, D>(Vector<double, D>::Zero()));
  }

 private:
  /// Mirrors vectors at the plane through `point`.
  template <class T>
  void mirror(const VectorView<T, D>& vectors, const char* name, const Vector<double, D>& point) const {
    static_assert(!std::is_const_v<T>, "hmps: the images are written; give writable views of positions and velocities");
    require_size(vectors, images_.scene_size(), name);
    const auto moved = [&](std::size_t from, double times) {
      const Vector<double, D> own = vectors[from].template cast<double>();
      return Vector<double, D>(own - times * (own - point).dot(normal_) * normal_);
    };
    for (const Index i : on_plane_) vectors.set(i, moved(i, 1));
    for (std::size_t k = 0; k < original_.size(); ++k) vectors.set(images_.indices()[k], moved(original_[k], 2));
  }

  Vector<double, D> point_, normal_;
  ParticleSet images_, on_plane_;
  std::vector<Index> original_;  // of each image
};

}  // namespace hmps::inline HMPS_ABI
