// SPDX-License-Identifier: MIT
// The stress of each law at random deformation gradients, as the sweeps evaluate it: law/NAME/KIND. Items are
// particles.
#include "hmps/laws/law.hpp"

#include <string>
#include <vector>

#include "components/support.hpp"
#include "hmps/lanes/lane_math.hpp"
#include "hmps/laws/continued.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"

namespace {

template <class K, class Law>
void stress(benchmark::State& run, const Law& law) {
  using T = hmps::Lanes<K>;
  std::vector<hmps::Matrix<T, 3>> F(64);
  for (std::size_t n = 0; n < F.size(); ++n)
    for (int k = 0; k < 9; ++k)
      for (int l = 0; l < T::width; ++l)
        F[n](k % 3, k / 3).lane[l] =
            static_cast<K>((k % 4 == 0 ? 1 : 0) + 0.1 * bench::noise((n * 9 + static_cast<std::size_t>(k)) * 16 +
                                                                     static_cast<std::size_t>(l)));
  std::size_t n = 0;
  for (auto _ : run) {
    const hmps::Matrix<T, 3> P = hmps::first_piola_kirchhoff(law, F[n++ % F.size()]);
    benchmark::DoNotOptimize(P);
  }
  bench::count(run, T::width, {bench::stress_flop(law), 18 * sizeof(K)});
}

template <class Law>
void add(const std::string& name, const Law& law) {
  benchmark::RegisterBenchmark(("law/" + name + "/float").c_str(),
                               [law](benchmark::State& run) { stress<float>(run, law); });
  benchmark::RegisterBenchmark(("law/" + name + "/double").c_str(),
                               [law](benchmark::State& run) { stress<double>(run, law); });
}

[[maybe_unused]] const bool added = [] {
  const auto law = hmps::MooneyRivlin<double>::from_young(bench::young, bench::d1);
  add("mooney_rivlin", law);
  add("mooney_rivlin_continued", hmps::Continued{law, 0.2});
  add("neo_hookean", hmps::NeoHookean<double>::from_young_poisson(bench::young, 0.45));
  add("saint_venant_kirchhoff", hmps::SaintVenantKirchhoff<double>::from_young_poisson(bench::young, 0.45));
  add("linear_elastic", hmps::LinearElastic<double>::from_young_poisson(bench::young, 0.45));
  return true;
}();

}  // namespace
