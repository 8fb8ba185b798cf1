// SPDX-License-Identifier: MIT
// Making the bonds of a box: bonds/lattice/KIND/PARTICLES and bonds/list/KIND/PARTICLES. Items are particles.
#include <benchmark/benchmark.h>

#include "hmps/neighbours/bond_list.hpp"
#include "hmps/neighbours/lattice_bonds.hpp"
#include "support.hpp"

namespace {

using namespace bench;

template <class Bonds>
void make(benchmark::State& run, const Box& box) {
  State<double> state(box);
  for (auto _ : run) {
    const Bonds bonds(state.positions(), {.spacing = spacing});
    benchmark::DoNotOptimize(bonds.bytes());
  }
  run.SetItemsProcessed(static_cast<std::int64_t>(run.iterations() * box.size()));
}

template <class Bonds>
void add(const std::string& name) {
  const Box box = boxes[1];
  benchmark::RegisterBenchmark((name + "/" + std::to_string(box.size())).c_str(), [box](benchmark::State& run) {
    make<Bonds>(run, box);
  })->Unit(benchmark::kMillisecond);
}

[[maybe_unused]] const bool added = [] {
  add<hmps::LatticeBonds<float, 3>>("bonds/lattice/float");
  add<hmps::LatticeBonds<double, 3>>("bonds/lattice/double");
  add<hmps::BondList<float, 3>>("bonds/list/float");
  add<hmps::BondList<double, 3>>("bonds/list/double");
  return true;
}();

}  // namespace
