// SPDX-License-Identifier: MIT
// Filling a shape with particles: fill/SHAPE/KIND/SITES/THREADS; the shapes are a ball and a thick, open shell of an
// ellipsoid, which is composed like an organ. Items are the sites that are tested.
#include "hmps/particles/lattice.hpp"

#include <string>

#include "components/support.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"

namespace {

using namespace bench;

template <class S, class Shape>
void add(const std::string& name, int side, const Shape& shape) {
  using Point = hmps::Vector<S, 3>;
  const hmps::Box<S, 3> box{Point::Constant(S(-1)), Point::Constant(S(1))};
  const S step = S(2) / static_cast<S>(side);
  const auto sites =
      static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(side + 1) * static_cast<std::size_t>(side + 1);
  add_threads("fill/" + name + "/" + name_of<S>() + "/" + std::to_string(sites),
              [=](benchmark::State& run, const auto& execute) {
                std::size_t kept = 0;
                for (auto _ : run) kept = hmps::fill_lattice(shape, box, step, Point::Zero(), execute).size();
                const double per_site = static_cast<double>(kept) / static_cast<double>(sites);
                count(run, sites, {0, per_site * sizeof(Point)});
              });
}

template <class S>
void add_all() {
  const hmps::Ball<S, 3> ball{.radius = S(1)};
  const auto organ =
      hmps::subtract(hmps::shell(hmps::Ellipsoid<S, 3>{.half_axes = {S(0.9), S(0.8), S(0.7)}}, S(0.1)),
                     hmps::HalfSpace<S, 3>{.point = {S(0), S(0), S(-0.3)}, .outward = {S(0), S(0), S(1)}});
  for (const int side : {26, 52, 125}) {
    add<S>("ball", side, ball);
    add<S>("organ", side, organ);
  }
}

[[maybe_unused]] const bool added = [] {
  add_all<float>();
  add_all<double>();
  return true;
}();

}  // namespace
