// SPDX-License-Identifier: MIT
// All neighbours within 1.75 spacings of every particle of a jittered lattice, by a k-d tree:
// search/tree/ORDER/KIND/PARTICLES/THREADS, with the particles in lattice order or shuffled. Items are particles.
#include "hmps/search/fixed_radius.hpp"

#include "search.hpp"

namespace {

using namespace bench;

template <class S, class Executor>
void search(benchmark::State& run, const Box& box, bool shuffled, const Executor& execute) {
  State<S> state = cloud<S>(box, shuffled);
  std::size_t found = 0;
  for (auto _ : run) found = hmps::find_neighbours(state.positions(), search_radius<S>, execute).neighbour.size();
  count_search<S>(run, box.size(), found);
}

[[maybe_unused]] const bool added = [] {
  add_searches("search/tree", []<class S>(S, benchmark::State& run, const Box& box, bool shuffled,
                                          const auto& execute) { search<S>(run, box, shuffled, execute); });
  return true;
}();

}  // namespace
