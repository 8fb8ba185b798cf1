// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "hmps/core/abi.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// Any force, to be chosen at run time: holds what `internal_force` returns, or a lambda that calls several forces, for
/// state in the scalar `T`. `stable_step` and `relax` take it as any other force. A call costs one indirection.
///
///     hmps::ForceFunction<double, 3> force = hmps::internal_force(bonds, hmps::elastic(law));
///     if (damped) force = hmps::internal_force(bonds, hmps::elastic(law), hmps::viscous(rho, nu));
///     force(x, v, f);
///
/// The bonds that the force refers to must outlive it.
template <class T, int D>
using ForceFunction =
    std::function<void(const VectorView<const T, D>& x, const VectorView<const T, D>& v, const VectorView<T, D>& f)>;

}  // namespace hmps::inline HMPS_ABI
