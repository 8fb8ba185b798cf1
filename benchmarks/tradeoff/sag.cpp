// SPDX-License-Identifier: MIT
// The shortest scene, from which to start one of your own: a bar of soft tissue, clamped at one end, sags under its
// weight.
#include <algorithm>
#include <cmath>
#include <hmps/hmps.hpp>
#include <limits>
#include <vector>

#include "tradeoff/meter.hpp"
#include "tradeoff/scenes.hpp"

namespace tradeoff {
namespace {

template <class K>  // the scalar of the kernels
Outcome sag_once(const Settings& settings) {
  Meter meter;
  using Vector = hmps::Vector<double, 3>;
  const double l0 = settings.number("spacing"), rho = 1000, young = 20e3, length = 0.06, height = 0.02;
  const hmps::Box<double, 3> bar{Vector(-2 * l0, 0, 0), Vector(length, height, height)};
  const auto reference = hmps::fill_lattice(bar, bar, l0, Vector::Constant(l0 / 2));
  auto position = reference, velocity = reference, load = reference;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto rest = [&] { std::fill(velocity.begin(), velocity.end(), Vector::Zero()); };
  const auto moves = [&](std::size_t i) { return reference[i][0] > 0; };
  rest();

  const hmps::LatticeBonds<K, 3> bonds(x, {.spacing = l0, .radius_ratio = settings.number("r_e")});
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(young, 1e6)),
                                    hmps::artificial(young * settings.number("E_hat")));
  const double dt = settings.number("step") * hmps::stable_step(force, x, v, rho, {.spacing = l0, .moves = moves}).step;

  // Kinetic damping: the bar is stopped whenever it slows down, until it sags no further.
  double before = 0, last = 0;
  for (int steps = 1;; ++steps) {
    meter.start();
    force(x, f);
    for (Vector& density : load) density[2] -= 9.81 * rho;
    hmps::kick(v, f, rho, dt);
    for (std::size_t i = 0; i < reference.size() && !moves(i); ++i) velocity[i].setZero();
    hmps::drift(x, v, dt);
    const double energy = hmps::kinetic_energy(v, rho, l0 * l0 * l0);
    meter.stop();
    meter.count(reference.size());
    if (!(energy < 1)) throw hmps::StateError("the bar broke down");
    if (energy >= before) {
      before = energy;
      continue;
    }
    rest();
    before = 0;
    // The position of the middle of the end, from the last two layers.
    double one = 0, two = 0, of_axis = 0;
    for (std::size_t i = 0; i < reference.size(); ++i) {
      const double layer = (length - reference[i][0]) / l0, fall = position[i][2] - reference[i][2];
      const bool axis = (reference[i].tail<2>().array() - height / 2).abs().maxCoeff() < 0.6 * l0;
      if (axis && layer < 1) one += fall, ++of_axis;
      if (axis && layer > 1 && layer < 2) two += fall;
    }
    const double end = (one + (one - two) / 2) / of_axis;
    if (std::abs(end - last) < 1e-4 * std::abs(end)) return meter.outcome({-end});
    last = end;
  }
}

}  // namespace

Scene sag(const Scale& scale) {
  std::vector<Value> spacings{0.005, 0.004, 0.02 / 6, 0.0025};
  if (scale.quick) spacings = {0.005, 0.004};
  return {
      .name = "sag",
      .title = "A bar that sags under its weight",
      .description =
          "A bar of 60 x 20 x 20 mm of the paper's soft tissue (C1 = C2 = 5/3 kPa, D1 = 1 MPa, 1000 kg/m3) is "
          "clamped at one end and comes to rest under gravity. The middle of its other end should then have sunk by "
          "23.4 mm, which finite elements give to within 0.1 mm. The step is given as a share of the largest stable "
          "step; mixed means kernels in float and state in double.",
      .quantities = {{.name = "the sag", .unit = "m"}},
      .parameters =
          {{.name = "spacing", .values = spacings, .standard = 0.004, .unit = "mm", .per_unit = 1e-3, .refines = true},
           {.name = "E_hat", .values = {0.1, 0.25, 0.5, 1.}, .standard = 0.5, .unit = "E"},
           {.name = "r_e", .values = {1.5, 1.75, 2.1}, .standard = 1.75, .unit = "l0"},
           {.name = "scalar", .values = {"double", "mixed"}, .standard = "double"},
           {.name = "step", .values = {0.5, 0.75}, .standard = 0.75}},
      .crossed = {{"spacing", "E_hat"}},
      .run = [](const Settings& s) { return s.word("scalar") == "mixed" ? sag_once<float>(s) : sag_once<double>(s); },
      .known = [](const Settings&) { return std::vector<double>{0.0234}; },
      .repeats = scale.quick ? 1 : 5};
}

}  // namespace tradeoff
