// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "components/roofline.hpp"
#include "components/support.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"

/// Functions shared by the benchmarks of forces.
namespace bench {

inline const hmps::MooneyRivlin<> tissue = hmps::MooneyRivlin<>::from_young(young, d1);

/// Calls `advance(x, v, f, execute)` on a box repeatedly. `make(bonds)` is called once and returns the `advance` that
/// is measured; `cost(StepCost)` returns its cost.
template <class Bonds, class S, class Executor, class Make, class CostOf>
void measure(benchmark::State& run, const Box& box, const Executor& execute, const Make& make, const CostOf& cost) {
  State<S> state(box);
  const Bonds bonds(state.positions(), {.spacing = spacing});
  auto advance = make(bonds);
  const auto x = state.positions(), v = state.velocities(), f = state.forces();
  for (auto _ : run) advance(x, v, f, execute);
  count(run, box.size(), cost(StepCost<S, Bonds>(bonds)));
}

/// Registers `name/KIND/PARTICLES/THREADS` on the lattice, for the three kinds and for boxes in and beyond the cache.
template <class Make, class CostOf>
void add_force(const std::string& name, const Make& make, const CostOf& cost) {
  const auto add = [&]<class K, class S>(K, S) {
    for (const Box& box : {in_cache, paper_size, million})
      add_threads(name + "/" + kind<K, S>() + "/" + std::to_string(box.size()),
                  [box, make, cost](benchmark::State& run, const auto& execute) {
                    measure<hmps::LatticeBonds<K, 3>, S>(run, box, execute, make, cost);
                  });
  };
  add(0.f, 0.f);
  add(0.f, 0.);
  add(0., 0.);
}

}  // namespace bench
