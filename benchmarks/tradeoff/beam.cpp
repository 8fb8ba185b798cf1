// SPDX-License-Identifier: MIT
// A clamped beam and a free bar that vibrate in their first bending mode, without viscosity: how accurate is the
// frequency, how well is the energy conserved?
#include <algorithm>
#include <cmath>
#include <hmps/hmps.hpp>
#include <numbers>
#include <string>
#include <type_traits>
#include <vector>

#include "common/error.hpp"
#include "scenes/timoshenko.hpp"
#include "tradeoff/meter.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/tissue.hpp"

namespace tradeoff {
namespace beam_detail {
namespace {

using scenes::End, scenes::SquareBeam, scenes::timoshenko_frequency;

constexpr double length = 0.5, height = 0.05, young = 1e5, density = 1000;  // m, m, Pa, kg/m3

SquareBeam beam_of(const Settings& settings) {
  const double bulk = young * settings.number("bulk modulus");
  return {.length = length, .height = height, .young = young, .poisson = 0.5 - young / (6 * bulk), .density = density};
}

/// The first mode of an Euler-Bernoulli beam at distance x from the first end; 1 at the other end.
double mode(double x, End end) {
  return end == End::clamped ? scenes::clamped_mode(scenes::clamped_root * x / length)
                             : scenes::free_mode(scenes::free_root, scenes::free_root * x / length);
}

constexpr double standard_modulus = 0.5, standard_radius = 1.75;  // E_hat over E, r_e over the spacing

/// A beam that is held at one end, on a lattice by as many layers as bonds reach, or not at all.
Bar particles_of(const Settings& settings, End held, bool fitted) {
  const hmps::Vector<double, 3> size(length, height, height);
  const double l0 = settings.number("spacing");
  if (fitted) return scenes::fit_bar(size, l0, held == End::clamped);
  return bar_on_lattice(size, l0, held == End::clamped ? std::ceil(settings.number("r_e")) : 0);
}

/// A beam that vibrates, with forces in the scalar type `K` and state in `S`.
template <class K, class S, bool fitted>
class Vibration {
 public:
  Vibration(const Settings& settings, End held)
      : held_(held),
        l0_(settings.number("spacing")),
        verlet_(settings.word("integrator") == "velocity Verlet"),
        expected_(timoshenko_frequency(beam_of(settings), held)),
        bar_(particles_of(settings, held, fitted)),
        position_(size()),
        velocity_(size()),
        load_(size()),
        carry_(size(), Vector::Zero()),
        gradient_(size()),
        shape_(size()),
        reference_(start()),
        tissue_(bar_.fit, x_, hmps::SaintVenantKirchhoff<>::from_young_poisson(young, beam_of(settings).poisson),
                young * settings.number("E_hat"), {.spacing = l0_, .radius_ratio = settings.number("r_e")}) {
    const auto moves = [this](std::size_t i) { return this->moves(i); };
    dt_ = settings.number("step") * hmps::stable_step(tissue_.force(), x_, v_, density,
                                                      {.spacing = l0_, .margin = 0, .tolerance = 1e-3, .moves = moves})
                                        .limit;
  }

  /// Half a period: until the deflection passes zero.
  Outcome run() {
    tissue_.force()(x_, f_);
    const double start = energy();
    double drifted = 0, before = 0;
    const int between = std::max(1, static_cast<int>(1 / (40 * expected_ * dt_)));
    for (int steps = 1;; ++steps) {
      meter_.start();
      step();
      meter_.stop();
      meter_.count(size());
      const double now = deflection(), time = steps * dt_;
      const bool back = before > 0 && !(now > 0);
      if (back || steps % between == 0) {
        drifted = std::max(drifted, std::abs(energy() / start - 1));
        if (!(drifted < 10) || time > 3 / expected_)
          throw hmps::StateError(
              examples::message("the beam broke down, or had not swung back, at ", rounded(time), " s"));
      }
      if (back) return meter_.outcome({0.5 / ((steps - now / (now - before)) * dt_), drifted});
      before = now;
    }
  }

 private:
  using Vector = hmps::Vector<S, 3>;

  [[nodiscard]] std::size_t size() const { return bar_.fit.size(); }
  [[nodiscard]] const hmps::Vector<double, 3>& place(std::size_t i) const { return bar_.fit.positions[i]; }
  [[nodiscard]] bool moves(std::size_t i) const { return i >= bar_.held; }
  /// Puts the particles in their places and sets their velocities to the shape of the mode; returns the positions.
  std::vector<Vector> start() {
    const double amplitude = 0.005 * length;
    for (std::size_t i = 0; i < size(); ++i) {
      shape_[i] = moves(i) ? mode(place(i)[0], held_) : 0;
      position_[i] = place(i).template cast<S>();
      velocity_[i] = Vector(0, 0, static_cast<S>(2 * std::numbers::pi * expected_ * amplitude * shape_[i]));
    }
    return position_;
  }
  void kick(double time) {
    hmps::kick(v_, f_, density, time);
    for (std::size_t i = 0; i < bar_.held; ++i) velocity_[i].setZero();
  }
  void drift() {
    if constexpr (std::is_same_v<S, float>)
      hmps::drift(x_, v_, hmps::vectors(carry_), dt_);
    else
      hmps::drift(x_, v_, dt_);
  }
  void step() {
    if (verlet_) {  // f belongs to x at the start, and again at the end
      kick(dt_ / 2);
      drift();
      tissue_.force()(x_, f_);
      kick(dt_ / 2);
    } else {
      tissue_.force()(x_, f_);
      kick(dt_);
      drift();
    }
  }
  double energy() {
    return hmps::kinetic_energy(v_, density, tissue_.volume()) + tissue_.stored_energy(x_, hmps::matrices(gradient_));
  }
  /// The amplitude of the mode.
  [[nodiscard]] double deflection() const {
    double sum = 0;
    for (std::size_t i = 0; i < size(); ++i)
      sum +=
          tissue_.share(i) * shape_[i] * (static_cast<double>(position_[i][2]) - static_cast<double>(reference_[i][2]));
    return sum;
  }

  Meter meter_;  // first, so that it counts the other members
  End held_;
  double l0_;
  bool verlet_;
  double expected_, dt_ = 0;
  Bar bar_;
  std::vector<Vector> position_, velocity_, load_, carry_;
  std::vector<hmps::Matrix<S, 3>> gradient_;
  std::vector<double> shape_;
  std::vector<Vector> reference_;
  hmps::VectorView<S, 3> x_{hmps::vectors(position_)}, v_{hmps::vectors(velocity_)}, f_{hmps::vectors(load_)};
  Tissue<K, hmps::SaintVenantKirchhoff<>, fitted> tissue_;
};

template <class K, class S>
Outcome vibrate(const Settings& settings, End held) {
  const bool fitted = asks_for_fitted(settings, {{"E_hat", standard_modulus}, {"r_e", standard_radius}});
  return fitted ? Vibration<K, S, true>(settings, held).run() : Vibration<K, S, false>(settings, held).run();
}

Scene vibration(const Scale& scale, End held) {
  const auto run = [held](const Settings& settings) {
    const std::string& scalar = settings.word("scalar");
    if (scalar == "float") return vibrate<float, float>(settings, held);
    return scalar == "mixed" ? vibrate<float, double>(settings, held) : vibrate<double, double>(settings, held);
  };
  const auto known = [held](const Settings& settings) {
    return std::vector<double>{timoshenko_frequency(beam_of(settings), held), 0};
  };
  std::vector<Value> spacings{0.025, 0.05 / 3, 0.0125, 0.01, 0.00625, 0.005}, moduli{0., 0.1, 0.25, 0.5, 1.};
  std::vector<Value> shares{0.25, 0.5, 0.75, 0.95, 1.05}, bulk{1 / 1.2, 10., 33.};
  if (scale.quick) {
    spacings = {0.025, 0.05 / 3, 0.0125};
    moduli = {0.5, 1.};
    shares = {0.75, 0.95, 1.05};
    bulk = {1 / 1.2};
  }
  std::vector<std::string> crossed{"spacing", "E_hat"};
  if (!scale.quick) crossed.emplace_back("scalar");
  return {
      .name = "",
      .title = "",
      .description = "",
      .quantities = {{.name = "the frequency", .unit = "Hz"}, {.name = "the energy", .scale = 1, .matters = 0.02}},
      .parameters =
          {{.name = "spacing",
            .values = spacings,
            .standard = scale.quick ? 0.0125 : 0.01,
            .unit = "mm",
            .per_unit = 1e-3,
            .refines = true},
           {.name = "E_hat", .values = moduli, .standard = standard_modulus, .unit = "E"},
           {.name = "scalar", .values = {"double", "mixed", "float"}, .standard = "double"},
           {.name = "step", .values = shares, .standard = 0.75},
           {.name = "r_e", .values = {1.5, standard_radius, 2.1, 2.5}, .standard = standard_radius, .unit = "l0"},
           {.name = "bulk modulus", .values = bulk, .standard = 1 / 1.2, .unit = "E", .choice = false},
           {.name = "integrator", .values = {"symplectic Euler", "velocity Verlet"}, .standard = "symplectic Euler"},
           particles_parameter()},
      .crossed = {crossed, {"spacing", "particles"}},
      .run = run,
      .known = known,
      .repeats = scale.quick ? 1 : 5};
}

const std::string body =
    " of 500 x 50 x 50 mm (E = 0.1 MPa, 1000 kg/m3) swings for half a period in its first bending mode, without "
    "viscosity, with an amplitude of 2.5 mm at its end. The frequency is compared with that of a Timoshenko beam of "
    "the same Poisson's ratio, and the energy with its value at the start: its error is the largest deviation. The "
    "step is given as a share of the largest stable step; mixed means kernels in float and state in double.";

}  // namespace
}  // namespace beam_detail

Scene beam(const Scale& scale) {
  using namespace beam_detail;
  Scene scene = vibration(scale, End::clamped);
  scene.name = "beam";
  scene.title = "A clamped beam";
  scene.description =
      "A beam" + body +
      " The clamp holds the layers of particles behind x = 0, the nearest of which lies half a "
      "spacing behind it; what this costs in accuracy is part of the error. Fitted particles are held from the clamped "
      "face on, in which the outermost of them lie.";
  return scene;
}

Scene bar(const Scale& scale) {
  using namespace beam_detail;
  Scene scene = vibration(scale, End::free);
  scene.name = "bar";
  scene.title = "A free bar";
  scene.description = "The same without a clamp: a bar" + body;
  return scene;
}

}  // namespace tradeoff
