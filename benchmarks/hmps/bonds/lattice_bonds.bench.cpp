// SPDX-License-Identifier: MIT
// Making the bonds of a box from its lattice: bonds/lattice/KIND/PARTICLES. The complete set-up, that is, filling the
// lattice, finding its bonds and inverting A: setup/PARTICLES. Items are particles.
#include "hmps/bonds/lattice_bonds.hpp"

#include <string>

#include "hmps/particles/lattice.hpp"
#include "hmps/shapes/implicit.hpp"
#include "make_bonds.hpp"

namespace {

using namespace bench;

void setup(benchmark::State& run, const Box& box) {
  const auto length = [](std::size_t particles) { return spacing * static_cast<double>(particles); };
  const hmps::Vector<double, 3> half = hmps::Vector<double, 3>::Constant(spacing / 2),
                                corner(length(box.nx), length(box.ny), length(box.nz));
  const hmps::Box<double, 3> body{-half, corner - half};
  std::size_t size = 0;
  for (auto _ : run) {
    const auto x = hmps::fill_lattice(body, body, spacing);
    const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(x), {.spacing = spacing});
    benchmark::DoNotOptimize(bonds.bytes());
    size = bonds.size();
  }
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(size));
}

[[maybe_unused]] const bool added = [] {
  add_bonds<hmps::LatticeBonds<float, 3>>("bonds/lattice");
  add_bonds<hmps::LatticeBonds<double, 3>>("bonds/lattice");
  for (const Box& box : {in_cache, paper_size, large, million})
    once_if_long(benchmark::RegisterBenchmark(("setup/" + std::to_string(box.size())).c_str(),
                                              [box](benchmark::State& run) { setup(run, box); })
                     ->Unit(benchmark::kMillisecond),
                 box);
  return true;
}();

}  // namespace
