// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/anchored.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Bonds that someone else keeps and may move, in a `std::vector` of bodies, say.
template <Bonds B>
class FollowedBonds {
 public:
  /// Throws `InputError` for bonds of no particle: those that were moved from are.
  explicit FollowedBonds(const B& bonds) : anchor_(bonds), slots_(bonds.slot_count()) {
    require(bonds.size() > 0,
            "hmps: the bonds of this force hold no particle; were they moved elsewhere, or made of an empty cloud?");
  }

  /// The bonds, wherever they are now. Throws `InputError` if they are no more, or others than they were.
  [[nodiscard]] const B& now() const {
    const Anchored* const place = anchor_.object();
    if (place == nullptr)  // not by `require`, so that a compiler knows below that it is not null
      throw InputError(
          "hmps: the bonds of this force are no more: they were destroyed, or others were assigned to them; keep "
          "them as long as the force, or make the force anew");
    const B& bonds = static_cast<const B&>(*place);
    require(bonds.slot_count() == slots_, "hmps: the bonds of this force hold ", bonds.size(),
            " particles now, others than when it was made; make the force anew");
    return bonds;
  }

 private:
  Anchored::Anchor anchor_;
  std::size_t slots_;
};

}  // namespace hmps::inline HMPS_ABI::detail
