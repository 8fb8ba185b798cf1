// SPDX-License-Identifier: MIT
// One step of a box: elastic, artificial and viscous force, kick and drift. Items are particle-steps.
//
//   step/box/KIND/PARTICLES/THREADS     on the lattice; KIND: float, double, mixed (state in double, kernels in float)
//   step/list/KIND/PARTICLES/THREADS    the same body with a list of bonds
//   step/cloud/ORDER/KIND/PARTICLES/THREADS   the same, moved off the lattice by up to a tenth of a spacing and then in
//                                       the order of the lattice or shuffled, with a list of bonds
//   step/reference/KIND/PARTICLES       the same with compressed rows and plain Eigen code (reference.hpp)
//   step/thin/KIND/PARTICLES/THREADS    half a hollow ball, a wall of three particles, in which few
//                                       neighbours lie in rows
//
// Counters besides items, bytes and FLOP per second (cost.hpp): `memory`, the bytes per particle that bonds and force
// store; `roofline`, for one thread the share of the rate that multiply-adds and memory allow (roofline.hpp);
// `neighbours`, the share of the rate that reading the neighbours allows; `lanes`, the share of the lanes of computed
// rows of bonds that hold a bond.
#include "hmps/force/internal_force.hpp"

#include <cmath>
#include <ctime>
#include <string>
#include <type_traits>
#include <vector>

#include "components/step.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"
#include "reference.hpp"

namespace {

using namespace bench;

/// Number of bonds over the number of lanes in the rows in which they are computed.
template <class Bonds>
double useful_lanes(const Bonds& bonds) {
  std::size_t held = 0, rows = 0;
  for (std::size_t i = 0; i < bonds.size(); ++i) bonds.for_each_bond(i, [&](auto&&...) { ++held; });
  for (std::size_t block = 0; block < bonds.block_count(); ++block)
    bonds.for_each_row(block, [&](const auto&) { ++rows; });
  return static_cast<double>(held) / static_cast<double>(rows * Bonds::width);
}

template <class Bonds, class S, class Executor>
void step(benchmark::State& run, State<S> state, const Executor& execute) {
  const Bonds bonds(state.positions(), {.spacing = spacing});
  auto force =
      hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young), hmps::viscous(density, viscosity));
  const auto x = state.positions(), v = state.velocities();
  const std::clock_t start = std::clock();
  for (auto _ : run) {
    force.kick(x, v, density, time_step, execute);
    hmps::drift(x, v, time_step, execute);
  }
  const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  const Cost cost = StepCost<S, Bonds>(bonds).step(tissue);
  count(run, state.size(), cost);
  const auto n = static_cast<double>(state.size());
  run.counters["memory"] = static_cast<double>(bonds.bytes() + force.bytes()) / n;
  run.counters["lanes"] = useful_lanes(bonds);
  if constexpr (std::is_same_v<Executor, hmps::Serial>) {
    const std::size_t working_set = bonds.bytes() + force.bytes() + 9 * sizeof(S) * state.size();
    const double rate = static_cast<double>(run.iterations()) * n / seconds;
    run.counters["roofline"] = rate / attainable<typename Bonds::Scalar>(cost, working_set);
    run.counters["neighbours"] = rate * cost.gathered / gather_rate<typename Bonds::Scalar>();
  }
}

template <class S>
void reference_step(benchmark::State& run, const Box& box) {
  using Vec = Eigen::Matrix<S, 3, 1>;
  State<S> start(box);
  std::vector<Vec> x, v, f(box.size());
  for (std::size_t i = 0; i < box.size(); ++i) {
    x.push_back(start.positions()[i]);
    v.push_back(start.velocities()[i]);
  }
  Reference<S> force(x, static_cast<S>(1.75 * spacing));
  const auto law = hmps::MooneyRivlin<S>::from_young(S(young), S(d1));
  const S dt = static_cast<S>(time_step), per_density = static_cast<S>(time_step / density);
  for (auto _ : run) {
    force(law, S(young), S(density), static_cast<S>(viscosity), x, v, f);
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] += f[i] * per_density;
      x[i] += v[i] * dt;
    }
  }
  const hmps::LatticeBonds<S, 3> bonds(start.positions(), {.spacing = spacing});
  count(run, box.size(), StepCost<S, hmps::LatticeBonds<S, 3>>(bonds).step(law));
}

/// Half a hollow ball, three particles thick: a thin wall in every direction, as in organs.
template <class S>
State<S> dome() {
  State<S> state(Box{0, 0, 0});
  for (int i = -42; i <= 42; ++i)
    for (int j = -42; j <= 42; ++j)
      for (int k = 0; k <= 42; ++k) {
        const double radius = std::hypot(i, j, k);
        if (radius < 40 || radius >= 43) continue;
        const int cell[] = {i, j, k};
        for (std::size_t c = 0; c < 3; ++c) {
          state.x[c].push_back(static_cast<S>(spacing * cell[c]));
          state.v[c].push_back(static_cast<S>(0.1 * noise(3 * state.x[c].size() + c)));
          state.f[c].push_back(S(0));
        }
      }
  return state;
}

template <class Bonds, class S>
void add_box(const std::string& name, const Box& box) {
  add_threads(name + "/" + kind<typename Bonds::Scalar, S>() + "/" + std::to_string(box.size()),
              [box](benchmark::State& run, const auto& execute) { step<Bonds, S>(run, State<S>(box), execute); });
}
template <class Bonds, class S>
void add_cloud() {
  for (const bool shuffled : {false, true})
    add_threads(std::string("step/cloud/") + (shuffled ? "shuffled/" : "ordered/") + kind<typename Bonds::Scalar, S>() +
                    "/" + std::to_string(paper_size.size()),
                [shuffled](benchmark::State& run, const auto& execute) {
                  step<Bonds, S>(run, cloud<S>(paper_size, shuffled), execute);
                });
}
template <class Bonds, class S>
void add_thin() {
  add_threads("step/thin/" + kind<typename Bonds::Scalar, S>() + "/" + std::to_string(dome<S>().size()),
              [](benchmark::State& run, const auto& execute) { step<Bonds, S>(run, dome<S>(), execute); });
}

[[maybe_unused]] const bool added = [] {
  for (const Box& box : {in_cache, paper_size, large, million}) {
    add_box<hmps::LatticeBonds<float, 3>, float>("step/box", box);
    add_box<hmps::LatticeBonds<float, 3>, double>("step/box", box);
    add_box<hmps::LatticeBonds<double, 3>, double>("step/box", box);
  }
  add_thin<hmps::LatticeBonds<float, 3>, float>();
  add_thin<hmps::LatticeBonds<float, 3>, double>();
  add_thin<hmps::LatticeBonds<double, 3>, double>();
  add_box<hmps::BondList<float, 3>, float>("step/list", paper_size);
  add_box<hmps::BondList<double, 3>, double>("step/list", paper_size);
  add_cloud<hmps::BondList<float, 3>, float>();
  add_cloud<hmps::BondList<double, 3>, double>();
  for (const Box& box : {in_cache, paper_size}) {
    const std::string size = std::to_string(box.size());
    benchmark::RegisterBenchmark(("step/reference/float/" + size).c_str(), [box](benchmark::State& run) {
      reference_step<float>(run, box);
    })->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(("step/reference/double/" + size).c_str(), [box](benchmark::State& run) {
      reference_step<double>(run, box);
    })->Unit(benchmark::kMillisecond);
  }
  return true;
}();

}  // namespace
