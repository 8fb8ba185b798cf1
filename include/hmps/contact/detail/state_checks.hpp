// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"

/// The errors that contact throws for an invalid state. Called only for particles with suspicious numbers.
namespace hmps::inline HMPS_ABI::detail {

/// Throws `StateError` if the deformation gradient `F` of particle `i` is not finite, and `InputError` if it is zero,
/// which means that nothing has written it. A flattened particle passes: it forms no wall.
template <int D>
HMPS_COLD void require_gradient(const Matrix<double, D>& F, Index i) {
  if (!all_finite(F))
    throw StateError(message("hmps: contact found the deformation gradient of particle ", i, " to be (by columns) ", F,
                             "; the run has become unstable: try a shorter step or a softer penalty"));
  bool zero = true;
  for (int k = 0; k < D * D; ++k) zero = zero && F(k % D, k / D) == 0;
  require(!zero, "hmps: the deformation gradient of particle ", i,
          " is zero, so that contact sees no wall there: is `record(F)` among the terms, and are they evaluated before "
          "contact? Particles that do not deform need the identity");
}

/// Throws `StateError` if the position `x` (m) or the velocity `v` (m/s) of particle `i` is not finite.
template <int D>
HMPS_COLD void require_motion(const Vector<double, D>& x, const Vector<double, D>& v, Index i) {
  for (const auto& [name, value] : {std::pair{"position", &x}, std::pair{"velocity", &v}})
    if (!all_finite(*value))
      throw StateError(message("hmps: contact found the ", name, " of particle ", i, " to be (", *value,
                               "); the run has become unstable: try a shorter step or a softer penalty"));
}

}  // namespace hmps::inline HMPS_ABI::detail
