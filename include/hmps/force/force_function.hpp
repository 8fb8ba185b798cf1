// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "hmps/core/abi.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// Holds any force for a state in the scalar type `T`, so that it can be chosen at run time: the result of
/// `internal_force`, or a lambda that calls several forces. `stable_step` and `relax` accept it like any other force. A
/// call costs one indirection.
///
///     hmps::ForceFunction<double, 3> force = hmps::internal_force(bonds, hmps::elastic(law));
///     if (damped) force = hmps::internal_force(bonds, hmps::elastic(law), hmps::viscous(rho, nu));
///     force(x, v, f);
///
/// The bonds of the force must outlive it.
template <class T, int D>
using ForceFunction =
    std::function<void(const VectorView<const T, D>& x, const VectorView<const T, D>& v, const VectorView<T, D>& f)>;

}  // namespace hmps::inline HMPS_ABI
