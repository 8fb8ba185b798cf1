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

#include "hmps/contact/friction.hpp"
#include "hmps/contact/penalty.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/detail/grid.hpp"

namespace hmps::inline HMPS_ABI {

/// A body with a surface that may touch others. Indices refer to the user's particles. A particle may be slave and
/// master (the usual case) and belong to several organs.
struct Organ {
  std::string name;              ///< For messages.
  std::vector<Index> slaves{};   ///< The outermost layer, which is kept out of walls.
  std::vector<Index> masters{};  ///< The wall: the two outermost layers carry all of Z above y = 0.
  /// Whether a particle follows a forced displacement, so that forces do not move it (default: none). Read by
  /// `CorrectedFriction`, damping and `MetaballContact::kick`.
  std::function<bool(Index)> prescribed{};
  /// r_0 in m of a slave, \paper{37}: the distance of its surface from its centre before it deforms (default: half the
  /// spacing of the contact, so that undeformed slaves are spheres that touch one spacing apart). For layers that lie
  /// closer or wider, give half their spacing: `[&](Index i) { return fitted.layer_spacings[i] / 2; }`.
  std::function<double(Index)> radius{};
  /// Volume in m3 (m2 in 2D) that a particle stands for (default: l0^D). If the bonds have volumes, give the same here,
  /// `[&](Index i) { return fitted.volumes[i]; }`, and if they have none, none: otherwise the forces of bodies on each
  /// other, density times volume, differ. The same holds for `RelaxationSettings::volume`, energies and momenta.
  std::function<double(Index)> volume{};
};

/// Which organs of a pair have slaves. In the paper both do, \paper{43}.
enum class Roles { both, only_first_is_slave, only_second_is_slave };

/// Settings of a pair of organs.
struct PairSettings {
  Roles roles = Roles::both;
  /// Slaves of either organ that do not take part in this pair: see `exclude_attached`.
  std::vector<Index> excluded_slaves{};
  /// `excluded(slave, master)`: whether these two never touch. Called when lists are built, from any thread.
  std::function<bool(Index, Index)> excluded{};
  std::optional<double> friction{};             ///< mu_tan of this pair, if not that of `ContactSettings`.
  std::optional<PenaltyStiffness> stiffness{};  ///< k of this pair, if not that of `ContactSettings`.
};

/// Those of `slaves` whose reference position lies within `distance` (m) of that of a particle of `attachment`, which
/// lists the particles of the other organ that are bonded to the slaves' organ. Where two organs grow together, their
/// surfaces must not push each other apart. The distance is in metres, so that it does not shrink with the spacing. The
/// result is sorted by index, for `PairSettings::excluded_slaves`. Throws `InputError` for an index out of range and a
/// distance that is not positive and finite, or longer than both lists of particles together.
template <class T, int D>
[[nodiscard]] std::vector<Index> exclude_attached(const VectorView<T, D>& reference, std::span<const Index> slaves,
                                                  std::span<const Index> attachment, double distance) {
  using S = typename VectorView<T, D>::Scalar;
  detail::require(detail::is_finite(distance) && distance > 0, "hmps: the distance for excluding slaves is ", distance,
                  " m; give a positive length");
  for (const auto list : {slaves, attachment})
    for (const Index i : list)
      detail::require(i < reference.size(), "hmps: particle ", i, " is given to exclude_attached but there are only ",
                      reference.size(), " reference positions; give indices into their view");
  if (!slaves.empty() && !attachment.empty()) {
    Vector<double, D> low = reference[slaves[0]].template cast<double>(), high = low;
    for (const auto list : {slaves, attachment})
      for (const Index i : list) {
        low = low.cwiseMin(reference[i].template cast<double>());
        high = high.cwiseMax(reference[i].template cast<double>());
      }
    const double extent = (high - low).norm();
    detail::require(!(distance > extent && extent > 0), "hmps: the distance for excluding slaves is ", distance,
                    " m, but slaves and attachment together span only ", extent,
                    " m, so that all slaves would be excluded; give a distance of a few spacings, in metres");
  }
  detail::Grid<S, D> grid;
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
