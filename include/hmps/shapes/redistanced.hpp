// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/detail/pseudonormals.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/isosurface.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `redistanced`. Copies share the surface.
template <class S>
class Redistanced {
 public:
  explicit Redistanced(const SurfaceMesh<S>& isosurface) : surface_(std::make_shared<const Surface>(isosurface)) {}
  // Without moves: these copy, so that one moved from can still be called.
  Redistanced(const Redistanced&) = default;
  Redistanced& operator=(const Redistanced&) = default;
  ~Redistanced() = default;

  /// Signed distance in m of `x` (m), negative inside; NaN where `x` is not finite.
  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    if (!detail::all_finite(x)) return std::numeric_limits<S>::quiet_NaN();
    const Vector<double, 3> place = x.template cast<double>();
    const auto nearest = surface_->tree.nearest(place);
    const Vector<double, 3> normal = surface_->normals(nearest.triangle, nearest.point.part);
    return static_cast<S>(std::copysign(nearest.distance, (place - nearest.point.place).dot(normal)));
  }

 private:
  struct Surface {
    TriangleTree tree;
    detail::Pseudonormals<double> normals;
    explicit Surface(const SurfaceMesh<S>& mesh) : tree(mesh), normals(mesh) {}
  };
  std::shared_ptr<const Surface> surface_;
};

/// The part of any shape that lies in a box, as a shape that is a signed distance: also inside united parts, where the
/// nearest surface may be that of another part, and for implicit functions that are not distances. Functions that need
/// a distance thus take any shape:
///
///     const auto body = redistanced(shape, box, l0 / 4);
///     const auto fitted = fit_particles(body, box, l0);
///
/// The result is the distance to the `isosurface` of the shape, both inside and outside, and has the limits and errors
/// of that surface: parts of the shape thinner than a cell may be lost. The shape is evaluated only while the result is
/// made; afterwards each evaluation costs a search in a tree of triangles.
///
/// @param shape  negative inside
/// @param box    in m; its faces cut the shape
/// @param cell   width of the cells of the isosurface in m
template <class F, class S, Executor E = Serial>
requires Shape<F, S, 3>
[[nodiscard]] Redistanced<S> redistanced(const F& shape, const Box<S, 3>& box, std::type_identity_t<S> cell,
                                         const E& execute = {}) {
  return Redistanced<S>(isosurface(shape, box, cell, execute));
}

}  // namespace hmps::inline HMPS_ABI
