// SPDX-License-Identifier: MIT
// Making the bonds of a box in the way that works for any cloud: bonds/list/KIND/PARTICLES. Items are particles.
#include "hmps/bonds/bond_list.hpp"

#include "make_bonds.hpp"

namespace {

[[maybe_unused]] const bool added = [] {
  bench::add_bonds<hmps::BondList<float, 3>>("bonds/list");
  bench::add_bonds<hmps::BondList<double, 3>>("bonds/list");
  return true;
}();

}  // namespace
