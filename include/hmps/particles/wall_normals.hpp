// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <cstddef>
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
#include "hmps/core/view_checks.hpp"
#include "hmps/particles/fitted.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The direction along which `shape` varies around `x`: that in which the squares of its slopes at points a quarter of
/// a spacing away sum to most. The slope at `x` itself would be zero in the middle of a wall.
template <class F, int D>
[[nodiscard]] Vector<double, D> direction_of_slope(const F& shape, const Vector<double, D>& x, double spacing) {
  const double apart = spacing / 4, reach = spacing / 50;
  Eigen::Matrix<double, D, D> squares = Eigen::Matrix<double, D, D>::Zero();
  for (int k = 0; k < 2 * D; ++k) {
    Vector<double, D> at = x;
    at[k / 2] += k % 2 ? apart : -apart;
    const Vector<double, D> slope = central_gradient(shape, at, reach);
    squares += slope * slope.transpose();
  }
  require(is_finite(squares.sum()), "hmps: the shape of a wall is NaN or infinite within half a spacing of (", x,
          "); it must have a value at every particle");
  require(squares.trace() > 0, "hmps: the shape of a wall does not change within half a spacing of (", x,
          "), so that it has no normal; give its signed distance, or redistanced(shape, box, spacing / 4)");
  return Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, D, D>>(squares).eigenvectors().col(D - 1);
}

}  // namespace detail

/// Returns the unit normal of the wall at each of the `positions` in the reference configuration, for
/// `impose_plane_stress`. It may point to either side. Along edges it is that of one of the faces, or lies in between.
///
/// @param shape      of the body, about its signed distance around the particles; of a mesh, `MeshDistance`
/// @param positions  reference positions in m
/// @param spacing    l0 in m
/// Throws `InputError` for a spacing that is not positive, and, with the position, for a shape that is not finite or
/// does not change around a particle, and where the scalar type does not resolve a hundredth of the spacing.
template <class F, class S, int D, Executor E = Serial>
[[nodiscard]] auto wall_normals(const F& shape, const VectorView<S, D>& positions, double spacing,
                                const E& execute = {}) {
  using T = std::remove_const_t<S>;
  static_assert(Shape<F, T, D>, "hmps: a shape is a callable that returns the signed distance at a position in m");
  static_assert(detail::RequireDistance<F, Vector<T, D>>::value);
  detail::require_spacing(spacing, "a wall");
  detail::require_resolved(positions, spacing);
  std::vector<Vector<T, D>> normals(positions.size());
  const auto distance = [&shape](const Vector<double, D>& x) { return shape(Vector<T, D>(x.template cast<T>())); };
  detail::guarded(execute)(positions.size(), [&](std::size_t i) {
    const Vector<double, D> x = positions[i].template cast<double>();
    normals[i] = detail::direction_of_slope(distance, x, spacing).template cast<T>();
  });
  return normals;
}

/// The same for fitted particles; zero in bulk, where they have no layers.
template <class F, class S, int D, Executor E = Serial>
[[nodiscard]] std::vector<Vector<S, D>> wall_normals(const F& shape, const FittedParticles<S, D>& fitted,
                                                     std::type_identity_t<S> spacing, const E& execute = {}) {
  detail::require(fitted.layers.size() == fitted.size(), "hmps: fitted particles have ", fitted.size(),
                  " positions, but layers for ", fitted.layers.size(), "; give what fit_particles returned");
  auto normals = wall_normals(shape, vectors(fitted.positions), static_cast<double>(spacing), execute);
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (fitted.layers[i] == 0) normals[i].setZero();
  return normals;
}

}  // namespace hmps::inline HMPS_ABI
