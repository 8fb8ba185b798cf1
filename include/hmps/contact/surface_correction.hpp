// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/central_gradient.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/spacing.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// Corrects the positions at which contact sees the outermost particles of a body that is cut out of a lattice; an
/// extension of the paper.
///
/// A surface that is not aligned with the lattice is a staircase: its outermost particles lie up to a spacing below it,
/// and their metaballs form a stepped wall. This class moves each of them to half a spacing below the surface, where an
/// aligned layer would lie, by an offset in the reference configuration that follows its deformation gradient: x + F d.
/// Only contact should see these positions: mass, bonds and forces stay with the particles. Stores the offsets;
/// positions belong to the caller.
///
/// In each step, call it before the contact, and pass on its result instead of the positions:
///
///     raised(x, F, places);   contact.add(places, v, F, f, dt);
template <class S, int D>
class SurfaceCorrection {
 public:
  /// @param reference  reference positions in m
  /// @param skin       the outermost particles: the slaves of the organ
  /// @param shape      `shape(x)`, approximately the signed distance to the surface in m, negative inside
  /// @param spacing    l0 in m
  /// Throws `InputError` for a spacing that is not that of the skin, a particle that does not exist or lies further
  /// than 1.5 spacings from its proper place, if the shape does not tell which way is out, and if most particles lie
  /// outside the shape: it is inside out.
  template <class T, class Shape>
  SurfaceCorrection(const VectorView<T, D>& reference, std::span<const Index> skin, const Shape& shape, double spacing)
      : skin_(skin.begin(), skin.end()) {
    detail::require_spacing(spacing, "a surface correction");
    require_spacing(reference, spacing);
    std::size_t outside = 0;
    for (const Index i : skin_) {
      const Vector<double, D> start = reference[i].template cast<double>();
      const auto offset = offset_of(start, shape, spacing);
      detail::require(
          offset.has_value(), "hmps: particle ", i, " at (", start, ") cannot be raised to the surface: ",
          "it is not in the outermost layer, or the shape does not tell which way is out there; leave the particle "
          "out, or give a shape that is about the signed distance in m");
      offset_.push_back(offset->template cast<S>());
      particles_ = std::max(particles_, std::size_t{i} + 1);
      outside += distance(shape, start) > 0;
    }
    detail::require(2 * outside <= skin_.size(), "hmps: ", outside, " of ", skin_.size(),
                    " particles of a skin lie outside the shape to which they are raised; is it inside out? A shape "
                    "must be negative inside");
  }

  /// The offset in m of a particle at `start`; empty if the particle is further than 1.5 spacings from its proper place
  /// or the shape gives no outward direction.
  template <class Shape>
  [[nodiscard]] static std::optional<Vector<double, D>> offset_of(const Vector<double, D>& start, const Shape& shape,
                                                                  double spacing) {
    Vector<double, D> place = start;
    // For a true distance the first pass is exact.
    for (int pass = 0; pass < 3; ++pass) {
      const Vector<double, D> outward = detail::central_gradient(
          [&](const Vector<double, D>& x) { return distance(shape, x); }, place, 1e-3 * spacing);
      if (!(outward.squaredNorm() > 1e-2)) return std::nullopt;
      place -= (distance(shape, place) + 0.5 * spacing) / outward.squaredNorm() * outward;
    }
    const Vector<double, D> offset = place - start;
    if (!(offset.norm() < 1.5 * spacing)) return std::nullopt;
    return offset;
  }

  /// Writes the positions for contact to `places`: x, and x + F d for the outermost particles, in m. Throws
  /// `InputError` unless the views have the same size and hold all of these.
  template <class X, class M, class P, Executor E = Serial>
  void operator()(const VectorView<X, D>& x, const MatrixView<M, D>& F, const VectorView<P, D>& places,
                  const E& execute = {}) const {
    require_size(x, x.size(), "positions");
    detail::require(x.size() >= particles_, "hmps: particle ", particles_ - 1,
                    " has a corrected surface but the views hold ", x.size(),
                    " particles; give views of all particles, like that of the reference positions");
    require_size(F, x.size(), "deformation gradients");
    require_size(places, x.size(), "places for contact");
    require_apart(places, "places for contact", x, "positions");
    detail::guarded(execute)(x.size(), [&](std::size_t i) {
      for (int c = 0; c < D; ++c) places(i, c) = static_cast<P>(x(i, c));
    });
    detail::guarded(execute)(skin_.size(), [&](std::size_t k) {
      const Index i = skin_[k];
      const Vector<S, D> shift = F[i].template cast<S>() * offset_[k];
      for (int c = 0; c < D; ++c) places(i, c) = static_cast<P>(x(i, c) + static_cast<X>(shift[c]));
    });
  }

  /// Offsets in the reference configuration in m, in the order of the skin.
  [[nodiscard]] const std::vector<Vector<S, D>>& offsets() const { return offset_; }

 private:
  /// Throws `InputError` for a particle of the skin that does not exist, and unless `spacing` (m) is about the distance
  /// of neighbours in the skin, which on a lattice is up to the diagonal of a cell.
  template <class T>
  void require_spacing(const VectorView<T, D>& reference, double spacing) const {
    constexpr std::size_t fewest = 16;  // for fewer, distances say little
    std::vector<Vector<double, D>> places;
    for (const Index i : skin_) {
      detail::require(i < reference.size(), "hmps: particle ", i, " is to be raised to the surface but there are only ",
                      reference.size(), " particles");
      places.push_back(reference[i].template cast<double>());
    }
    if (places.size() >= fewest) detail::require_spacing_of(vectors(places), spacing, "a surface correction", 1.9);
  }
  template <class Shape>
  [[nodiscard]] static double distance(const Shape& shape, const Vector<double, D>& x) {
    const auto value = shape(Vector<S, D>(x.template cast<S>()));
    static_assert(!std::is_same_v<std::remove_cv_t<decltype(value)>, bool>,
                  "hmps: the shape of a surface correction returns its signed distance in m, negative inside, not "
                  "whether a point is inside");
    return static_cast<double>(value);
  }

  std::vector<Index> skin_;
  std::vector<Vector<S, D>> offset_;
  std::size_t particles_ = 0;  // least number that the views must hold
};

}  // namespace hmps::inline HMPS_ABI
