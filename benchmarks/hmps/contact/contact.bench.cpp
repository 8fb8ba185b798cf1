// SPDX-License-Identifier: MIT
// The cost of a call of contact, including the updates of its lists, for two slabs that lie on each other. Each has 64
// x 64 particles and three layers. They deform, move up and down a little, and slide on each other by a tenth of a
// spacing in a hundred steps. Items are the slaves of both slabs, touching or not, timed by processor time for one
// thread and by the clock for several.
//
//   contact/SHARE/DEPTH/KIND/THREADS   SHARE: percent of the slaves that are pressed in; the others hover
//                                      1.5 spacings above the wall. DEPTH: of those pressed in, in
//                                      hundredths of a spacing
//   contact/apart/KIND/THREADS         ten spacings between the slabs
//
// The counters give the number of slaves that touch and how often the lists were rebuilt.
#include "hmps/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "components/support.hpp"

namespace {

using hmps::Index;
constexpr std::size_t width = 64, layers = 3;

template <class S>
struct Slabs {
  using Point = hmps::Vector<S, 3>;
  std::vector<Point> x, start, v, f;
  std::vector<hmps::Matrix<S, 3>> F;
  std::vector<Index> lower_skin, lower_wall, upper_skin, upper_wall;

  /// `gap(column)` is the distance in spacings from the top layer of the lower slab to the bottom layer of the upper
  /// one.
  template <class Gap>
  explicit Slabs(Gap&& gap) {
    for (const bool upper : {false, true})
      for (std::size_t a = 0; a < width; ++a)
        for (std::size_t b = 0; b < width; ++b)
          for (std::size_t c = 0; c < layers; ++c) {
            const auto i = static_cast<Index>(x.size());
            const double height = static_cast<double>(c) + (upper ? layers - 1 + gap(a) : 0.);
            const double shift = upper ? 0.3 : 0.;
            x.push_back(static_cast<S>(bench::spacing) * Point(static_cast<S>(static_cast<double>(a) + shift),
                                                               static_cast<S>(static_cast<double>(b) + shift),
                                                               static_cast<S>(height)));
            if (upper ? c == 0 : c == layers - 1) (upper ? upper_skin : lower_skin).push_back(i);
            if (upper ? c <= 1 : c >= layers - 2) (upper ? upper_wall : lower_wall).push_back(i);
          }
    start = x;
    v.assign(x.size(), Point::Zero());
    f.assign(x.size(), Point::Zero());
    for (std::size_t i = 0; i < x.size(); ++i) {
      F.push_back(hmps::Matrix<S, 3>::Identity());
      for (int c = 0; c < 9; ++c)
        F[i](c % 3, c / 3) += static_cast<S>(0.02 * bench::noise(9 * i + static_cast<std::size_t>(c)));
    }
  }
  void move(std::size_t step) {
    const double slide = 1e-3 * static_cast<double>(step % 1000);
    const Point by =
        static_cast<S>(bench::spacing) *
        Point(static_cast<S>(slide), S(0), static_cast<S>(0.02 * std::sin(0.02 * static_cast<double>(step))));
    for (std::size_t i = x.size() / 2; i < x.size(); ++i) x[i] = start[i] + by;
  }
};

template <class S, class Gap, class Executor>
void contact(benchmark::State& run, Gap&& gap, const Executor& execute) {
  Slabs<S> slabs(gap);
  hmps::MetaballContact<S, 3> touch({.spacing = bench::spacing, .density = bench::density, .friction = 0.1});
  touch.add_pair(touch.add_organ({.name = "lower", .slaves = slabs.lower_skin, .masters = slabs.lower_wall}),
                 touch.add_organ({.name = "upper", .slaves = slabs.upper_skin, .masters = slabs.upper_wall}));
  hmps::ContactReport<S> report;
  std::size_t step = 0, contacts = 0;
  for (auto _ : run) {
    slabs.move(step++);
    report = touch.add(hmps::vectors(slabs.x), hmps::vectors(slabs.v), hmps::matrices(slabs.F), hmps::vectors(slabs.f),
                       bench::time_step, execute);
    contacts += report.contacts;
  }
  run.SetItemsProcessed(static_cast<std::int64_t>(run.iterations()) * static_cast<std::int64_t>(2 * width * width));
  run.counters["touching"] = static_cast<double>(contacts) / static_cast<double>(step);
  run.counters["steps_per_rebuild"] = static_cast<double>(step) / static_cast<double>(report.rebuilds);
}

template <class S, class Gap>
void add(const std::string& name, const Gap& gap) {
  bench::add_threads(
      "contact/" + name + "/" + bench::name_of<S>(),
      [gap](benchmark::State& run, const auto& execute) { contact<S>(run, gap, execute); }, benchmark::kMicrosecond);
}

template <class S>
void add_all() {
  add<S>("apart", [](std::size_t) { return 10.; });
  for (const std::size_t share : {0, 10, 50, 100})
    for (const int depth : {5, 30}) {
      if (share == 0 && depth != 5) continue;
      add<S>(std::to_string(share) + "/" + std::to_string(depth),
             [share, depth](std::size_t column) { return column * 100 < share * width ? 1. - 0.01 * depth : 1.5; });
    }
}

[[maybe_unused]] const bool added = [] {
  add_all<float>();
  add_all<double>();
  return true;
}();

}  // namespace
