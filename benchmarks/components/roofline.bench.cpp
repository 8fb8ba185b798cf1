// SPDX-License-Identifier: MIT
// The limits of one core with which the step is compared:
//
//   roofline/fma/KIND/CHAINS   multiply-adds in registers, so many lanes side by side (see peak_flop); the counter FLOP
//                              is operations per second
//   roofline/gather/KIND       64 bytes from places that are not aligned, in the first-level cache; bytes per second
//   roofline/triad/KIBIBYTES   a = b + s c over a working set of this size; bytes per second
#include "components/roofline.hpp"

#include <fstream>

#include "components/support.hpp"

namespace {

using namespace bench;

template <class T, int chains>
void fma(benchmark::State& run) {
  constexpr std::size_t rounds = 20000;
  T number = 0;
  for (auto _ : run) {
    number = multiply_add<T, chains>(rounds, number);
    benchmark::DoNotOptimize(number);
  }
  run.counters["FLOP"] = benchmark::Counter(
      static_cast<double>(run.iterations()) * multiply_add_flop<T, chains>(rounds), benchmark::Counter::kIsRate);
}

template <class T>
void gather(benchmark::State& run) {
  const Gather<T> gather;
  for (auto _ : run) benchmark::DoNotOptimize(gather());
  run.SetBytesProcessed(static_cast<std::int64_t>(static_cast<double>(run.iterations()) * Gather<T>::bytes()));
}

void triad(benchmark::State& run, std::size_t bytes) {
  Triad triad(bytes);
  for (auto _ : run) {
    triad();
    benchmark::ClobberMemory();
  }
  run.SetBytesProcessed(static_cast<std::int64_t>(static_cast<double>(run.iterations()) * triad.bytes()));
}

#ifdef __clang__
constexpr const char* compiler = "clang++ " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// Threads of other processes that are running at this moment, if the system provides the number.
int others_running() {
  std::ifstream file("/proc/loadavg");
  double load[3];
  int running = 1;
  if (!(file >> load[0] >> load[1] >> load[2] >> running)) return 0;
  return running - 1;  // this one
}

[[maybe_unused]] const bool added = [] {
  benchmark::AddCustomContext("compiler", compiler);
  benchmark::AddCustomContext("others_running", std::to_string(others_running()));
  benchmark::RegisterBenchmark("roofline/fma/float/6", fma<float, 6>);
  benchmark::RegisterBenchmark("roofline/fma/float/12", fma<float, 12>);
  benchmark::RegisterBenchmark("roofline/fma/double/6", fma<double, 6>);
  benchmark::RegisterBenchmark("roofline/fma/double/12", fma<double, 12>);
  benchmark::RegisterBenchmark("roofline/gather/float", gather<float>);
  benchmark::RegisterBenchmark("roofline/gather/double", gather<double>);
  for (const std::size_t kibibytes : {16u, 256u, 512u, 4096u, 16384u, 65536u, 262144u})
    benchmark::RegisterBenchmark(("roofline/triad/" + std::to_string(kibibytes)).c_str(),
                                 [kibibytes](benchmark::State& run) { triad(run, kibibytes * 1024); });
  return true;
}();

}  // namespace
