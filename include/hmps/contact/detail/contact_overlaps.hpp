// SPDX-License-Identifier: MIT
#pragma once

#include "hmps/contact/detail/contact_declaration.hpp"
#include "hmps/contact/overlaps.hpp"
#include "hmps/core/abi.hpp"

namespace hmps::inline HMPS_ABI {

template <class S, int D, class Kernel, class Friction, class Penalty>
template <class X, class G>
std::vector<Overlap> MetaballContact<S, D, Kernel, Friction, Penalty>::find_overlaps(const X& x, const G& F) const {
  require_size(x, x.size(), "positions");
  lists_.organs().require_particles(x.size());
  const NormalDensity<double, D, Kernel> Z(settings_.spacing);
  const auto state_of = [&](std::size_t organ, std::uint8_t role, const auto& wanted) {
    detail::OverlapParticles<D> state;
    for (const auto& member : lists_.organs().members_of(organ)) {
      const Index i = member.particle;
      if (!(member.flags & role) || !wanted(i)) continue;
      state.particle.push_back(i);
      state.x.push_back(x[i].template cast<double>());
      state.F.push_back(F[i].template cast<double>());
      state.radius.push_back(member.radius);
      detail::require_motion<D>(state.x.back(), Vector<double, D>::Zero(), i);
      detail::require_gradient<D>(state.F.back(), i);
    }
    return state;
  };
  std::vector<Overlap> found;
  for (const auto& side : lists_.organs().sides()) {
    const auto& pair = lists_.organs().pairs()[side.pair];
    const auto all = [](Index) { return true; };
    const auto slaves = state_of(side.slaves, detail::is_slave, [&](Index i) { return pair.may_be_slave(i); });
    Overlap overlap{
        side.pair, lists_.organs().organs()[side.slaves].name, lists_.organs().organs()[side.masters].name, 0, 0, 0};
    detail::find_overlap<D, Kernel>(Z, slaves, state_of(side.masters, detail::is_master, all),
                                    state_of(side.masters, detail::is_slave, all), pair.excluded, overlap);
    if (overlap.count > 0) found.push_back(overlap);
  }
  return found;
}

}  // namespace hmps::inline HMPS_ABI
