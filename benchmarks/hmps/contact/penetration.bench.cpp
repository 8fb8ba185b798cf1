// SPDX-License-Identifier: MIT
// Support and penetration of deformed slaves, (37, 38): penetration/KIND. Items are slaves.
#include "hmps/contact/penetration.hpp"

#include <vector>

#include "components/support.hpp"

namespace {

template <class S>
void penetration(benchmark::State& run) {
  std::vector<hmps::Matrix<S, 3>> F(256, hmps::Matrix<S, 3>::Identity());
  std::vector<hmps::Vector<S, 3>> normal(F.size());
  for (std::size_t n = 0; n < F.size(); ++n) {
    for (int c = 0; c < 9; ++c)
      F[n](c % 3, c / 3) += static_cast<S>(0.2 * bench::noise(12 * n + static_cast<std::size_t>(c)));
    for (int c = 0; c < 3; ++c) normal[n][c] = static_cast<S>(bench::noise(12 * n + 9 + static_cast<std::size_t>(c)));
    normal[n].normalize();
  }
  const S l0 = static_cast<S>(bench::spacing);
  std::size_t n = 0;
  for (auto _ : run) {
    const std::size_t i = n++ % F.size();
    benchmark::DoNotOptimize(hmps::penetration(hmps::slave_support<S, 3>(F[i], normal[i], S(0.5) * l0), S(0.45) * l0));
  }
  // F^T n, its length, times l0 / 2, minus the distance.
  bench::count(run, 1, {15 + 6 + 1 + 1, 12 * sizeof(S)});
}

[[maybe_unused]] const bool added = [] {
  benchmark::RegisterBenchmark("penetration/float", penetration<float>);
  benchmark::RegisterBenchmark("penetration/double", penetration<double>);
  return true;
}();

}  // namespace
