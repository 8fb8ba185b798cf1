// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hmps/contact/penalty.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/grid.hpp"

namespace hmps::inline HMPS_ABI {

/// A body with a surface that may touch others. Indices are of the user's particles; a particle may
/// be slave and master (usual), and may belong to several organs.
struct Organ {
  std::string name;                  ///< For messages.
  std::span<const Index> slaves{};   ///< The outermost layer: what is kept out of walls.
  std::span<const Index> masters{};  ///< The wall: the two outermost layers carry all of Z above y = 0.
  /// Whether a particle follows a forced displacement, so that no force moves it (default: none).
  /// `CorrectedFriction`, damping and `MetaballContact::kick` ask for it.
  std::function<bool(Index)> prescribed{};
};

/// Which organ of a pair has slaves. Both is the paper's choice, \paper{43}.
enum class Roles { both, only_first_is_slave, only_second_is_slave };

/// How two organs of a pair meet.
struct PairSettings {
  Roles roles = Roles::both;
  /// Slaves of either organ that are none in this pair: see `exclude_attached`.
  std::span<const Index> excluded_slaves{};
  /// `excluded(slave, master)`: these two never touch. Called when lists are built, from any thread.
  std::function<bool(Index, Index)> excluded{};
  std::optional<double> friction{};             ///< mu_tan of this pair, if not that of `ContactSettings`.
  std::optional<PenaltyStiffness> stiffness{};  ///< k of this pair, if not that of `ContactSettings`.
};

/// The slaves among `slaves` whose reference position lies within `distance` (m) of that of a particle
/// of `attachment`: the particles of the other organ that are bonded to the slaves' organ. Where two
/// organs grow together their surfaces must not push each other apart. The distance is given in
/// metres so that it does not shrink with the spacing. Result sorted by index, for
/// `PairSettings::excluded_slaves`. Throws `InputError` on a bad index or distance.
template <class T, int D>
[[nodiscard]] std::vector<Index> exclude_attached(const VectorView<T, D>& reference, std::span<const Index> slaves,
                                                  std::span<const Index> attachment, double distance) {
  using S = typename VectorView<T, D>::Scalar;
  require(detail::is_finite(distance) && distance > 0, "hmps: the distance of excluded slaves is ", distance,
          " m; give a positive length");
  for (const auto list : {slaves, attachment})
    for (const Index i : list)
      require(i < reference.size(), "hmps: particle ", i, " is excluded from contact but there are only ",
              reference.size(), " particles");
  Grid<S, D> grid;
  grid.build(attachment.size(), static_cast<S>(distance), [&](std::size_t k) { return reference[attachment[k]]; });
  std::vector<Index> out;
  for (const Index i : slaves) {
    bool nearby = false;
    grid.visit(reference[i], static_cast<S>(distance), [&](Index, S) { nearby = true; });
    if (nearby) out.push_back(i);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace hmps::inline HMPS_ABI
