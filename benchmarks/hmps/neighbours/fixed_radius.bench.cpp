// SPDX-License-Identifier: MIT
// All neighbours within 1.75 spacings in a jittered lattice: search/list/ORDER/PARTICLES, with the
// particles in lattice order or shuffled. Items are particles.
#include "hmps/neighbours/fixed_radius.hpp"

#include <benchmark/benchmark.h>

#include <utility>

#include "support.hpp"

namespace {

using namespace bench;

void search(benchmark::State& run, bool shuffled) {
  State<double> state(boxes[1]);
  const auto x = state.positions();
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < 3; ++c) x(i, c) += 0.1 * spacing * noise(3 * i + static_cast<std::size_t>(c));
  if (shuffled)
    for (std::size_t i = x.size() - 1; i > 0; --i) {
      const auto j = static_cast<std::size_t>((noise(i) + 1) / 2 * static_cast<double>(i));
      for (int c = 0; c < 3; ++c) std::swap(x(i, c), x(j, c));
    }
  for (auto _ : run) {
    const hmps::NeighbourList list = hmps::find_neighbours(x, 1.75 * spacing);
    benchmark::DoNotOptimize(list.neighbour.data());
  }
  run.SetItemsProcessed(static_cast<std::int64_t>(run.iterations() * x.size()));
}

[[maybe_unused]] const bool added = [] {
  const std::string size = std::to_string(boxes[1].size());
  for (const bool shuffled : {false, true})
    benchmark::RegisterBenchmark(("search/list/" + std::string(shuffled ? "shuffled/" : "ordered/") + size).c_str(),
                                 [shuffled](benchmark::State& run) { search(run, shuffled); })
        ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
