// SPDX-License-Identifier: MIT
// Z^-1, (29), for random sums from out of reach to deep inside: z_inverse/BALL/KIND. Items are slaves.
#include "hmps/contact/normal_density.hpp"

#include <string>
#include <vector>

#include "components/support.hpp"

namespace {

template <class S, class Ball>
void inverse(benchmark::State& run) {
  const hmps::NormalDensity<S, 3, Ball> Z(static_cast<S>(bench::spacing));
  const S top = Z(Z.deepest());
  std::vector<S> density(1024);
  for (std::size_t n = 0; n < density.size(); ++n) density[n] = top * static_cast<S>(0.55 + 0.6 * bench::noise(n));
  std::size_t n = 0;
  for (auto _ : run) benchmark::DoNotOptimize(Z.inverse(density[n++ % density.size()]));
  bench::count(run, 1, {0, 2 * sizeof(S)});
}

[[maybe_unused]] const bool added = [] {
  benchmark::RegisterBenchmark("z_inverse/paper/float", inverse<float, hmps::PaperMetaball>);
  benchmark::RegisterBenchmark("z_inverse/paper/double", inverse<double, hmps::PaperMetaball>);
  benchmark::RegisterBenchmark("z_inverse/smooth/float", inverse<float, hmps::SmoothMetaball>);
  benchmark::RegisterBenchmark("z_inverse/smooth/double", inverse<double, hmps::SmoothMetaball>);
  return true;
}();

}  // namespace
