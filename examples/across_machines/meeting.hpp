// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include <hmps/core/view.hpp>
#include <hmps/search/fixed_radius.hpp>

#include "scene.hpp"

namespace across_machines {

/// A surface particle that a rank has to know to compute the contact forces on its own ones.
struct Gathered {
  Index entry;  ///< in the list of all surface particles
  bool slave;   ///< to be a slave here; all are masters
};

/// How many times a contact force may reach from body to body: a slave is pushed by masters (1), a master by slaves
/// that know their other masters (2), and friction needs the load of each of these, which depends on their slaves (3)
/// and what these touch besides (4).
inline constexpr int hops = 4;

/// Of the surface particles at `place` (m, all of the scene), those that decide about the forces on the ones for which
/// `own(entry)` holds, if particles of different bodies meet within `reach` (m): ascending. Own ones that meet nothing
/// are not among them. Those that are reached last are no slaves here, since some of their masters may be missing.
template <class Own>
[[nodiscard]] std::vector<Gathered> what_meets(const std::vector<SurfaceParticle>& surface,
                                               const std::vector<hmps::Vector<double, 3>>& place, double reach,
                                               Own&& own) {
  using Point = hmps::Vector<double, 3>;
  Point low = Point::Constant(1e300), high = -low;
  for (std::size_t k = 0; k < place.size(); ++k)
    if (own(k)) {
      low = low.cwiseMin(place[k]);
      high = high.cwiseMax(place[k]);
    }
  std::vector<Index> nearby;
  for (std::size_t k = 0; k < place.size(); ++k)
    if ((low - place[k]).cwiseMax(place[k] - high).maxCoeff() <= hops * reach) nearby.push_back(static_cast<Index>(k));

  // Only what lies within reach of the box around the other body can meet it.
  std::array<Eigen::AlignedBox3d, 2> box;
  const auto body = [&](Index k) { return static_cast<std::size_t>(surface[k].body); };
  for (const Index k : nearby) box[body(k)].extend(place[k]);
  std::erase_if(nearby, [&](Index k) { return box[1 - body(k)].exteriorDistance(place[k]) > 1.001 * reach; });

  std::array<std::vector<Point>, 2> there;
  std::array<std::vector<Index>, 2> of_body;
  for (std::size_t q = 0; q < nearby.size(); ++q) {
    there[body(nearby[q])].push_back(place[nearby[q]]);
    of_body[body(nearby[q])].push_back(static_cast<Index>(q));
  }
  const hmps::FixedRadiusSearch lower(hmps::vectors(std::as_const(there[0])));
  const hmps::FixedRadiusSearch upper(hmps::vectors(std::as_const(there[1])));
  std::vector<Index> within;
  constexpr std::uint8_t unknown = 255;
  std::vector<std::uint8_t> hop(nearby.size(), unknown);
  std::vector<Index> front, next;
  const auto for_each_partner = [&](Index q, auto&& visit) {
    const std::size_t partner = 1 - body(nearby[q]);
    (partner == 0 ? lower : upper)(place[nearby[q]], reach, within);
    for (const Index k : within) visit(of_body[partner][k]);
  };
  for (std::size_t q = 0; q < nearby.size(); ++q) {
    if (!own(nearby[q])) continue;
    bool meets = false;
    for_each_partner(static_cast<Index>(q), [&](Index) { meets = true; });
    if (!meets) continue;
    hop[q] = 0;
    front.push_back(static_cast<Index>(q));
  }
  for (std::uint8_t h = 1; h <= hops; ++h) {
    next.clear();
    for (const Index q : front)
      for_each_partner(q, [&](Index other) {
        if (hop[other] != unknown) return;
        hop[other] = h;
        next.push_back(other);
      });
    std::swap(front, next);
  }
  std::vector<Gathered> found;
  for (std::size_t q = 0; q < nearby.size(); ++q)
    if (hop[q] != unknown) found.push_back({nearby[q], surface[nearby[q]].slave && hop[q] < hops});
  return found;
}

}  // namespace across_machines
