// SPDX-License-Identifier: MIT
// The shortest scene, from which to start one of your own: a bar of soft tissue, clamped at one end, sags under its
// weight.
#include <cmath>
#include <hmps/hmps.hpp>
#include <vector>

#include "scenes/plane_fit.hpp"
#include "tradeoff/meter.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/tissue.hpp"

namespace tradeoff {
namespace sag_detail {
namespace {

using Vector = hmps::Vector<double, 3>;
constexpr double length = 0.06, height = 0.02, rho = 1000, young = 20e3;  // m, m, kg/m3, Pa

/// How far the middle of the end has fallen, from the particles within two spacings of the end and `reach` spacings of
/// the axis.
double fall_of_end(const std::vector<Vector>& from, const std::vector<Vector>& to, double l0, double reach) {
  scenes::PlaneFit plane;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Vector X = (from[i] - Vector(length, height / 2, height / 2)) / l0;
    if (X[0] > -2 && X.tail<2>().cwiseAbs().maxCoeff() < reach) plane.add(X, from[i][2] - to[i][2]);
  }
  return plane.at_point();
}

template <class K, bool fitted>  // the scalar of the kernels
Outcome sag_once(const Settings& settings) {
  Meter meter;
  const double l0 = settings.number("spacing");
  Bar bar =
      fitted ? scenes::fit_bar({length, height, height}, l0, true) : bar_on_lattice({length, height, height}, l0, 2);
  const std::vector<Vector>& reference = bar.fit.positions;
  auto position = reference, velocity = reference, load = reference;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto rest = [&] { hmps::set_zero(v); };
  const auto moves = [&](std::size_t i) { return i >= bar.held; };
  rest();

  Tissue<K, hmps::MooneyRivlin<>, fitted> tissue(bar.fit, x, hmps::MooneyRivlin<>::from_young(young, 1e6),
                                                 young * settings.number("E_hat"),
                                                 {.spacing = l0, .radius_ratio = settings.number("r_e")});
  auto& force = tissue.force();
  const double dt = settings.number("step") * hmps::stable_step(force, x, v, rho, {.spacing = l0, .moves = moves}).step;

  // Kinetic damping: the bar is stopped whenever it slows down, until it sags no further.
  double before = 0, last = 0;
  for (int steps = 1;; ++steps) {
    meter.start();
    force(x, f);
    for (Vector& density : load) density[2] -= 9.81 * rho;
    hmps::kick(v, f, rho, dt);
    for (std::size_t i = 0; i < bar.held; ++i) velocity[i].setZero();
    hmps::drift(x, v, dt);
    const double energy = hmps::kinetic_energy(v, rho, tissue.volume());
    meter.stop();
    meter.count(reference.size());
    if (!(energy < 1)) throw hmps::StateError("the bar broke down");
    if (energy >= before) {
      before = energy;
      continue;
    }
    rest();
    before = 0;
    const double end = fall_of_end(reference, position, l0, fitted ? 1.5 : 0.6);
    if (std::abs(end - last) < 1e-4 * std::abs(end)) return meter.outcome({end});
    last = end;
  }
}

Outcome sag_in(const Settings& s) {
  const bool mixed = s.word("scalar") == "mixed";
  if (asks_for_fitted(s, {{"E_hat", 0.5}, {"r_e", 1.75}}))
    return mixed ? sag_once<float, true>(s) : sag_once<double, true>(s);
  return mixed ? sag_once<float, false>(s) : sag_once<double, false>(s);
}

}  // namespace
}  // namespace sag_detail

Scene sag(const Scale& scale) {
  std::vector<Value> spacings{0.005, 0.004, 0.02 / 6, 0.0025};
  if (scale.quick) spacings = {0.005, 0.004};
  return {
      .name = "sag",
      .title = "A bar that sags under its weight",
      .description =
          "A bar of 60 x 20 x 20 mm of the paper's soft tissue (C1 = C2 = 5/3 kPa, D1 = 1 MPa, 1000 kg/m3) is "
          "clamped at one end and comes to rest under gravity. The middle of its other end should then have sunk by "
          "23.4 mm, which finite elements give to within 0.1 mm. On a lattice the two layers behind the clamped face "
          "are held; of fitted particles, those from the face on, in which the outermost of them lie. The step is "
          "given as a share of the largest stable step; mixed means kernels in float and state in double.",
      .quantities = {{.name = "the sag", .unit = "m"}},
      .parameters =
          {{.name = "spacing", .values = spacings, .standard = 0.004, .unit = "mm", .per_unit = 1e-3, .refines = true},
           {.name = "E_hat", .values = {0.1, 0.25, 0.5, 1.}, .standard = 0.5, .unit = "E"},
           {.name = "r_e", .values = {1.5, 1.75, 2.1}, .standard = 1.75, .unit = "l0"},
           {.name = "scalar", .values = {"double", "mixed"}, .standard = "double"},
           {.name = "step", .values = {0.5, 0.75}, .standard = 0.75},
           particles_parameter()},
      .crossed = {{"spacing", "E_hat"}, {"spacing", "particles"}},
      .run = sag_detail::sag_in,
      .known = [](const Settings&) { return std::vector<double>{0.0234}; },
      .repeats = scale.quick ? 1 : 5};
}

}  // namespace tradeoff
