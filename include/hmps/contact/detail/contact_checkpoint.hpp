// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "hmps/contact/detail/contact_declaration.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"

namespace hmps::inline HMPS_ABI {

// The layout of a history: the number of memberships of particles in organs, that of pairs of a slave and a wall, and
// that of positions; the origin from which contact measures positions; then each particle with its position; then the
// entries of `ContactHistory`.

template <class S, int D, class Kernel, class Friction, class Penalty>
std::vector<double> MetaballContact<S, D, Kernel, Friction, Penalty>::history() const {
  const auto& organs = lists_.organs();
  std::vector<double> numbers{static_cast<double>(organs.members().size()), static_cast<double>(organs.slots()), 0};
  const Vector<double, D>& origin = lists_.origin();
  numbers.insert(numbers.end(), origin.begin(), origin.end());
  if constexpr (has_spring) {
    numbers[2] = static_cast<double>(motion_.places().size());
    for (std::size_t n = 0; n < motion_.places().size(); ++n) {
      numbers.push_back(static_cast<double>(motion_.particles()[n]));
      numbers.insert(numbers.end(), motion_.places()[n].begin(), motion_.places()[n].end());
    }
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
  constexpr std::size_t width = 1 + D;
  const double positions = history[2], room = static_cast<double>(history.size() - head) / width;
  detail::require(positions >= 0 && positions <= std::min(room, history[0]) && (has_spring || positions == 0),
                  "hmps: the history claims ", positions, " positions among its ", history.size(),
                  " numbers; was it written with another friction law, or truncated?");
  const auto place_at = [&](std::size_t first, const char* what) {
    Vector<double, D> place;
    for (int c = 0; c < D; ++c) {
      place[c] = history[first + static_cast<std::size_t>(c)];
      detail::require(detail::is_finite(place[c]), "hmps: ", what, " in number ", first + static_cast<std::size_t>(c),
                      " of the history is ", place[c], "; every number must be finite");
    }
    return place;
  };
  const Vector<double, D> origin = place_at(head - D, "the origin");
  const auto count = static_cast<std::size_t>(positions);
  std::vector<Vector<double, D>> places(count);
  std::vector<Index> particles(count), known;  // organs that are added later have particles, but no positions yet
  for (const auto& member : organs.members()) known.push_back(member.particle);
  std::sort(known.begin(), known.end());
  for (std::size_t n = 0; n < count; ++n) {
    const std::size_t first = head + width * n;
    const double particle = history[first];
    detail::require(detail::is_finite(particle) && particle >= (n > 0 ? particles[n - 1] + 1.0 : 0.0) &&
                        particle < detail::no_index && particle == std::floor(particle),
                    "hmps: number ", first, " of the history is ", particle,
                    ", which is not a particle above the one before; was it changed?");
    particles[n] = static_cast<Index>(particle);
    detail::require(std::binary_search(known.begin(), known.end(), particles[n]), "hmps: number ", first,
                    " of the history is particle ", particles[n],
                    ", which is in no organ of this contact; add the same organs as in the contact that gave the "
                    "history, before you restore it");
    places[n] = place_at(first + 1, "a position");
  }
  history_.restore(history.subspan(head + width * count), organs.slots());
  lists_.restore_origin(origin);
  if constexpr (has_spring) motion_.restore(std::move(particles), std::move(places));
}

}  // namespace hmps::inline HMPS_ABI
