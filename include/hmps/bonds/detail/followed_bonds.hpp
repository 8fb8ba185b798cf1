// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/anchored.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Refers to bonds that the user owns and may move, for example in a `std::vector` of bodies.
template <Bonds B>
class FollowedBonds {
 public:
  /// Throws `InputError` for bonds without particles, such as those that were moved from.
  explicit FollowedBonds(const B& bonds) : anchor_(bonds), slots_(bonds.slot_count()) {
    require(bonds.size() > 0,
            "hmps: the bonds of this force hold no particles; were they moved elsewhere, or made from an empty cloud?");
  }

  /// The bonds at their current address. Throws `InputError` if they no longer exist or have been replaced.
  [[nodiscard]] const B& now() const {
    const Anchored* const place = anchor_.object();
    if (place == nullptr)  // without `require`, so that the compiler knows below that it is not null
      throw InputError(
          "hmps: the bonds of this force no longer exist: they were destroyed or assigned to; keep them as long as "
          "the force, or make a new force");
    const B& bonds = static_cast<const B&>(*place);
    require(bonds.slot_count() == slots_, "hmps: the bonds of this force hold ", bonds.size(),
            " particles now, which are not those that it was made for; make a new force");
    return bonds;
  }

 private:
  Anchored::Anchor anchor_;
  std::size_t slots_;
};

}  // namespace hmps::inline HMPS_ABI::detail
