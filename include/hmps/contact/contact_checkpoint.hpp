// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hmps/contact/contact_declaration.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

// The layout of a history: the number of memberships of particles in organs, that of pairs of a slave and a wall, and
// that of positions; the origin from which contact measures positions; then the positions; then the entries of
// `ContactHistory`.

template <class S, int D, class Kernel, class Friction, class Penalty>
std::vector<double> MetaballContact<S, D, Kernel, Friction, Penalty>::history() const {
  const auto& organs = lists_.organs();
  std::vector<double> numbers{static_cast<double>(organs.members().size()), static_cast<double>(organs.slots()), 0};
  const Vector<double, D>& origin = lists_.origin();
  numbers.insert(numbers.end(), origin.begin(), origin.end());
  if constexpr (has_spring) {
    numbers[2] = static_cast<double>(motion_.places().size());
    for (const Vector<double, D>& place : motion_.places()) numbers.insert(numbers.end(), place.begin(), place.end());
  }
  history_.append_to(numbers);
  return numbers;
}

template <class S, int D, class Kernel, class Friction, class Penalty>
void MetaballContact<S, D, Kernel, Friction, Penalty>::restore_history(std::span<const double> history) {
  constexpr std::size_t head = 3 + D;
  const auto& organs = lists_.organs();
  detail::require(history.size() >= head, "hmps: a contact history has at least ", head, " numbers, but this one has ",
                  history.size(), "; give restore_history the numbers that history() returned");
  detail::require(
      history[0] == static_cast<double>(organs.members().size()) && history[1] == static_cast<double>(organs.slots()),
      "hmps: the history is of a contact with ", history[0], " particles in organs and ", history[1],
      " slaves in pairs, but this contact has ", organs.members().size(), " and ", organs.slots(),
      "; add the same organs and pairs, in the same order, before you restore it");
  const double positions = history[2], room = static_cast<double>(history.size() - head) / D;
  detail::require(positions >= 0 && positions <= std::min(room, history[0]) && (has_spring || positions == 0),
                  "hmps: the history claims ", positions, " positions among its ", history.size(),
                  " numbers; was it written with another friction law, or truncated?");
  const auto count = static_cast<std::size_t>(positions);
  std::vector<Vector<double, D>> places(count + 1);  // the origin, then the positions
  for (std::size_t n = 0; n <= count; ++n)
    for (std::size_t c = 0; c < D; ++c) {
      const double place = history[head - D + D * n + c];
      detail::require(detail::is_finite(place), "hmps: position ", n, " of the history has the component ", place,
                      "; every number must be finite");
      places[n][static_cast<int>(c)] = place;
    }
  history_.restore(history.subspan(head + D * count), organs.slots());
  lists_.restore_origin(places.front());
  if constexpr (has_spring) motion_.restore({places.begin() + 1, places.end()});
}

}  // namespace hmps::inline HMPS_ABI
