// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// A plane of symmetry: half a body and, behind the plane, images of the particles next to it, so that those have all
/// their bonds. The half then moves as the whole body does, whereas `hold_component` alone leaves a surface at the
/// plane.
///
///     const MirrorImages<3> images(vectors(X), l0, plane, towards_images);
///     force.restrict_to(~images.particles());  // saves the forces on the images
///     images.place(x, v);                      // before the first step, and after each drift
///
/// Fill the body up to two effective radii behind the plane, which are two layers of a lattice along it: F of the
/// images next to the plane must be right as well. With `mean_dilatation` take four, and with `mean_dilatation<2>`, so
/// with `thin_wall_stabiliser`, six; its scales depend on the whole body, so that the halves then agree to 5e-5 l0
/// instead of to rounding (the tests `MirrorImages`). The plane may pass through a layer of particles or between two.
/// Fitted particles have no symmetric order: fit the half alone, and append its mirrored particles and their volumes.
///
/// Count energies, loads and masses of the particles outside `particles()` only, and half of those on the plane. In
/// `relax` and `stable_step`, positions and velocities are read-only: leave the images out by `moves`, give `relax` its
/// `load`, let the force be evaluated on copies of both in which it places the images, and afterwards call
/// `place(x, v)`.
template <int D>
class MirrorImages {
 public:
  /// @param reference  reference positions of all particles in m
  /// @param spacing    l0 in m
  /// @param point      a point of the plane in m
  /// @param normal     of the plane, towards the images, of any nonzero length
  /// Throws `InputError` for a spacing that is far from that of the particles, a normal that is zero or not finite, a
  /// plane without particles behind it, a particle behind the plane that is no image (within a hundredth of a spacing
  /// of its mirrored position there must be one particle), images that reach no further than 1.25 spacings, and
  /// particles without an image where others at their distance from the plane have one.
  template <class T>
  MirrorImages(const VectorView<T, D>& reference, double spacing, const Vector<double, D>& point,
               const Vector<double, D>& normal)
      : images_(reference.size(), std::vector<Index>{}), on_plane_(images_) {
    using S = typename VectorView<T, D>::Scalar;
    const Vector<double, D> direction = detail::measurable<double, D>(normal);
    const double length = direction.norm();
    detail::require(detail::all_finite(point) && detail::is_finite(length) && length > 0,
                    "hmps: the plane of mirror images passes through (", point, ") and has the normal (", normal,
                    "); give finite numbers and a normal of nonzero length");
    detail::require_spacing(spacing, "mirror images");
    detail::require_spacing_of(reference, spacing, "mirror images");
    normal_ = direction / length;
    const double tolerance = 0.01 * spacing;
    const FixedRadiusSearch<T, D> search(reference);
    std::vector<Index> images, on_plane, found;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const Vector<double, D> own = reference[i].template cast<double>();
      const double behind = (own - point).dot(normal_);
      if (std::abs(behind) <= tolerance / 2) {
        on_plane.push_back(static_cast<Index>(i));
        height_.push_back(own.dot(normal_));
      }
      if (!(behind > tolerance / 2)) continue;
      const Vector<double, D> mirrored = own - 2 * behind * normal_;
      search(mirrored.template cast<S>(), static_cast<S>(tolerance), found);
      detail::require(
          found.size() == 1, "hmps: particle ", i, " at (", own, ") m lies ", behind,
          " m behind the plane of symmetry, but ", found.empty() ? "no particle lies" : "several lie",
          " at its mirrored position (", mirrored,
          ") m; fill the body so that it is symmetric there, with a site or the middle of two on the plane");
      images.push_back(static_cast<Index>(i));
      original_.push_back(found.front());
      shift_.push_back(own - reflected(reference[found.front()].template cast<double>()));
    }
    detail::require(!images.empty(), "hmps: no particle lies behind the plane of symmetry through (", point,
                    ") m; let the normal point towards the images, and fill the body up to two effective radii beyond");
    require_complete(reference, point, spacing);
    images_ = ParticleSet(reference.size(), images);
    on_plane_ = ParticleSet(reference.size(), on_plane);
  }

  /// The images.
  [[nodiscard]] const ParticleSet& particles() const { return images_; }

  /// Gives the images the mirrored displacements of their originals in `x` (m), and moves particles on the plane back
  /// to it. Throws `InputError` for a view of the wrong size.
  template <class X>
  void place(const VectorView<X, D>& x) const {
    static_assert(!std::is_const_v<X>, "hmps: the images are moved; give a writable view of the positions");
    require_size(x, images_.scene_size(), "positions");
    for (std::size_t k = 0; k < height_.size(); ++k) {
      const Index i = on_plane_.indices()[k];
      const Vector<double, D> own = x[i].template cast<double>();
      x.set(i, Vector<double, D>(own + (height_[k] - own.dot(normal_)) * normal_));
    }
    for (std::size_t k = 0; k < original_.size(); ++k)
      x.set(images_.indices()[k], Vector<double, D>(reflected(x[original_[k]].template cast<double>()) + shift_[k]));
  }
  /// The same, and gives the images the mirrored velocities `v` (m/s), and particles on the plane none across it.
  template <class X, class V>
  void place(const VectorView<X, D>& x, const VectorView<V, D>& v) const {
    static_assert(!std::is_const_v<V>, "hmps: velocities of images are written; give a writable view of them");
    require_size(v, images_.scene_size(), "velocities");
    place(x);
    for (const Index i : on_plane_) {
      const Vector<double, D> own = v[i].template cast<double>();
      v.set(i, Vector<double, D>(own - own.dot(normal_) * normal_));
    }
    for (std::size_t k = 0; k < original_.size(); ++k)
      v.set(images_.indices()[k], reflected(v[original_[k]].template cast<double>()));
  }

 private:
  template <class T>
  void require_complete(const VectorView<T, D>& reference, const Vector<double, D>& point, double spacing) const {
    const auto before = [&](std::size_t i) { return (point - reference[i].template cast<double>()).dot(normal_); };
    const ParticleSet originals(reference.size(), original_);
    double reach = 0;
    for (const Index i : original_) reach = std::max(reach, before(i));
    detail::require(reach > 1.25 * spacing, "hmps: the images reach only ", reach,
                    " m behind the plane of symmetry, less than two layers; fill the body up to two effective radii "
                    "behind it");
    for (std::size_t i = 0; i < reference.size(); ++i)
      detail::require(originals(i) || before(i) < 0.01 * spacing || before(i) > reach - 0.01 * spacing,
                      "hmps: particle ", i, " at (", reference[i], ") m lies ", before(i),
                      " m in front of the plane of symmetry and has no image, but others that lie up to ", reach,
                      " m in front of it have one; fill the body behind the plane as in front of it");
  }
  [[nodiscard]] Vector<double, D> reflected(const Vector<double, D>& vector) const {
    return vector - 2 * vector.dot(normal_) * normal_;
  }

  Vector<double, D> normal_;
  ParticleSet images_, on_plane_;
  std::vector<Index> original_;           // of each image
  std::vector<Vector<double, D>> shift_;  // m, from the reflected reference position of an original to its image's
  std::vector<double> height_;            // m, of each particle on the plane, along the normal
};

}  // namespace hmps::inline HMPS_ABI
