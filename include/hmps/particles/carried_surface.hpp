// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

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
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// Points that a body carries along, such as the vertices of the surface from which it was filled, for smooth pictures
/// and for loads on the surface. Their positions y are interpolated from the particle positions x_k by first-order
/// moving least squares (Lancaster and Salkauskas 1981; Belytschko, Lu and Gu 1994), with constant coefficients,
///
///     y = sum_k phi_k x_k,    phi_k = w_k / sum w (1 + (X_k - m) . C^-1 (Y - m))
///
/// Here m and C are the mean and the covariance, both weighted by w, of the reference positions X_k of the particles
/// within a radius of the point's reference position Y, and w = (1 - (|X - Y| / radius)^2)^2. The radius is two
/// spacings, or more where particles are few: it exceeds the distance of the nearest one by at least a spacing, and is
/// so large that the particles span space well. Since sum phi = 1 and sum phi X = Y, every affine motion of the
/// particles is followed exactly, and where the motion has second derivatives of size c (1/m) the error is at most
/// c / 2 sum |phi_k| |X_k - Y|^2. Points may lie outside the particles, as surfaces do by about half a spacing.
///
///     const CarriedSurface carried(vectors(reference), vectors(mesh.vertices), l0);
///     std::vector<Vector<double, 3>> vertices(mesh.vertices.size());
///     carried(x, vectors(vertices));
///     write_vtu("organ.vtu", vectors(vertices), {}, {.triangles = mesh.triangles});
template <int D = 3>
class CarriedSurface {
  static_assert(D == 2 || D == 3, "hmps: points are carried in 2 or 3 dimensions");

 public:
  /// A particle's share in a point.
  struct Share {
    Index particle;
    double weight;  ///< phi; may be negative
    double mean;    ///< w over the sum of w, for `mean`
  };

  /// @param reference  reference positions of the particles in m
  /// @param points     reference positions of the points in m
  /// @param spacing    l0 in m
  /// @param belongs    `belongs(i)`: whether particle i belongs to the body that carries the points; by default all do
  /// Throws `InputError` for a spacing that is not positive or far above that of the particles, a set `belongs` of
  /// another scene, positions that are not finite, no particles, and, with its position, a point whose radius would
  /// exceed 8 spacings: one more than about 6 spacings from a thick body, and one beside a single flat layer.
  template <class T, class P, class Belongs = bool (*)(std::size_t), Executor E = Serial>
  CarriedSurface(
      const VectorView<T, D>& reference, const VectorView<P, D>& points, double spacing,
      const Belongs& belongs = [](std::size_t) { return true; }, const E& execute = {})
      : particles_(reference.size()) {
    detail::require_spacing(spacing, "a carried surface");
    detail::require(reference.size() > 0, "hmps: a carried surface was given no particles");
    require_view(points, "points");
    for (std::size_t p = 0; p < points.size(); ++p)
      for (int c = 0; c < D; ++c)
        detail::require(detail::is_finite(points(p, c)), "hmps: component ", c, " of the place of point ", p,
                        " of a carried surface is ", points(p, c), "; every component must be a finite number");
    const FixedRadiusSearch<T, D> search(reference);
    using S = typename VectorView<T, D>::Scalar;
    detail::require_plausible_spacing(search, {spacing, 2}, static_cast<S>(2 * spacing), false);
    detail::require_scene(belongs, reference.size(), "that carry a surface");
    std::vector<std::vector<Share>> shares(points.size());
    detail::guarded(execute)(points.size(), [&](std::size_t p) {
      shares[p] = shares_of(search, points[p].template cast<double>(), spacing, belongs, p);
    });
    for (const auto& of_point : shares) {
      share_.insert(share_.end(), of_point.begin(), of_point.end());
      offset_.push_back(share_.size());
    }
  }

  /// The number of points; 0 after a move.
  [[nodiscard]] std::size_t size() const { return offset_.empty() ? 0 : offset_.size() - 1; }
  /// The shares of particles in point `p`, sorted by particle. Throws `InputError` for a point that does not exist.
  [[nodiscard]] std::span<const Share> shares(std::size_t p) const {
    detail::require_index(p, size(), "point", "the carried surface has");
    return std::span(share_).subspan(offset_[p], offset_[p + 1] - offset_[p]);
  }

  /// Writes the positions in m of the points to `places`, for the positions `x` (m) of the particles. Throws
  /// `InputError` for views of the wrong size or of the same memory.
  template <class X, class P, Executor E = Serial>
  void operator()(const VectorView<X, D>& x, const VectorView<P, D>& places, const E& execute = {}) const {
    require_size(x, particles_, "positions");
    require_size(places, size(), "places");
    require_apart(places, "places", x, "positions");
    detail::guarded(execute)(size(), [&](std::size_t p) {
      Vector<double, D> place = Vector<double, D>::Zero();
      for (const Share& share : shares(p))
        for (int c = 0; c < D; ++c) place[c] += share.weight * static_cast<double>(x(share.particle, c));
      for (int c = 0; c < D; ++c) places(p, c) = static_cast<P>(place[c]);
    });
  }

  /// Writes to `values` the `quantity` of the particles, interpolated to the points with the same coefficients: exact
  /// where it is linear in space. Outside the particles it is extrapolated and may leave the range of their values,
  /// even below zero: for a smooth picture of a stress use `mean`. Throws `InputError` for views of the wrong size or
  /// of the same memory.
  template <class Q, class P, Executor E = Serial>
  void interpolate(const ScalarView<Q>& quantity, const ScalarView<P>& values, const E& execute = {}) const {
    combine(&Share::weight, quantity, values, execute);
  }
  /// Writes to `values` the mean of `quantity` over the particles around each point, weighted by w. It stays within the
  /// range of their values, and on a surface it is rather the value about a spacing below. Throws `InputError` for
  /// views of the wrong size or of the same memory.
  template <class Q, class P, Executor E = Serial>
  void mean(const ScalarView<Q>& quantity, const ScalarView<P>& values, const E& execute = {}) const {
    combine(&Share::mean, quantity, values, execute);
  }

 private:
  template <class Q, class P, class E>
  void combine(double Share::*factor, const ScalarView<Q>& quantity, const ScalarView<P>& values,
               const E& execute) const {
    require_size(quantity, particles_, "a quantity");
    require_size(values, size(), "values");
    require_apart(values, "values", quantity, "a quantity");
    detail::guarded(execute)(size(), [&](std::size_t p) {
      double sum = 0;
      for (const Share& share : shares(p)) sum += share.*factor * static_cast<double>(quantity[share.particle]);
      values[p] = static_cast<P>(sum);
    });
  }

  template <class T, class Belongs>
  [[nodiscard]] static std::vector<Share> shares_of(const FixedRadiusSearch<T, D>& search,
                                                    const Vector<double, D>& point, double spacing,
                                                    const Belongs& belongs, std::size_t p) {
    using S = typename VectorView<T, D>::Scalar;
    std::vector<Index> found;
    for (double radius = 2 * spacing; radius < 8.5 * spacing; radius += spacing / 2) {
      search(point.template cast<S>(), static_cast<S>(radius), found);
      std::erase_if(found, [&](Index k) { return !belongs(std::size_t{k}); });
      std::vector<Share> shares;
      if (solve(search.points(), point, spacing, radius, found, shares)) return shares;
    }
    const std::string hint = detail::spacing_hint(search.points(), spacing, 0.5);
    detail::throw_input_error(
        {"hmps: point ", p, " of a carried surface, at (", point,
         "), lies too far from the particles: those within 8 "
         "spacings of ",
         spacing,
         " m, weighted by their distance, are too few or do not span space; check that surface and particles belong to "
         "one body and "
         "are in the same unit: a wall of one layer carries no surface, nor does a part that "
         "supported_particles or `belongs` left out",
         hint});
  }

  /// Writes the shares of the particles `found` within `radius`; returns false if the radius should be larger.
  template <class T>
  [[nodiscard]] static bool solve(const VectorView<T, D>& reference, const Vector<double, D>& point, double spacing,
                                  double radius, const std::vector<Index>& found, std::vector<Share>& shares) {
    // The mean and the covariance of the particles' positions relative to the point, in spacings.
    using Offset = Eigen::Matrix<double, D, 1>;
    const auto offset = [&](Index k) {
      Offset q;
      for (int c = 0; c < D; ++c) q[c] = (static_cast<double>(reference(k, c)) - point[c]) / spacing;
      return q;
    };
    double sum = 0, nearest = radius;
    Offset mean = Offset::Zero();
    Eigen::Matrix<double, D, D> covariance = Eigen::Matrix<double, D, D>::Zero();
    for (const Index k : found) {
      const Offset q = offset(k);
      const double distance = spacing * q.norm();
      nearest = std::min(nearest, distance);
      shares.push_back({k, weight(distance / radius), 0});
      const double w = shares.back().weight;
      sum += w;
      mean += w * q;
      covariance += w * q * q.transpose();
    }
    if (found.size() <= D || nearest + spacing > radius) return false;
    mean /= sum;
    covariance = (covariance / sum - mean * mean.transpose()).eval();
    // The least spread of the particles about their mean tells how well they span space.
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>> spread;
    spread.computeDirect(covariance, Eigen::EigenvaluesOnly);
    if (spread.eigenvalues()[0] < least_spread) return false;
    // The value at the point of the regression plane through the particles' values.
    const Offset slope = covariance.inverse() * mean;
    for (Share& share : shares) {
      share.mean = share.weight / sum;
      share.weight = share.mean * (1 - slope.dot(offset(share.particle) - mean));
    }
    return true;
  }
  [[nodiscard]] static double weight(double s) {
    const double w = 1 - std::min(s * s, 1.0);
    return w * w;
  }
  /// Two layers, one of which has a few per cent of the weight, have a least spread of 0.03.
  static constexpr double least_spread = 0.03;

  std::size_t particles_;
  std::vector<std::size_t> offset_{0};
  std::vector<Share> share_;
};

}  // namespace hmps::inline HMPS_ABI
