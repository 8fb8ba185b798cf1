// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>

#include "hmps/core/abi.hpp"
#include "hmps/lanes/blocks.hpp"

namespace hmps::inline HMPS_ABI {

/// The bonds of a body: a `Blocks` with `for_each_row(block, visit)` that calls `visit(row)` for rows, of one type or
/// of several, with `row.gather(slots)` (from `Slots<N>`, what `[c]` gives component c of for the neighbour in each
/// lane), `row.offset(c)` (component c of r0),
/// `row.along(c)` (false where that is zero for all lanes and may be skipped), the constant `skips` (whether it ever
/// is) and `row.weight()` (w, zero in lanes without this bond). Satisfied by `BondList` and `LatticeBonds`.
template <class B>
concept Bonds = std::derived_from<B, Blocks<typename B::Scalar, B::dimension>> && requires(const B& bonds) {
  typename B::template Slots<1>;
  bonds.for_each_row(std::size_t{0}, [](const auto&) {});
};

}  // namespace hmps::inline HMPS_ABI
