// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "components/support.hpp"

namespace bench {

/// Registers `name/KIND/PARTICLES`: making the bonds of a box. Items are particles; bytes are the memory of the bonds.
template <class Bonds>
void add_bonds(const std::string& name) {
  for (const Box& box : {in_cache, paper_size, million})
    once_if_long(benchmark::RegisterBenchmark(
                     (name + "/" + name_of<typename Bonds::Scalar>() + "/" + std::to_string(box.size())).c_str(),
                     [box](benchmark::State& run) {
                       State<double> state(box);
                       std::size_t bytes = 0;
                       for (auto _ : run) bytes = Bonds(state.positions(), {.spacing = spacing}).bytes();
                       count(run, box.size(), {0, static_cast<double>(bytes) / static_cast<double>(box.size())});
                     })
                     ->Unit(benchmark::kMillisecond),
                 box);
}

}  // namespace bench
