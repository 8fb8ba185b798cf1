// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <map>
#include <vector>

#include "components/cost.hpp"
#include "hmps/lanes/lanes.hpp"

/// The limits of one core with which the time of a kernel is compared: multiply-adds, memory traffic, and the reading
/// of neighbours by bonds, measured by code that is as portable as that of the library.
namespace bench {

/// `rounds` times `chains` independent multiply-adds of 64 bytes each from `start` on; returns a number that depends on
/// all of them.
template <class T, int chains>
[[gnu::noinline]] T multiply_add(std::size_t rounds, T start) {
  using Vector = hmps::Lanes<T>;
  const Vector a(T(0.5)), b(T(0.25));
  Vector x[chains];
  for (int c = 0; c < chains; ++c) x[c] = Vector(start + T(c));
  for (std::size_t r = 0; r < rounds; ++r)
    for (int c = 0; c < chains; ++c) x[c] = x[c] * a + b;
  T sum = 0;
  for (int c = 0; c < chains; ++c)
    for (int l = 0; l < hmps::Lanes<T>::width; ++l) sum += x[c].lane[l];
  return sum;
}
/// Operations of `multiply_add`, not counting the last sum.
template <class T, int chains>
[[nodiscard]] double multiply_add_flop(std::size_t rounds) {
  return 2. * chains * hmps::Lanes<T>::width * static_cast<double>(rounds);
}

/// Sums of 64 bytes each from unaligned addresses in an array that fits into the first-level cache. Bonds read the
/// values of consecutive neighbours in this way.
template <class T>
class Gather {
 public:
  Gather() : values_(2048 / sizeof(T) + 2 * width, T(1)) {}
  [[gnu::noinline]] T operator()() const {
    hmps::Lanes<T> sum[4];
    for (auto& part : sum) part = hmps::Lanes<T>(0);
    for (std::size_t i = 0; i < 2048 / sizeof(T); i += width)
      for (std::size_t k = 0; k < 4; ++k) sum[k] += hmps::detail::load(values_.data() + i + k + 1);
    T total = 0;
    for (const auto& part : sum)
      for (std::size_t l = 0; l < width; ++l) total += part.lane[l];
    return total;
  }
  [[nodiscard]] static double bytes() { return 4 * 2048; }

 private:
  static constexpr auto width = static_cast<std::size_t>(hmps::Lanes<T>::width);
  std::vector<T> values_;
};

/// a = b + s c over arrays of doubles that take `bytes` together.
class Triad {
 public:
  explicit Triad(std::size_t bytes) : a_(std::max<std::size_t>(bytes / 24, 64), 0.), b_(a_), c_(a_) {}
  [[gnu::noinline]] void operator()() {
    double* const a = a_.data();
    const double *const b = b_.data(), *const c = c_.data();
    const std::size_t n = a_.size();
    for (std::size_t i = 0; i < n; ++i) a[i] = b[i] + 3. * c[i];
  }
  [[nodiscard]] double bytes() const { return 24. * static_cast<double>(a_.size()); }

 private:
  std::vector<double> a_, b_, c_;
};

/// Work per second of processor time by `run()`, each call of which does the amount `work`: the best of several trials
/// of a few milliseconds.
template <class Run>
[[nodiscard]] double best_rate(double work, Run&& run) {
  run();
  double best = 0;
  for (int attempt = 0; attempt < 9; ++attempt) {
    const std::clock_t start = std::clock();
    double done = 0;
    std::clock_t spent = 0;
    while (spent < CLOCKS_PER_SEC / 100) {
      run();
      done += work;
      spent = std::clock() - start;
    }
    best = std::max(best, done * CLOCKS_PER_SEC / static_cast<double>(spent));
  }
  return best;
}

/// Operations per second of one core in `T`, multiply-adds in registers; measured at the first call.
template <class T>
[[nodiscard]] double peak_flop() {
  static const double peak = [] {
    constexpr std::size_t rounds = 20000;
    volatile T number = 0;  // hides the value from the compiler
    // Few chains do not hide the latency if the core has many units; many chains do not fit if it has few registers.
    return std::max(best_rate(multiply_add_flop<T, 6>(rounds), [&] { number = multiply_add<T, 6>(rounds, number); }),
                    best_rate(multiply_add_flop<T, 12>(rounds), [&] { number = multiply_add<T, 12>(rounds, number); }));
  }();
  return peak;
}

/// Bytes per second of one core over a working set of `bytes`; measured at the first call for a size.
[[nodiscard]] inline double bandwidth(std::size_t bytes) {
  static std::map<std::size_t, double> measured;
  const auto found = measured.find(bytes);
  if (found != measured.end()) return found->second;
  Triad triad(bytes);
  return measured[bytes] = best_rate(triad.bytes(), triad);
}

/// Bytes of their neighbours that bonds can read per second; measured at the first call.
template <class T>
[[nodiscard]] double gather_rate() {
  static const double rate = [] {
    volatile T sink = 0;
    const Gather<T> gather;
    return best_rate(1000 * Gather<T>::bytes(), [&] {
      for (int i = 0; i < 1000; ++i) sink = gather();
    });
  }();
  return rate;
}

/// The most items per second that multiply-adds and memory allow, for items of `cost` with numbers of type `T` in a
/// working set of `bytes`.
template <class T>
[[nodiscard]] double attainable(const Cost& cost, std::size_t bytes) {
  return std::min(peak_flop<T>() / cost.flop, bandwidth(bytes) / cost.bytes);
}

}  // namespace bench
