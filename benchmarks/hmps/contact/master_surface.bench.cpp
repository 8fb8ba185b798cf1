// SPDX-License-Identifier: MIT
// The sums of a slave over the masters on its list, about two in three of them within reach. Items are
// slave-master pairs.
//
//   metaball/reach/BALL/KIND   (26, 28, 30): sum and normal, four lanes for the components
//   metaball/plain/BALL/KIND   the same with plain small vectors
#include "hmps/contact/master_surface.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <type_traits>
#include <vector>

#include "components/support.hpp"
#include "hmps/core/math.hpp"

namespace {

/// A r, r A r over r_e^2, c, the sums of c and of its gradient.
template <class S, class Ball>
bench::Cost pair_cost() {
  return {15 + 5 + 1 + (std::is_same_v<Ball, hmps::PaperMetaball> ? 1 : 6) + 1 + 6, 13 * sizeof(S)};
}

constexpr std::size_t walls = 64, masters = 30;

template <class S>
struct Wall {
  using Quad = hmps::detail::Quad<S>;
  struct Master {
    Quad x, A[3];
  };
  std::vector<hmps::Vector<S, 3>> x;
  std::vector<hmps::Matrix<S, 3>> A;
  std::vector<Master> quads;
  explicit Wall(double radius) {
    for (std::size_t n = 0; n < walls * masters; ++n) {
      hmps::Matrix<S, 3> B = hmps::Matrix<S, 3>::Identity();
      hmps::Vector<S, 3> r;
      for (int c = 0; c < 9; ++c)
        B(c % 3, c / 3) += static_cast<S>(0.2 * bench::noise(12 * n + static_cast<std::size_t>(c)));
      for (int c = 0; c < 3; ++c)
        r[c] = static_cast<S>(0.8 * radius * bench::spacing * bench::noise(12 * n + 9 + static_cast<std::size_t>(c)));
      x.push_back(r);
      A.push_back(hmps::right_cauchy_green<S, 3>(B));
      quads.emplace_back();
      hmps::detail::set_quad<S>(r, quads.back().x);
      for (int c = 0; c < 3; ++c) hmps::detail::set_quad<S>(A.back().col(c), quads.back().A[c]);
    }
  }
};

template <class S, class Ball>
void reach(benchmark::State& run) {
  const Wall<S> wall(Ball::radius);
  const S scale = static_cast<S>(1 / std::pow(Ball::radius * bench::spacing, 2));
  std::vector<S> weight(masters);
  std::size_t w = 0;
  for (auto _ : run) {
    hmps::MasterSurface<S, 3, Ball> surface;
    for (std::size_t k = 0; k < masters; ++k) {
      const auto& master = wall.quads[w * masters + k];
      weight[k] = surface.reach(master.A, master.x, scale);
    }
    benchmark::DoNotOptimize(surface);
    benchmark::DoNotOptimize(weight.data());
    benchmark::ClobberMemory();
    w = (w + 1) % walls;
  }
  bench::count(run, masters, pair_cost<S, Ball>());
}

template <class S, class Ball>
void plain(benchmark::State& run) {
  const Wall<S> wall(Ball::radius);
  const S scale = static_cast<S>(1 / std::pow(Ball::radius * bench::spacing, 2));
  std::vector<S> weight(masters);
  std::size_t w = 0;
  for (auto _ : run) {
    hmps::Vector<S, 3> normal = hmps::Vector<S, 3>::Zero();
    S density = 0;
    for (std::size_t k = 0; k < masters; ++k) {
      const hmps::Vector<S, 3>& r = wall.x[w * masters + k];
      const hmps::Vector<S, 3> y = wall.A[w * masters + k] * r;
      const S s = r.dot(y) * scale;
      weight[k] = 0;
      if (s >= S(1)) continue;
      weight[k] = Ball::value(s);
      density += weight[k];
      normal += Ball::slope(s) * y;
    }
    benchmark::DoNotOptimize(density);
    benchmark::DoNotOptimize(normal);
    benchmark::DoNotOptimize(weight.data());
    benchmark::ClobberMemory();
    w = (w + 1) % walls;
  }
  bench::count(run, masters, pair_cost<S, Ball>());
}

template <class S, class Ball>
void add(const std::string& ball) {
  benchmark::RegisterBenchmark(("metaball/reach/" + ball + "/" + bench::name_of<S>()).c_str(), reach<S, Ball>);
  benchmark::RegisterBenchmark(("metaball/plain/" + ball + "/" + bench::name_of<S>()).c_str(), plain<S, Ball>);
}

[[maybe_unused]] const bool added = [] {
  add<float, hmps::PaperMetaball>("paper");
  add<double, hmps::PaperMetaball>("paper");
  add<float, hmps::SmoothMetaball>("smooth");
  add<double, hmps::SmoothMetaball>("smooth");
  return true;
}();

}  // namespace
