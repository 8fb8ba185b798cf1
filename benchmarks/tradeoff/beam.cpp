// SPDX-License-Identifier: MIT
// A clamped beam, and a free bar, that vibrate in their first bending mode, without viscosity: how right is the
// frequency, how well is the energy kept?
#include <algorithm>
#include <cmath>
#include <hmps/hmps.hpp>
#include <limits>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "meter.hpp"
#include "scenes.hpp"
#include "timoshenko.hpp"

namespace tradeoff {
namespace {

constexpr double length = 0.5, height = 0.05, young = 1e5, density = 1000;  // m, m, Pa, kg/m3

SquareBeam beam_of(const Settings& settings) {
  const double bulk = young * settings.number("bulk modulus");
  return {.length = length, .height = height, .young = young, .poisson = 0.5 - young / (6 * bulk), .density = density};
}

/// The first mode of Euler and Bernoulli at distance x from the first end, 1 at the other.
double mode(double x, End end) {
  if (end == End::clamped) {
    const double s = 1.8751040687119611 * x / length;
    return (std::cosh(s) - std::cos(s) - 0.7340955137589128 * (std::sinh(s) - std::sin(s))) / 2;
  }
  const double s = 4.7300407448627040 * x / length;
  return (std::cosh(s) + std::cos(s) - 0.9825022145762380 * (std::sinh(s) + std::sin(s))) / 2;
}

/// Kernels in `K`, state in `S`.
template <class K, class S>
Outcome vibrate(const Settings& settings, End held) {
  Meter meter;
  using Vector = hmps::Vector<S, 3>;
  const SquareBeam solid = beam_of(settings);
  const double l0 = settings.number("spacing"), modulus = young * settings.number("E_hat");
  const double radius = settings.number("r_e"), volume = l0 * l0 * l0;

  // The clamp holds as many layers as bonds reach.
  const hmps::Vector<double, 3> end(length, height, height), half = hmps::Vector<double, 3>::Constant(l0 / 2);
  const double clamp = held == End::clamped ? std::ceil(radius) * l0 : 0;
  const hmps::Box<double, 3> box{hmps::Vector<double, 3>(-clamp, 0, 0), end};
  const auto lattice = hmps::fill_lattice(box, box, l0, half);
  const std::size_t n = lattice.size();
  std::vector<Vector> position(n), velocity(n), load(n), carry(n, Vector::Zero());
  std::vector<hmps::Matrix<S, 3>> gradient(n);
  std::vector<double> shape(n);
  const double expected = timoshenko_frequency(solid, held), amplitude = 0.005 * length;
  for (std::size_t i = 0; i < n; ++i) {
    shape[i] = lattice[i][0] > 0 ? mode(lattice[i][0], held) : 0;
    position[i] = lattice[i].cast<S>();
    velocity[i] = Vector(0, 0, static_cast<S>(2 * std::numbers::pi * expected * amplitude * shape[i]));
  }
  const auto reference = position;
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto c = hmps::vectors(carry);
  const auto F = hmps::matrices(gradient);

  const hmps::LatticeBonds<K, 3> bonds(x, {.spacing = l0, .radius_ratio = radius});
  const auto law = hmps::SaintVenantKirchhoff<>::from_young(young, solid.poisson);
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(modulus));
  const auto moves = [&](std::size_t i) { return lattice[i][0] > 0; };
  const double limit =
      hmps::stable_step(force, x, v, density, {.spacing = l0, .margin = 0, .tolerance = 1e-3, .moves = moves}).limit;
  const double dt = settings.number("step") * limit;

  const auto kick = [&](double time) {
    hmps::kick(v, f, density, time);
    for (std::size_t i = 0; i < n && !moves(i); ++i) velocity[i].setZero();  // the clamp comes first on the lattice
  };
  const auto drift = [&] {
    if constexpr (std::is_same_v<S, float>)
      hmps::drift(x, v, c, dt);
    else
      hmps::drift(x, v, dt);
  };
  const bool verlet = settings.word("integrator") == "velocity Verlet";
  const auto step = [&] {
    if (verlet) {  // f is that of x at the start, and again at the end
      kick(dt / 2);
      drift();
      force(x, f);
      kick(dt / 2);
    } else {
      force(x, f);
      kick(dt);
      drift();
    }
  };
  const auto energy = [&] {
    hmps::deformation_gradient(bonds, x, F);
    return hmps::kinetic_energy(v, density, volume) + hmps::strain_energy(F, law, volume) +
           hmps::artificial_energy(bonds, x, F, modulus, volume);
  };
  const auto deflection = [&] {  // the share of the mode
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i)
      sum += shape[i] * (static_cast<double>(position[i][2]) - static_cast<double>(reference[i][2]));
    return sum;
  };

  // Half a period: until the deflection passes zero.
  force(x, f);
  const double start = energy();
  double drifted = 0;
  const auto check = [&](double time) {
    drifted = std::max(drifted, std::abs(energy() / start - 1));
    if (!(drifted < 10) || time > 3 / expected)
      throw hmps::StateError(hmps::message("the beam broke down or does not swing back at ", rounded(time), " s"));
  };
  const int between = std::max(1, static_cast<int>(1 / (40 * expected * dt)));
  double before = 0;
  for (int steps = 1;; ++steps) {
    meter.start();
    step();
    meter.stop();
    meter.count(n);
    const double now = deflection();
    const bool back = before > 0 && !(now > 0);
    if (back || steps % between == 0) check(steps * dt);
    if (back) return meter.outcome({0.5 / ((steps - now / (now - before)) * dt), drifted});
    before = now;
  }
}

}  // namespace

namespace {

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
  return {.name = "",
          .title = "",
          .description = "",
          .quantities = {{.name = "the frequency", .unit = "Hz"}, {.name = "the energy", .scale = 1, .matters = 0.02}},
          .parameters = {{.name = "spacing",
                          .values = spacings,
                          .standard = scale.quick ? 0.0125 : 0.01,
                          .unit = "mm",
                          .per_unit = 1e-3,
                          .refines = true},
                         {.name = "E_hat", .values = moduli, .standard = 0.5, .unit = "E"},
                         {.name = "scalar", .values = {"double", "mixed", "float"}, .standard = "double"},
                         {.name = "step", .values = shares, .standard = 0.75},
                         {.name = "r_e", .values = {1.5, 1.75, 2.1, 2.5}, .standard = 1.75, .unit = "l0"},
                         {.name = "bulk modulus", .values = bulk, .standard = 1 / 1.2, .unit = "E", .choice = false},
                         {.name = "integrator",
                          .values = {"symplectic Euler", "velocity Verlet"},
                          .standard = "symplectic Euler"}},
          .crossed = crossed,
          .run = run,
          .known = known,
          .repeats = scale.quick ? 1 : 5};
}

const std::string body =
    " of 500 x 50 x 50 mm (E = 0.1 MPa, 1000 kg/m3) swings for half a period in its first bending mode, without "
    "viscosity, by 2.5 mm at its end. The frequency is compared with that of a Timoshenko beam of the same Poisson's "
    "ratio, the energy with what it was at the start: its largest deviation counts. The step is a share of the largest "
    "stable one; mixed means kernels in float and state in double.";

}  // namespace

Scene beam(const Scale& scale) {
  Scene scene = vibration(scale, End::clamped);
  scene.name = "beam";
  scene.title = "A clamped beam";
  scene.description = "A beam" + body +
                      " The clamp holds the layers of particles beyond x = 0, the next of which is half a spacing "
                      "behind; what this costs in accuracy is part of the error.";
  return scene;
}

Scene bar(const Scale& scale) {
  Scene scene = vibration(scale, End::free);
  scene.name = "bar";
  scene.title = "A free bar";
  scene.description = "The same without a clamp: a bar" + body;
  return scene;
}

}  // namespace tradeoff
