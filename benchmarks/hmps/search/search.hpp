// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include "components/support.hpp"
#include "hmps/core/types.hpp"

/// Functions shared by the benchmarks of the two searches.
namespace bench {

template <class S>
inline constexpr S search_radius = static_cast<S>(1.75 * spacing);

/// Counts particles as items; bytes are those of the points and of the list of `found` neighbours, once each.
template <class S>
void count_search(benchmark::State& run, std::size_t particles, std::size_t found) {
  const double neighbours = static_cast<double>(found) / static_cast<double>(particles);
  // A distance is three differences, three products and two sums. Only the distances of neighbours count, however many
  // the method computes.
  count(run, particles, {8 * neighbours, 3 * sizeof(S) + sizeof(std::size_t) + sizeof(hmps::Index) * neighbours});
}

/// Registers `name/ORDER/KIND/PARTICLES/THREADS` for clouds in lattice order and shuffled.
template <class Search>
void add_searches(const std::string& name, const Search& search) {
  const auto add = [&]<class S>(S) {
    for (const bool shuffled : {false, true})
      for (const Box& box : {in_cache, paper_size, million})
        add_threads(
            name + (shuffled ? "/shuffled/" : "/ordered/") + name_of<S>() + "/" + std::to_string(box.size()),
            [box, shuffled, search](benchmark::State& run, const auto& execute) {
              search(S{}, run, box, shuffled, execute);
            },
            benchmark::kMillisecond,
            [&box](benchmark::internal::Benchmark* registered) { once_if_long(registered, box); });
  };
  add(0.f);
  add(0.);
}

}  // namespace bench
