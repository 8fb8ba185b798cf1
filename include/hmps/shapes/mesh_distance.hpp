// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <limits>
#include <memory>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

/// The signed distance to a triangle surface, as a shape: `fill_lattice(shape, box, ...)`, `SurfaceCorrection`, the
/// combinators and everything else that takes a shape thus takes a mesh.
///
///     const MeshDistance<double> organ(read_surface<double>("organ.stl", 1e-3));
///     const auto points = fill_lattice(organ, organ.box(), l0);
///
/// The magnitude is the exact distance to the nearest triangle. A point is inside if its winding number exceeds one
/// half in magnitude, whichever way the triangles are oriented. The distance is exact for a closed surface that does
/// not intersect itself; where parts overlap, the distance inside is that to the nearest triangle of any part. In the
/// holes of an open surface the value jumps from inside to outside, so that it is a distance only away from them.
/// Copies share the triangles.
template <class S>
class MeshDistance {
 public:
  /// @param accuracy  of winding numbers, see `TriangleTree`
  /// Throws `InputError` for a surface without triangles, or a broken one.
  explicit MeshDistance(const SurfaceMesh<S>& mesh, double accuracy = 2)
      : tree_(std::make_shared<const TriangleTree>(mesh, accuracy)), box_(bounds(mesh)) {}
  // Without moves: these copy, so that one moved from can still be called.
  MeshDistance(const MeshDistance&) = default;
  MeshDistance& operator=(const MeshDistance&) = default;
  ~MeshDistance() = default;

  /// Signed distance in m of `x` (m), negative inside; NaN where `x` is not finite.
  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    if (!detail::all_finite(x)) return std::numeric_limits<S>::quiet_NaN();
    const Vector<double, 3> place = x.template cast<double>();
    const double distance = tree_->distance(place);
    return static_cast<S>(std::abs(tree_->winding_number(place)) > 0.5 ? -distance : distance);
  }

  /// The box around the surface.
  [[nodiscard]] const Box<S, 3>& box() const { return box_; }
  [[nodiscard]] const TriangleTree& tree() const { return *tree_; }

 private:
  std::shared_ptr<const TriangleTree> tree_;
  Box<S, 3> box_;
};

}  // namespace hmps::inline HMPS_ABI
