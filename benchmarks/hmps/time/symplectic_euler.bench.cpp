// SPDX-License-Identifier: MIT
// Kick and drift, (2) and (4): euler/KIND/PARTICLES/THREADS; with compensated rounding: euler/compensated/float/...
// Items are particle-steps.
#include "hmps/time/symplectic_euler.hpp"

#include <string>

#include "components/support.hpp"

namespace {

using namespace bench;

template <class S, class Executor>
void euler(benchmark::State& run, const Box& box, bool compensated, const Executor& execute) {
  State<S> state(box), carries(Box{0, 0, 0});
  for (auto& component : carries.x) component.assign(box.size(), S(0));
  const auto x = state.positions(), v = state.velocities(), f = state.forces(), carry = carries.positions();
  for (auto _ : run) {
    hmps::kick(v, f, density, time_step, execute);
    if (compensated)
      hmps::drift(x, v, carry, time_step, execute);
    else
      hmps::drift(x, v, time_step, execute);
  }
  count(run, box.size(), {compensated ? 24. : 12., (compensated ? 24. : 18.) * sizeof(S)});
}

template <class S>
void add(const std::string& name, bool compensated) {
  for (const Box& box : {in_cache, paper_size, million})
    add_threads(
        name + name_of<S>() + "/" + std::to_string(box.size()),
        [box, compensated](benchmark::State& run, const auto& execute) { euler<S>(run, box, compensated, execute); });
}

[[maybe_unused]] const bool added = [] {
  add<float>("euler/", false);
  add<double>("euler/", false);
  add<float>("euler/compensated/", true);
  return true;
}();

}  // namespace
