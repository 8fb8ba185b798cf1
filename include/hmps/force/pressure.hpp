// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// A pressure on the surface of a body that follows its deformation. In the reference configuration, each particle near
/// the surface has an outward area per volume, in 1/m,
///
///     b_i = - sum_j w_ij (A_i^-1 + A_j^-1) r0_ij,
///
/// the force density with which a uniform unit stress would be in equilibrium on these bonds; it vanishes inside. A
/// pressure p (Pa) exerts
///
///     f_i = - p J F^-T b_i = - p cof(F_i) b_i
///
/// (Nanson's formula), so that a body under uniform pressure is in exact equilibrium. The area of a face is distributed
/// over two layers for each layer that a bond reaches, which are two for the radius of \paper{8} and four from two
/// spacings on, and adds up to the area of the face. In a wall of fewer than twice these layers the areas of its two
/// faces fall on the same particles and cancel partly or completely: use `PatchPressure` there.
///
/// A particle near an edge has the areas of both faces, so that a load on a face with free edges also presses on the
/// rims of the faces beside it: a column of 12 x 12 x 20 mm that shortens by 27 % shortens by 24 % of that too little
/// at a spacing of 2 mm, by 16 % at 1 mm. Give the direction of a plane face: only the part of b along it acts then,
/// which is in exact equilibrium with the uniaxial stress of the column, and the errors are 2.9 and 1.4 %
/// (`PatchPressure`: 3.6 and 2.4 %).
///
/// On a curved face in three dimensions `PatchPressure` comes first. With `Pressure`, take the layers of a curved face
/// from `surface_layers`, and those of the bore alone by a predicate:
///
///     const auto layers = surface_layers(vectors(X), l0);
///     const ParticleSet inner(X.size(), [&](std::size_t i) { return X[i].norm() < (Ri + Ro) / 2; });
///     const Pressure pressure(bonds, ParticleSet(X.size(), layers.two_outermost) & inner);
///
/// In the bore of a ring in the plane of radius Ri = 5 l0, half as wide as the body, a pressure on the undeformed body
/// then does 0.97 to 1.05 times the exact work when the bore widens, over 100 positions of a lattice, and 0.92 to 1.04
/// times over ten fits; from Ri = 10 l0 on 1.00 to 1.03, and 0.95 to 1.03 if fitted. In hollow spheres it is up to 1.09
/// on a lattice. With the particles up to Ri + 2 l0 it is up to 1.12 on a lattice, because some particles below the
/// steps of the face are missing. On a lattice, but not with fitted particles, all particles of `inner` may be loaded,
/// because b_i vanishes inside. docs/choosing.md has a table.
///
/// The forces in a closed cavity sum to zero only approximately. With the two layers, the net force is at most 1.4, 0.8
/// and 0.3 % of p A in tubes of Ri = 5, 10 and 20 l0 on a lattice, 0.5 % in spheres on a lattice and 0.9 % in fitted
/// ones, but 1 to 5 % in fitted rings in the plane, because b_i does not quite vanish inside an irregular cloud. Under
/// such a force `relax` finds no rest for a free body: subtract the mean force, or use `PatchPressure`, whose net force
/// is zero.
template <int D>
class Pressure {
 public:
  /// Loads the particles of `loaded`, which should contain all particles that carry the area of the loaded face: with
  /// the paper's radius the two outermost layers, with a radius from two spacings on the four outermost. `bonds` are
  /// used only in the constructor. Throws `InputError` if the set has the wrong size or contains no particle near a
  /// surface, for a wall of fewer than twice these layers, and if behind most particles of the face a particle of these
  /// layers is missing, as in a set of the outermost layer alone, which has about 1.5 times the area of the face.
  template <Bonds B>
  requires(B::dimension == D) Pressure(const B& bonds, const ParticleSet& loaded)
      : Pressure([](const Vector<double, D>& area) { return area; }, bonds, loaded) {}
  /// The same for a plane face with the outward `direction` in the reference configuration, of any length: without the
  /// area of the faces beside it, which may belong to a thin column. Throws `InputError` for a direction that is zero
  /// or not finite, too, and for one in which the loaded particles have no area, such as an inward one.
  template <Bonds B>
  requires(B::dimension == D) Pressure(const B& bonds, const ParticleSet& loaded, const Vector<double, D>& direction)
      : Pressure([outward = unit(direction)](
                     const Vector<double, D>& area) -> Vector<double, D> { return area.dot(outward) * outward; },
                 bonds, loaded) {
    double along = 0, size = 0;
    for (const auto& own : area_) along += own.dot(unit(direction)), size += own.norm();
    detail::require(along > 0.1 * size, "hmps: the particles under pressure have no area in the direction (", direction,
                    "); give the outward normal of their face");
  }

  /// Adds the force density (N/m3) of the pressure `p` (Pa, positive if it pushes inwards) at the deformation gradients
  /// `F` to `f`. Throws `InputError` for views of the wrong size, a pressure that is not finite, and a deformation
  /// gradient that is zero because nothing has written it.
  template <class M, class T, Executor E = Serial>
  void add(const MatrixView<M, D>& F, const VectorView<T, D>& f, double p, const E& execute = {}) const {
    require_size(F, size_, "deformation gradients");
    require_size(f, size_, "force densities");
    detail::require(detail::is_finite(p), "hmps: the pressure is ", p, " Pa; give a finite number");
    for (const Index i : particles_)
      detail::require(
          !F[i].isZero(0), "hmps: the deformation gradient of particle ", i,
          " is zero, so that no pressure acts there: evaluate the force with `record(F)` among its terms, or "
          "`deformation_gradient`, before the pressure");
    detail::guarded(execute)(particles_.size(), [&](std::size_t k) {
      const Index i = particles_[k];
      const Matrix<double, D> gradient = F[i].template cast<double>();
      f.add(i, Vector<double, D>(-p * (cofactor(gradient) * area_[k])));
    });
  }

  /// Explains calls with arrays in place of views.
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> add(const Arguments&...)
  const;

  /// The outward area vector of the loaded particles in the reference configuration, in m2 (in two dimensions m), if
  /// each has the volume `volume` (m^D): for a plane face its area along its normal, for a closed surface zero. Throws
  /// `InputError` for a volume that cannot be that of a particle with these bonds.
  [[nodiscard]] Vector<double, D> area(double volume) const {
    detail::require_cell_volume<D>(volume, bond_, detail::volume_factor_of_bonds,
                                   "the volume of a particle under pressure", "a bond");
    Vector<double, D> sum = Vector<double, D>::Zero();
    for (const auto& own : area_) sum += own * volume;
    return sum;
  }

 private:
  /// Of each area per volume only `part(b)` acts.
  template <Bonds B, std::invocable<const Vector<double, D>&> Part>
  Pressure(const Part& part, const B& bonds, const ParticleSet& loaded)
      : size_(bonds.size()),
        bond_(std::sqrt(bonds.standard_lambda())),
        particles_(loaded.indices()),
        area_(particles_.size()) {
    detail::require_scene(loaded, size_, "under pressure");
    double largest = 0, least = 0;  // |b| at a face is of the order of one over the length of a bond
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      area_[k] = part(area_per_volume(bonds, particles_[k]));
      bonds.for_each_bond(particles_[k], [&](std::size_t, const auto& r0, auto) {
        least = std::max(least, 1e-3 / r0.template cast<double>().norm());
      });
      largest = std::max(largest, area_[k].norm());
    }
    detail::require(largest > least, "hmps: none of the ", particles_.size(),
                    " particles under pressure is near a surface; name those of the outermost layers");
    const double spacing = nearest_neighbours(bonds);
    const int layers = 2 * layers_of_a_bond(bonds, largest, spacing);
    require_thick(bonds, largest, spacing, 2 * layers);
    require_layers(bonds, loaded, largest, spacing, layers);
  }
  [[nodiscard]] static Vector<double, D> unit(const Vector<double, D>& direction) {
    const double length = direction.norm();
    detail::require(detail::is_finite(length) && length > 0, "hmps: the direction of the face under pressure is (",
                    direction, "); give its outward normal");
    return direction / length;
  }
  /// b_i in 1/m.
  template <Bonds B>
  [[nodiscard]] static Vector<double, D> area_per_volume(const B& bonds, std::size_t i) {
    Vector<double, D> area = Vector<double, D>::Zero();
    const Matrix<double, D> own = bonds.shape_inverse(i).template cast<double>();
    bonds.for_each_bond(i, [&](std::size_t j, const auto& r0, auto w) {
      const Vector<double, D> r = r0.template cast<double>();
      area -= static_cast<double>(w) * ((own + bonds.shape_inverse(j).template cast<double>()) * r);
    });
    return area;
  }
  /// How far in m the body extends behind particle `i`, against `outward` (a unit vector), followed over up to `steps`
  /// bonds.
  template <Bonds B>
  [[nodiscard]] static double depth_behind(const B& bonds, std::size_t i, const Vector<double, D>& outward, int steps) {
    constexpr double astray = 0.3;  // penalty per metre of distance from the straight line
    Vector<double, D> way = Vector<double, D>::Zero();
    for (int step = 0; step < steps; ++step) {
      double best = -way.dot(outward) - astray * (way - way.dot(outward) * outward).norm();
      Vector<double, D> further = way;
      std::size_t next = i;
      bonds.for_each_bond(i, [&](std::size_t j, const auto& r0, auto) {
        const Vector<double, D> to = way + r0.template cast<double>();
        const double down = -to.dot(outward), score = down - astray * (to + down * outward).norm();
        if (score > best) best = score, further = to, next = j;
      });
      if (next == i) break;
      i = next;
      way = further;
    }
    return -way.dot(outward);
  }
  /// How many layers down a bond from a face reaches: the mean over particles of the face, so that a fitted particle
  /// that lies closer below it than others does not count as a layer. At edges and corners, whose area is larger and
  /// aslant, bonds reach less far along it: with the `largest` area of an edge or a corner, the faces have 0.71 or 0.58
  /// of it.
  template <Bonds B>
  [[nodiscard]] int layers_of_a_bond(const B& bonds, double largest, double spacing) const {
    const auto is_of_face = [&](double size) { return size >= 0.5 * largest && size <= 0.75 * largest; };
    const bool has_edges =
        std::any_of(area_.begin(), area_.end(), [&](const auto& own) { return is_of_face(own.norm()); });
    double sum = 0, count = 0;
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      const double size = area_[k].norm();
      if (has_edges ? !is_of_face(size) : size < 0.5 * largest) continue;
      double deepest = 0;
      bonds.for_each_bond(particles_[k], [&](std::size_t, const auto& r0, auto) {
        deepest = std::max(deepest, -r0.template cast<double>().dot(area_[k]) / size);
      });
      sum += deepest;
      count += 1;
    }
    constexpr double unlike = 0.15;  // spacings by which a depth may fall short of its layer
    return std::max(1, static_cast<int>(std::floor(sum / (count * spacing) + unlike)));
  }
  /// The mean distance in m of the loaded particles from their nearest neighbours.
  template <Bonds B>
  [[nodiscard]] double nearest_neighbours(const B& bonds) const {
    double spacing = 0;
    for (const Index i : particles_) {
      double nearest = std::numeric_limits<double>::max();
      bonds.for_each_bond(i, [&](std::size_t, const auto& r0, auto) {
        nearest = std::min(nearest, r0.template cast<double>().norm());
      });
      spacing += nearest / static_cast<double>(particles_.size());
    }
    return spacing;
  }
  /// Throws `InputError` if the body has too few layers behind a face, fewer than `needed`: the area of the face lies
  /// in its outermost layers, twice as many as a bond reaches down, and that of the opposite face in as many on the
  /// other side. Layers of fitted walls may be closer or wider apart than a spacing: to be safe, walls of enough layers
  /// that lie closer are rejected too.
  template <Bonds B>
  void require_thick(const B& bonds, double largest, double spacing, int needed) const {
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      const double size = area_[k].norm();
      if (size < 0.5 * largest) continue;
      const double depth = depth_behind(bonds, particles_[k], area_[k] / size, needed - 1);
      detail::require(depth > (needed - 1.15) * spacing, "hmps: the body reaches only ", depth, " m behind particle ",
                      particles_[k], " under pressure, fewer layers than the ", needed,
                      " that its bonds need: the areas of the two faces of such a wall fall on the same particles "
                      "and cancel; load it with PatchPressure, or give it more layers");
    }
  }
  /// Throws `InputError` unless the particles behind most particles of the face are loaded, down to the number of
  /// `layers` that carry its area. Some may be missing, because a face may lie aslant in a lattice or be loaded in
  /// part.
  template <Bonds B>
  void require_layers(const B& bonds, const ParticleSet& loaded, double largest, double spacing, int layers) const {
    std::size_t of_face = 0, bare = 0, above = 0, missing = 0;
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      const double size = area_[k].norm();
      if (size < 0.5 * largest) continue;
      ++of_face;
      Vector<double, D> way = Vector<double, D>::Zero();
      std::size_t i = particles_[k];
      for (int layer = 1; layer < layers && loaded(i); ++layer) {
        const Vector<double, D> from = way, goal = -layer * spacing / size * area_[k];
        double least = std::numeric_limits<double>::max();
        bonds.for_each_bond(std::size_t{i}, [&](std::size_t j, const auto& r0, auto) {
          const Vector<double, D> to = from + r0.template cast<double>();
          if ((to - goal).norm() >= least) return;
          least = (to - goal).norm();
          i = j;
          way = to;
        });
      }
      if (loaded(i) || bare++ > 0) continue;
      above = particles_[k];
      missing = i;
    }
    detail::require(static_cast<double>(bare) < 0.7 * static_cast<double>(of_face), "hmps: particle ", missing,
                    " below particle ", above, " of a face under pressure is not loaded, and so it is below ", bare,
                    " of ", of_face, " particles of the face: its area lies in its ", layers,
                    " outermost layers, and the outermost alone has about 1.5 times that area; load all of them, for "
                    "two layers the `two_outermost` of surface_layers, and give the direction of a face that is "
                    "loaded along an edge");
  }

  std::size_t size_;
  double bond_;  // m, the length of a bond
  std::vector<Index> particles_;
  std::vector<Vector<double, D>> area_;
};
template <Bonds B>
Pressure(const B&, const ParticleSet&) -> Pressure<B::dimension>;
template <Bonds B>
Pressure(const B&, const ParticleSet&, const Vector<double, B::dimension>&) -> Pressure<B::dimension>;

}  // namespace hmps::inline HMPS_ABI
