// SPDX-License-Identifier: MIT
#pragma once

#include <benchmark/benchmark.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "components/cost.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/view.hpp"
#ifdef _OPENMP
#include "hmps/executors/openmp.hpp"
#endif

/// What all benchmarks share: a box of soft tissue and its state, and functions that name benchmarks and set their
/// counters.
namespace bench {

inline constexpr double spacing = 1.2e-3, time_step = 1e-5, density = 1000, viscosity = 2e-3, young = 20e3, d1 = 1e6;

/// Numbers in [-1, 1), the same in every run (splitmix64).
inline double noise(std::uint64_t n) {
  n = (n + 1) * 0x9e3779b97f4a7c15u;
  n = (n ^ (n >> 30)) * 0xbf58476d1ce4e5b9u;
  n = (n ^ (n >> 27)) * 0x94d049bb133111ebu;
  return static_cast<double>((n ^ (n >> 31)) >> 11) * 0x1.0p-52 - 1;
}

/// The extent in particles of the boxes that are measured.
struct Box {
  std::size_t nx, ny, nz;
  [[nodiscard]] std::size_t size() const { return nx * ny * nz; }
};
/// A box in the second-level cache, one of the paper's size, and two that are larger than most caches.
inline constexpr Box in_cache{20, 20, 20}, paper_size{40, 40, 47}, large{60, 60, 83}, million{100, 100, 100};

/// State of a box in arrays of each component, at rest in its reference configuration but moving.
template <class S>
struct State {
  std::array<std::vector<S>, 3> x, v, f;

  explicit State(const Box& box) {
    for (std::size_t c = 0; c < 3; ++c)
      for (auto* component : {&x[c], &v[c], &f[c]}) component->reserve(box.size());
    for (std::size_t i = 0; i < box.nx; ++i)
      for (std::size_t j = 0; j < box.ny; ++j)
        for (std::size_t k = 0; k < box.nz; ++k) {
          const std::array<std::size_t, 3> cell = {i, j, k};
          for (std::size_t c = 0; c < 3; ++c) {
            x[c].push_back(static_cast<S>(spacing * static_cast<double>(cell[c])));
            v[c].push_back(static_cast<S>(0.1 * noise(3 * x[c].size() + c)));
            f[c].push_back(S(0));
          }
        }
  }
  [[nodiscard]] std::size_t size() const { return x[0].size(); }
  [[nodiscard]] auto positions() { return hmps::vectors(x[0], x[1], x[2]); }
  [[nodiscard]] auto velocities() { return hmps::vectors(v[0], v[1], v[2]); }
  [[nodiscard]] auto forces() { return hmps::vectors(f[0], f[1], f[2]); }
};

/// The positions of a box moved off the lattice by up to a tenth of a spacing, in the order of the lattice or shuffled.
template <class S>
[[nodiscard]] State<S> cloud(const Box& box, bool shuffled) {
  State<S> state(box);
  for (std::size_t c = 0; c < 3; ++c)
    for (std::size_t i = 0; i < box.size(); ++i) state.x[c][i] += static_cast<S>(0.1 * spacing * noise(3 * i + c));
  if (shuffled)
    for (std::size_t i = box.size() - 1; i > 0; --i) {
      const auto j = static_cast<std::size_t>((noise(i) + 1) / 2 * static_cast<double>(i));
      for (auto& component : state.x) std::swap(component[i], component[j]);
    }
  return state;
}

template <class S>
[[nodiscard]] std::string name_of() {
  return std::is_same_v<S, float> ? "float" : "double";
}
/// The name of kernels in `K` on a state in `S`.
template <class K, class S>
[[nodiscard]] std::string kind() {
  return std::is_same_v<K, S> ? name_of<K>() : "mixed";
}

/// Reports that each iteration processed `items` items at `cost` each. Zero members of `cost` are not reported.
inline void count(benchmark::State& run, std::size_t items, const Cost& cost) {
  const double done = static_cast<double>(run.iterations()) * static_cast<double>(items);
  run.SetItemsProcessed(run.iterations() * static_cast<std::int64_t>(items));
  if (cost.bytes > 0) run.SetBytesProcessed(static_cast<std::int64_t>(done * cost.bytes));
  if (cost.flop > 0) run.counters["FLOP"] = benchmark::Counter(done * cost.flop, benchmark::Counter::kIsRate);
}

/// Runs a benchmark once, however many repetitions are asked for, if it takes seconds: what is done once before a
/// simulation, with a million particles.
inline benchmark::internal::Benchmark* once_if_long(benchmark::internal::Benchmark* registered, const Box& box) {
  return box.size() < million.size() ? registered : registered->Repetitions(1);
}

/// Registers `measure(run, executor)` as `name/THREADS`: for one thread, timed by processor time, and for more threads,
/// timed by the clock. Calls `adjust` with each registered benchmark.
template <class Measure, class Adjust>
void add_threads(const std::string& name, const Measure& measure, benchmark::TimeUnit unit, const Adjust& adjust) {
  adjust(benchmark::RegisterBenchmark((name + "/1").c_str(), [measure](benchmark::State& run) {
           measure(run, hmps::Serial{});
         })->Unit(unit));
#ifdef _OPENMP
  for (int threads = 2; threads <= omp_get_num_procs(); threads *= 2)
    adjust(
        benchmark::RegisterBenchmark((name + "/" + std::to_string(threads)).c_str(),
                                     [measure, threads](benchmark::State& run) { measure(run, hmps::OpenMP{threads}); })
            ->UseRealTime()
            ->Unit(unit));
#endif
}
template <class Measure>
void add_threads(const std::string& name, const Measure& measure, benchmark::TimeUnit unit = benchmark::kMillisecond) {
  add_threads(name, measure, unit, [](benchmark::internal::Benchmark*) {});
}

}  // namespace bench
