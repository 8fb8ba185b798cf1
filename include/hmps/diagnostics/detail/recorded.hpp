// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Throws `InputError` if the deformation gradient of a particle is zero in all components, which means that nothing
/// has written it; names the first. A crushed particle passes.
template <class T, int D>
HMPS_COLD void require_recorded(const MatrixView<T, D>& F) {
  require_view(F, "deformation gradients");
  for (std::size_t i = 0; i < F.size(); ++i)
    require(!F[i].isZero(0), "hmps: the deformation gradient of particle ", i,
            " is zero, which means that nothing has written it: first evaluate the force with `record(F)` among its "
            "terms, or `deformation_gradient`; particles that do not deform need the identity");
}

}  // namespace hmps::inline HMPS_ABI::detail
