// SPDX-License-Identifier: MIT
// All neighbours within 1.75 spacings of every particle of a jittered lattice, by a uniform grid that is built in one
// thread and searched in all: search/grid/ORDER/KIND/PARTICLES/THREADS. The lists are those of `find_neighbours`, but
// not sorted. Items are particles.
#include "hmps/search/detail/grid.hpp"

#include <numeric>
#include <vector>

#include "search.hpp"

namespace {

using namespace bench;

template <class S, class Executor>
void search(benchmark::State& run, const Box& box, bool shuffled, const Executor& execute) {
  State<S> state = cloud<S>(box, shuffled);
  const auto x = state.positions();
  std::size_t found = 0;
  for (auto _ : run) {
    hmps::detail::Grid<S, 3> grid;
    grid.build(box.size(), search_radius<S>, [&](std::size_t k) { return x[k]; });
    std::vector<std::size_t> offset(box.size() + 1, 0);
    execute(box.size(), [&](std::size_t i) {
      grid.visit(x[i], search_radius<S>, [&](hmps::Index k, S) { offset[i + 1] += k != i ? 1 : 0; });
    });
    std::partial_sum(offset.begin(), offset.end(), offset.begin());
    std::vector<hmps::Index> neighbour(offset.back());
    execute(box.size(), [&](std::size_t i) {
      std::size_t next = offset[i];
      grid.visit(x[i], search_radius<S>, [&](hmps::Index k, S) {
        if (k != i) neighbour[next++] = k;
      });
    });
    benchmark::DoNotOptimize(neighbour.data());
    found = neighbour.size();
  }
  count_search<S>(run, box.size(), found);
}

[[maybe_unused]] const bool added = [] {
  add_searches("search/grid", []<class S>(S, benchmark::State& run, const Box& box, bool shuffled,
                                          const auto& execute) { search<S>(run, box, shuffled, execute); });
  return true;
}();

}  // namespace
