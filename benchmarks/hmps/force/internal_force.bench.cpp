// SPDX-License-Identifier: MIT
// One step of a box: elastic, artificial and viscous force, kick and drift. Items are particle-steps, by the
// time of the processor for one thread and by the clock for several.
//
//   step/box/KIND/PARTICLES/THREADS     on the lattice; KIND: float, double, mixed (state in double,
//                                       kernels in float)
//   step/list/KIND/PARTICLES/THREADS    the same body with a list of bonds
//   step/plain/KIND/PARTICLES           the equations one by one with Eigen (tests/reference/plain.hpp)
#include "hmps/force/internal_force.hpp"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "../../../tests/reference/plain.hpp"
#include "hmps/elastic/elastic_force.hpp"
#include "hmps/elastic/mooney_rivlin.hpp"
#include "hmps/neighbours/bond_list.hpp"
#include "hmps/neighbours/lattice_bonds.hpp"
#include "hmps/stabilise/artificial.hpp"
#include "hmps/time/symplectic_euler.hpp"
#include "hmps/viscosity/viscous.hpp"
#include "support.hpp"
#ifdef _OPENMP
#include "hmps/executors/openmp.hpp"
#endif

namespace {

using namespace bench;

template <class Bonds, class S, class Executor>
void step(benchmark::State& run, const Box& box, const Executor& execute) {
  State<S> state(box);
  const Bonds bonds(state.positions(), {.spacing = spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<double>::from_young(young, d1)),
                                    hmps::artificial(young), hmps::viscous(density, viscosity));
  const auto x = state.positions(), v = state.velocities(), f = state.forces();
  for (auto _ : run) {
    force(x, v, f, execute);
    hmps::kick(v, f, density, time_step, execute);
    hmps::drift(x, v, time_step, execute);
  }
  run.SetItemsProcessed(static_cast<std::int64_t>(run.iterations() * box.size()));
  run.counters["bytes_per_particle"] =
      static_cast<double>(bonds.bytes() + force.bytes()) / static_cast<double>(box.size());
}

template <class S>
void plain_step(benchmark::State& run, const Box& box) {
  using Vec = Eigen::Matrix<S, 3, 1>;
  using Mat = Eigen::Matrix<S, 3, 3>;
  State<S> start(box);
  const auto copy = [](const auto& view) {
    std::vector<Vec> vectors;
    for (std::size_t i = 0; i < view.size(); ++i) vectors.push_back(view[i]);
    return vectors;
  };
  std::vector<Vec> x = copy(start.positions()), v = copy(start.velocities()), f(x.size());
  std::vector<Mat> F(x.size());
  const plain::Body<S, 3> body(x, static_cast<S>(1.75 * spacing));
  const plain::MooneyRivlin<S> law{static_cast<S>(young / 12), static_cast<S>(young / 12), static_cast<S>(d1)};
  const S dt = static_cast<S>(time_step);
  for (auto _ : run) {
    std::fill(f.begin(), f.end(), Vec::Zero());
    body.deformation_gradient(x, F);
    body.elastic(
        F, [&](std::size_t, const Mat& G) { return law.template second_piola_kirchhoff<3>(G); }, f);
    body.artificial(
        x, F, [](std::size_t) { return static_cast<S>(young); }, f);
    body.viscous(v, static_cast<S>(density), static_cast<S>(viscosity), static_cast<S>(1.405677 * spacing * spacing),
                 S(7.432146), f);
    for (std::size_t i = 0; i < x.size(); ++i) {
      v[i] += f[i] * (dt / static_cast<S>(density));
      x[i] += v[i] * dt;
    }
  }
  run.SetItemsProcessed(static_cast<std::int64_t>(run.iterations() * box.size()));
}

template <class Bonds, class S>
void add(const std::string& name, const Box& box) {
  const std::string full = name + "/" + std::to_string(box.size()) + "/";
  benchmark::RegisterBenchmark((full + "1").c_str(), [box](benchmark::State& run) {
    step<Bonds, S>(run, box, hmps::Serial{});
  })->Unit(benchmark::kMillisecond);
#ifdef _OPENMP
  for (int threads = 2; threads <= omp_get_num_procs(); threads *= 2)
    benchmark::RegisterBenchmark(
        (full + std::to_string(threads)).c_str(),
        [box, threads](benchmark::State& run) { step<Bonds, S>(run, box, hmps::OpenMP{threads}); })
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
#endif
}

[[maybe_unused]] const bool added = [] {
  for (const Box& box : boxes) {
    add<hmps::LatticeBonds<float, 3>, float>("step/box/float", box);
    add<hmps::LatticeBonds<float, 3>, double>("step/box/mixed", box);
    add<hmps::LatticeBonds<double, 3>, double>("step/box/double", box);
  }
  add<hmps::BondList<float, 3>, float>("step/list/float", boxes[1]);
  add<hmps::BondList<double, 3>, double>("step/list/double", boxes[1]);
  const std::string size = std::to_string(boxes[1].size());
  benchmark::RegisterBenchmark(("step/plain/float/" + size).c_str(),
                               [](benchmark::State& run) { plain_step<float>(run, boxes[1]); })

      ->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark(("step/plain/double/" + size).c_str(),
                               [](benchmark::State& run) { plain_step<double>(run, boxes[1]); })

      ->Unit(benchmark::kMillisecond);
  return true;
}();

}  // namespace
