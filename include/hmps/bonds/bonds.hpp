// SPDX-License-Identifier: MIT
#pragma once

#include <concepts>
#include <cstddef>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
struct AnyVisit {
  template <class... Arguments>
  void operator()(const Arguments&...) const {}
};

/// A row: at most one bond per lane of a block. The types of rows are known only when a sweep is compiled, so `Bonds`
/// cannot check them.
template <class Row, class Slots, class K>
concept BondRow = requires(const Row& row, const Slots& slots) {
  { row.gather(slots)[std::size_t{0}] } -> std::convertible_to<Lanes<K>>;
  { row.offset(0) } -> std::convertible_to<Lanes<K>>;
  { row.along(0) } -> std::convertible_to<bool>;
  { row.weight() } -> std::convertible_to<Lanes<K>>;
};

/// Fails to compile if `Row` is not a row of bonds.
template <class Row, class B>
struct RequireRow {
  static_assert(BondRow<Row, typename B::template Slots<1>, typename B::Scalar>,
                "hmps: a row of bonds needs gather(slots), offset(c), along(c), weight(), const; see Bonds");
  static constexpr bool value = true;
};
}  // namespace detail

/// The bonds of a body: a `Blocks` with `for_each_row(block, visit)`, which calls `visit(row)` for each row; rows may
/// have several types. A row has `row.gather(slots)`, which reads `Slots<N>` and returns an object whose `[c]` is
/// component c for the neighbour in each lane; `row.offset(c)`, component c of r0; `row.along(c)`, which is false if
/// that component is zero in all lanes and may be skipped; and `row.weight()`, w, zero in lanes without a bond.
/// `for_each_bond(i, visit)` calls `visit(j, r0, w)` for the bonds of particle i. `last_slot(block)` is the slot from
/// which the last row reads, as a hint for prefetching. `Slots<N>` stores N numbers per particle: `slots(c, slot)`,
/// writable, `lanes(c, slot)`, `store(c, slot, lanes)`, and `bytes()`, its memory. Models: `BondList`, `LatticeBonds`.
template <class B>
concept Bonds = std::derived_from<B, Blocks<typename B::Scalar, B::dimension>> &&
    requires(const B& bonds, typename B::template Slots<1>& slots, const typename B::template Slots<1>& kept,
             const Lanes<typename B::Scalar>& lanes) {
  bonds.for_each_row(std::size_t{0}, detail::AnyVisit{});
  bonds.for_each_bond(std::size_t{0}, detail::AnyVisit{});
  { bonds.last_slot(std::size_t{0}) } -> std::convertible_to<std::size_t>;
  typename B::template Slots<std::size_t{B::dimension}>;
  slots(std::size_t{0}, std::size_t{0}) = typename B::Scalar{};
  slots.store(std::size_t{0}, std::size_t{0}, lanes);
  { kept.lanes(std::size_t{0}, std::size_t{0}) } -> std::convertible_to<Lanes<typename B::Scalar>>;
  { kept.bytes() } -> std::convertible_to<std::size_t>;
};

namespace detail {
template <class B>
struct IsBonds : std::bool_constant<Bonds<B>> {};
/// Fails to compile if `B` does not model `Bonds`; the first line of the message names it.
template <class B>
struct RequireBonds {
  static_assert(IsBonds<B>::value,
                "hmps: bonds need to be derived from Blocks<K, D> and to have for_each_row(block, visit), "
                "for_each_bond(i, visit) and last_slot(block), const, and Slots<N> with a writable slots(c, slot), "
                "lanes(c, slot), store(c, slot, lanes) and bytes(); see Bonds");
};
}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
