// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/isosurface.hpp"
#include "hmps/shapes/triangle_tree.hpp"

namespace hmps::inline HMPS_ABI {

/// The result of `redistanced`. Copies share the surface.
template <class F, class S>
struct Redistanced {
  F shape;
  Box<S, 3> box;  ///< m; its faces cut
  std::shared_ptr<const TriangleTree> surface;

  /// Signed distance in m of `x` (m), negative inside; NaN where the shape is.
  [[nodiscard]] S operator()(const Vector<S, 3>& x) const {
    const S level = static_cast<S>(shape(x));
    if (detail::is_nan(level)) return level;
    const S sign = std::max(level, box(x));
    return std::copysign(static_cast<S>(surface->distance(x.template cast<double>())), sign);
  }
};

/// The part of any shape that lies in a box, as one that is the signed distance: inside united parts too, where the
/// nearest surface may be that of another part, and for implicit functions that are none. What asks for a distance thus
/// takes any shape:
///
///     const auto body = redistanced(shape, box, l0 / 4);
///     const auto fitted = fit_particles(body, box, l0);
///
/// The sign is that of the shape, the magnitude the distance to its `isosurface`, whose limits and errors this has. It
/// costs a search in a tree of triangles for each place, beside the shape itself.
///
/// @param shape  negative inside
/// @param box    in m; its faces cut
/// @param cell   width of the cells of the isosurface in m
template <class F, class S, Executor E = Serial>
requires Shape<F, S, 3>
[[nodiscard]] Redistanced<F, S> redistanced(F shape, const Box<S, 3>& box, std::type_identity_t<S> cell,
                                            const E& execute = {}) {
  auto surface = std::make_shared<const TriangleTree>(isosurface(shape, box, cell, execute));
  return {std::move(shape), box, std::move(surface)};
}

}  // namespace hmps::inline HMPS_ABI
