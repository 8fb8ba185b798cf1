// SPDX-License-Identifier: MIT
// Compiled with -ffast-math, with which the compiler takes every number for finite: each check must see NaN and
// infinities all the same. Returns how many did not.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "hmps/hmps.hpp"

namespace {

using V = hmps::Vector<double, 3>;
using M = hmps::Matrix<double, 3>;

int silent = 0;

template <class Call>
void refuses(const char* what, double value, Call&& call) {
  try {
    call();
  } catch (const hmps::Error&) {
    return;
  }
  std::fprintf(stderr, "%s: %g passes in silence\n", what, value);
  ++silent;
}

void state(double bad, const std::vector<V>& X) {
  const std::vector<V> rest(X.size(), V::Zero());
  const std::vector<M> F(X.size(), M::Identity());
  auto x = X, v = rest;
  auto G = F;
  x[5][1] = v[3][0] = G[3](0, 0) = bad;
  const auto check = [](auto& positions, auto& velocities, auto& gradients) {
    hmps::check_state(hmps::vectors(positions), hmps::vectors(velocities), hmps::matrices(gradients), {});
  };
  refuses("position", bad, [&] { check(x, rest, F); });
  refuses("velocity", bad, [&] { check(X, v, F); });
  refuses("deformation gradient", bad, [&] { check(X, rest, G); });
  refuses("positions of bonds", bad, [&] { hmps::BondList<double, 3>(hmps::vectors(x), {.spacing = 1e-3}); });
  refuses("positions on a lattice", bad, [&] { hmps::LatticeBonds<double, 3>(hmps::vectors(x), {.spacing = 1e-3}); });
  refuses("positions to search", bad, [&] { (void)hmps::find_neighbours(hmps::vectors(x), 1e-3); });
  refuses("positions of a grid", bad, [&] {
    hmps::detail::Grid<double, 3> grid;
    grid.build(x.size(), 1e-3, [&](std::size_t k) { return x[k]; });
  });
  refuses("normal of a wall", bad, [&] {
    auto gradients = F;
    auto normals = rest;
    normals[4][2] = bad;
    hmps::impose_plane_stress(hmps::matrices(gradients), hmps::NeoHookean<>{3e4, 6e4}, hmps::vectors(normals));
  });
  refuses("shape of a wall", bad,
          [&] { (void)hmps::wall_normals([&](const V&) { return bad; }, hmps::vectors(X), 1e-3); });
  refuses("weak particles", bad, [&] { (void)hmps::find_weak(hmps::vectors(x), {.spacing = 1e-3}); });
  refuses("prescribed motion", bad, [&] {
    const hmps::ControlRegion region({3}, hmps::vectors(X),
                                     [&](double) { return [&](const V&) { return V(bad, 0, 0); }; });
    auto places = X, speeds = rest;
    region.prescribe(hmps::vectors(places), hmps::vectors(speeds), 0, 1e-5);
  });
}

void numbers(double bad, const std::vector<V>& X) {
  auto v = X;
  refuses("density", bad, [&] { hmps::kick(hmps::vectors(v), hmps::vectors(X), bad, 1e-5); });
  refuses("step of kick", bad, [&] { hmps::kick(hmps::vectors(v), hmps::vectors(X), 1e3, bad); });
  refuses("step of drift", bad, [&] { hmps::drift(hmps::vectors(v), hmps::vectors(X), bad); });
  refuses("densities", bad, [&] {
    std::vector<double> rho(X.size(), 1e3);
    rho[9] = bad;
    hmps::kick(hmps::vectors(v), hmps::vectors(X), hmps::scalars(rho), 1e-5);
  });
  refuses("spacing", bad, [&] { hmps::BondList<double, 3>(hmps::vectors(X), {.spacing = bad}); });
  refuses("radius", bad,
          [&] { hmps::LatticeBonds<double, 3>(hmps::vectors(X), {.spacing = 1e-3, .radius_ratio = bad}); });
  refuses("search radius", bad, [&] { (void)hmps::find_neighbours(hmps::vectors(X), bad); });
  refuses("keyframe", bad, [&] { hmps::Track{{0.0, bad}}; });
  refuses("time of a keyframe", bad, [&] { hmps::Track{{bad, 0.0}}; });
  refuses("artificial", bad, [&] { (void)hmps::artificial(bad); });
  refuses("viscosity", bad, [&] { (void)hmps::viscous(1e3, bad); });
  refuses("mean dilatation", bad, [&] { (void)hmps::mean_dilatation(bad); });
  refuses("Young's modulus", bad, [&] { (void)hmps::elastic(hmps::MooneyRivlin<>::from_young(bad, 1e6)); });
  refuses("D1", bad, [&] { (void)hmps::elastic(hmps::MooneyRivlin<>::from_young(2e4, bad)); });
  refuses("mu", bad, [&] { hmps::NeoHookean<>{bad, 1e6}.validate(); });
  refuses("bound of a law", bad, [&] { hmps::Continued{hmps::MooneyRivlin<>::from_young(2e4, 1e6), bad}.validate(); });
  refuses("sound speed", bad, [&] { (void)hmps::sound_speed(hmps::MooneyRivlin<>::from_young(2e4, 1e6), bad); });
  refuses("tube", bad, [&] { hmps::Tube<double, 3>({{V(0, 0, 0), bad}}); });
  refuses("box", bad, [&] {
    (void)hmps::fill_lattice(hmps::Ball<double, 3>{V::Zero(), 1}, hmps::Box<double, 3>{V(0, 0, 0), V(1, bad, 1)}, 0.5);
  });
  refuses("lattice spacing", bad, [&] {
    (void)hmps::fill_lattice(hmps::Ball<double, 3>{V::Zero(), 1}, hmps::Box<double, 3>{V(0, 0, 0), V(1, 1, 1)}, bad);
  });
  refuses("vertex", bad, [&] {
    hmps::SurfaceMesh<double> surface{{V(0, 0, 0), V(1, bad, 0), V(0, 1, 0), V(0, 0, 1)},
                                      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
    hmps::require_closed(surface);
  });
  refuses("cell of a table", bad, [&] { (void)hmps::parse_csv("t\n" + std::to_string(bad)); });
  const auto no_force = [](const auto&, const auto&, const auto&) {};
  const std::vector<V> rest(X.size(), V::Zero());
  const auto step = [&](const hmps::StableStepSettings& s) {
    (void)hmps::stable_step(no_force, hmps::vectors(X), hmps::vectors(rest), 1e3, s);
  };
  refuses("spacing of stable_step", bad, [&] { step({.spacing = bad}); });
  refuses("margin of stable_step", bad, [&] { step({.spacing = 1e-3, .margin = bad}); });
  refuses("tolerance of relax", bad, [&] {
    auto x = X, u = rest, f = rest;
    hmps::relax(no_force, hmps::vectors(x), hmps::vectors(u), hmps::vectors(f), 1e3,
                {.spacing = 1e-3, .tolerance = bad, .load = 1});
  });
  refuses("force of stable_step", bad, [&] {
    const auto force = [&](const auto&, const auto&, const auto& f) { f.set(2, V(bad, 0, 0)); };
    (void)hmps::stable_step(force, hmps::vectors(X), hmps::vectors(rest), 1e3, {.spacing = 1e-3});
  });
}

}  // namespace

int main() {
  std::vector<V> X;
  for (int i = 0; i < 64; ++i) X.push_back(V(i % 4, i / 4 % 4, i / 16) * 1e-3);
  for (const char* text : {"nan", "inf", "-inf"}) {
    const double bad = std::strtod(text, nullptr);
    state(bad, X);
    numbers(bad, X);
  }
  const double nan = std::strtod("nan", nullptr);
  refuses("shape", nan, [&] {
    (void)hmps::fill_lattice([&](const V&) { return nan; }, hmps::Box<double, 3>{V(0, 0, 0), V(1, 1, 1)}, 0.5);
  });
  refuses("shape to fit particles in", nan, [&] {
    (void)hmps::fit_particles([&](const V&) { return nan; }, hmps::Box<double, 3>{V(0, 0, 0), V(1, 1, 1)}, 0.5);
  });
  const hmps::Box<double, 3> box{V(0, 0, 0), V(1, 1, 1)};
  const hmps::Ball<double, 3> ball{V(0, 0, 0), 1}, none{V(0, 0, 0), -1};
  const hmps::Cylinder<double, 3> flat{V(0, 0, 0), V(0, 0, 0), 1};
  refuses("second of two united shapes", nan, [&] { (void)hmps::fill_lattice(hmps::unite(ball, none), box, 0.5); });
  refuses("subtracted shape", nan, [&] { (void)hmps::fill_lattice(hmps::subtract(ball, none), box, 0.5); });
  refuses("cylinder without a direction", nan, [&] { (void)hmps::fill_lattice(flat, box, 0.5); });
  refuses("time of a track", nan, [&] { (void)hmps::Track{{0.0, 1.0}}.value(nan); });
  return silent == 0 ? EXIT_SUCCESS : EXIT_FAILURE;
}
