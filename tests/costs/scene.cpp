// SPDX-License-Identifier: MIT
// Small scenes of which each leaves out something else, for counting instructions and bytes. Usage: scene NAME STEPS
// writes the number of particles and the bytes that the components took.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <hmps/hmps.hpp>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "body.hpp"

namespace {

using namespace costs;

#ifdef __clang__
constexpr const char* compiler = "clang++ " __clang_version__;
#else
constexpr const char* compiler = "g++ " __VERSION__;
#endif

/// A block under the internal force of what `make(bonds, body)` returns.
template <int D, class K = double, class Make>
void vibrate(int steps, Make&& make) {
  Body<D> body;
  const std::size_t before = heap();
  const hmps::LatticeBonds<K, D> bonds(hmps::vectors(body.reference), {.spacing = spacing});
  auto force = make(bonds, body);
  advance(body, force, steps);
  std::printf("%zu %zu\n", body.size(), heap() - before);
}

template <int D, class K = double>
void all_terms(int steps) {
  vibrate<D, K>(steps, [](const auto& bonds, auto&) {
    return hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2),
                                hmps::viscous(density, viscosity));
  });
}

/// Two halves that may touch, `gap` spacings apart or, if negative, on top of each other and closing, with or without
/// their contact.
void halves(int steps, double gap, bool meet) {
  Body<3> body;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body.upper[i] != 0) {
      body.position[i][0] += gap * spacing;
      if (gap < 0) body.velocity[i][0] = -1;
    }
  const auto same = [&](std::size_t i, std::size_t j) { return body.upper[i] == body.upper[j]; };
  const auto x = hmps::vectors(body.position), v = hmps::vectors(body.velocity), f = hmps::vectors(body.load);
  const auto F = hmps::matrices(body.gradient);
  std::vector<hmps::Index> skin[2], wall[2];
  for (std::size_t i = 0; i < body.size(); ++i) {
    const double depth = std::abs(body.reference[i][0] / spacing - 4.5);
    const std::size_t half = body.upper[i] != 0 ? 1 : 0;
    if (depth < 1) skin[half].push_back(static_cast<hmps::Index>(i));
    if (depth < 2) wall[half].push_back(static_cast<hmps::Index>(i));
  }
  const std::size_t before = heap();
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(body.reference), {.spacing = spacing}, same);
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2),
                                    hmps::viscous(density, viscosity), hmps::record(F));
  if (!meet) {
    advance(body, force, steps);
  } else {
    hmps::MetaballContact<double, 3> contact({.spacing = spacing, .density = density, .friction = 0.1});
    const auto below = contact.add_organ({"below", skin[0], wall[0]});
    const auto above = contact.add_organ({"above", skin[1], wall[1]});
    contact.add_pair(below, above);
    std::size_t contacts = 0;
    for (int step = 0; step < steps; ++step) {
      force(x, v, f);
      hmps::kick(v, f, density, time_step);
      hmps::set_zero(f);
      contacts += contact.add(x, v, F, f, time_step).contacts;
      hmps::kick(v, f, density, time_step);
      hmps::drift(x, v, time_step);
    }
    std::fprintf(stderr, "%zu contacts\n", contacts);
  }
  std::printf("%zu %zu\n", body.size(), heap() - before);
}

/// The upper half has a forced displacement.
void region(int steps, bool restricted) {
  Body<3> body;
  std::vector<hmps::Index> led;
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body.upper[i]) led.push_back(static_cast<hmps::Index>(i));
  const auto x = hmps::vectors(body.position), v = hmps::vectors(body.velocity), f = hmps::vectors(body.load);
  const std::size_t before = heap();
  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(body.reference), {.spacing = spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2),
                                    hmps::viscous(density, viscosity));
  if (restricted) force.restrict_to([&](std::size_t i) { return !body.upper[i]; });
  const hmps::Keyframes<3> path{{.time = 0, .value = hmps::Vector<double, 3>::Zero()},
                                {.time = 1, .value = hmps::Vector<double, 3>(0.01, 0, 0)}};
  const hmps::ControlRegion leader(led, hmps::vectors(body.reference), hmps::Translation<3>{path});
  for (int step = 1; step <= steps; ++step) {
    force(x, v, f);
    hmps::kick(v, f, density, time_step);
    leader.prescribe(x, v, step * time_step, time_step);
    hmps::drift(x, v, time_step);
  }
  std::printf("%zu %zu\n", body.size(), heap() - before);
}

/// `steps` times all neighbours of the particles, which lie a little off the lattice; `find(x)` returns how many.
template <class Find>
void search(int steps, Find&& find) {
  Body<3> body;
  for (std::size_t i = 0; i < body.size(); ++i)
    for (int c = 0; c < 3; ++c) body.position[i][c] += 1e-4 * std::sin(static_cast<double>(7 * i) + c);
  std::size_t found = 0;
  for (int step = 0; step < steps; ++step) found += find(hmps::vectors(std::as_const(body.position)));
  std::fprintf(stderr, "%zu neighbours\n", found);
  std::printf("%zu 0\n", body.size());
}

}  // namespace

int main(int argc, char** argv) {
  const std::map<std::string, std::function<void(int)>> scenes = {
      {"elastic",
       [](int steps) {
         vibrate<3>(steps, [](const auto& bonds, auto&) { return hmps::internal_force(bonds, hmps::elastic(tissue)); });
       }},
      {"elastic_artificial",
       [](int steps) {
         vibrate<3>(steps, [](const auto& bonds, auto&) {
           return hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2));
         });
       }},
      {"viscous_alone",
       [](int steps) {
         vibrate<3>(steps,
                    [](const auto& bonds, auto&) { return hmps::internal_force(bonds, hmps::viscous(density, 2e-3)); });
       }},
      {"all_terms", [](int steps) { all_terms<3>(steps); }},
      {"all_terms_float", [](int steps) { all_terms<3, float>(steps); }},
      {"all_terms_2d", [](int steps) { all_terms<2>(steps); }},
      {"recorded",
       [](int steps) {
         vibrate<3>(steps, [](const auto& bonds, auto& body) {
           return hmps::internal_force(bonds, hmps::elastic(tissue), hmps::artificial(young / 2),
                                       hmps::viscous(density, viscosity), hmps::record(hmps::matrices(body.gradient)));
         });
       }},
      {"halves", [](int steps) { halves(steps, 0, false); }},
      {"halves_far", [](int steps) { halves(steps, 20, true); }},
      {"halves_touching", [](int steps) { halves(steps, -0.05, true); }},
      {"search_tree",
       [](int steps) {
         search(steps, [](const auto& x) { return hmps::find_neighbours(x, 1.75 * spacing).neighbour.size(); });
       }},
      {"search_grid",
       [](int steps) {
         search(steps, [](const auto& x) {
           hmps::detail::Grid<double, 3> grid;
           grid.build(x.size(), 1.75 * spacing, [&](std::size_t k) { return x[k]; });
           std::size_t found = 0;
           for (std::size_t i = 0; i < x.size(); ++i)
             grid.visit(x[i], 1.75 * spacing, [&](hmps::Index k, double) { found += k != i ? 1 : 0; });
           return found;
         });
       }},
      {"compiler", [](int) { std::puts(compiler); }},
      {"region", [](int steps) { region(steps, true); }},
      {"region_unrestricted", [](int steps) { region(steps, false); }},
  };
  const auto found = argc == 3 ? scenes.find(argv[1]) : scenes.end();
  if (found == scenes.end()) return 2;
  found->second(std::atoi(argv[2]));
}
