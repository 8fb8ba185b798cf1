// SPDX-License-Identifier: MIT
// A block of soft tissue, pressed on a wall by a dead load and slid along it: how right is the friction, how even the
// normal force? The wall is a lattice, parallel to the slide or turned to it, and should not be felt as one.
#include <cmath>
#include <functional>
#include <hmps/hmps.hpp>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "meter.hpp"
#include "scenes.hpp"

namespace tradeoff {
namespace {

constexpr double young = 20e3, density = 1000, viscosity = 5e-3;  // Pa, kg/m3, m2/s
constexpr double width = 12e-3, height = 8e-3, pressure = 1e3;    // m, m, Pa
constexpr double friction = 0.2, speed = 0.1;                     // -, m/s
constexpr double ramp = 5e-3, settled = 15e-3, until = 55e-3;     // s

struct Slide {
  double friction;  ///< mean tangential over mean normal force
  double ripple;    ///< rms of the normal force about the load, over the load
};

/// Kernels in `K`, state in `S`; the wall's lattice turned by `angle` (rad) about its normal.
template <class K, class S, class Ball, class Friction>
Slide slide(const Settings& settings, double angle, Meter& meter) {
  using Point = hmps::Vector<double, 3>;
  const double l0 = settings.number("spacing"), volume = l0 * l0 * l0;

  // The block first, its lowest layer where it just touches, then the wall.
  const Point half = Point::Constant(l0 / 2);
  const hmps::Box<double, 3> box{Point(-width / 2, -width / 2, l0 / 2), Point(width / 2, width / 2, l0 / 2 + height)};
  std::vector<Point> places = hmps::fill_lattice(box, box, l0, box.lower + half);
  const std::size_t n = places.size();
  const double c = std::cos(angle), s = std::sin(angle), margin = 3 * l0, reach = width + speed * until;
  const int cells = static_cast<int>(std::ceil(1.5 * reach / l0));
  std::vector<hmps::Index> bottom, lower, plate, skin, wall;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = places[i][2] / l0, top = box.upper[2] / l0;
    if (z < 1.5) bottom.push_back(static_cast<hmps::Index>(i));
    if (z < 2.5) lower.push_back(static_cast<hmps::Index>(i));
    if (z > top - 1) plate.push_back(static_cast<hmps::Index>(i));
  }
  for (int k = -2; k <= 0; ++k)
    for (int j = -cells; j <= cells; ++j)
      for (int i = -cells; i <= cells; ++i) {
        // Off the block's own lattice, as walls are.
        const Point place = l0 * Point(c * i - s * j + 0.3, s * i + c * j + 0.2, k);
        if (std::abs(place[1]) > width / 2 + margin || place[0] < -width / 2 - margin ||
            place[0] > width / 2 + speed * until + margin)
          continue;
        wall.push_back(static_cast<hmps::Index>(places.size()));
        if (k == 0) skin.push_back(wall.back());
        places.push_back(place);
      }

  std::vector<hmps::Vector<S, 3>> position, velocity(places.size(), hmps::Vector<S, 3>::Zero());
  for (const Point& place : places) position.push_back(place.cast<S>());
  auto load = velocity, carry = velocity;
  std::vector<hmps::Matrix<K, 3>> gradient(places.size(), hmps::Matrix<K, 3>::Identity());
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto F = hmps::matrices(gradient);
  const auto block = [n](const auto& view) { return view.part(0, n); };

  const hmps::LatticeBonds<K, 3> bonds(block(x), {.spacing = l0});
  auto force = hmps::internal_force(
      bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(young, settings.number("D1"))),
      hmps::artificial(young * settings.number("E_hat")), hmps::viscous(density, viscosity), hmps::record(block(F)));
  const double ratio = settings.number("k~");
  std::vector<bool> held(n, false);
  for (const hmps::Index i : plate) held[i] = true;
  const double limit = hmps::stable_step(force, block(x), block(v), density,
                                         {.spacing = l0, .moves = [&](std::size_t i) { return !held[i]; }})
                           .step;
  const double dt = settings.number("step") * limit * std::sqrt(1 - ratio);

  hmps::MetaballContact<K, 3, Ball, Friction> contact(
      {.spacing = l0,
       .density = density,
       .friction = friction,
       .stiffness = hmps::PenaltyStiffness::fixed(ratio * density / (dt * dt)),
       .damping = settings.number("damping"),
       .margin = settings.number("margin")});
  const auto below = contact.add_organ({"wall", skin, wall, [](hmps::Index) { return true; }});
  const auto above = contact.add_organ({"block", bottom, lower});
  const auto pair = contact.add_pair(below, above);

  // The plate on top slides as prescribed and sinks as the load and the block let it.
  const double area = width * width, mass = static_cast<double>(plate.size()) * volume * density;
  double sinking = 0;
  const auto drive = [&](double t) {
    const hmps::Vector<S, 3> velocity_of_plate(static_cast<S>(speed * std::min(t / ramp, 1.)), S(0),
                                               static_cast<S>(sinking));
    for (const hmps::Index i : plate) velocity[i] = velocity_of_plate;
  };
  const int cadence = static_cast<int>(settings.number("cadence"));
  double normal = 0, tangential = 0, squares = 0;
  int samples = 0;
  const int steps = static_cast<int>(std::ceil(until / dt));
  for (int step = 1; step <= steps; ++step) {
    const double t = step * dt;
    meter.start();
    force(block(x), block(v), block(f));
    double lift = -pressure * area;
    for (const hmps::Index i : plate) lift += static_cast<double>(load[i][2]) * volume;
    sinking += dt * lift / mass;
    hmps::kick(block(v), block(f), density, dt);
    drive(t);
    if (step % cadence == 0) {  // all the impulse of `cadence` steps at once
      std::fill(load.begin(), load.end(), hmps::Vector<S, 3>::Zero());
      contact(x, v, F, cadence * dt, f);
      hmps::kick(block(v), block(f), density, cadence * dt);
      drive(t);
    }
    if constexpr (std::is_same_v<S, float>)
      hmps::drift(block(x), block(v), block(hmps::vectors(carry)), dt);
    else
      hmps::drift(block(x), block(v), dt);
    meter.stop();
    meter.count(places.size());
    if (!(std::abs(sinking) < 10)) throw hmps::StateError(hmps::message("the block broke down at ", rounded(t), " s"));
    if (step % cadence != 0 || t < settled) continue;
    const hmps::Vector<double, 3> on_wall = contact.force_on_first(pair);
    normal -= on_wall[2];
    tangential += on_wall[0];
    squares += std::pow(-on_wall[2] / (pressure * area) - 1, 2);
    ++samples;
  }
  meter.hold();
  if (!(normal > 0)) throw hmps::StateError("the block is not on the wall any more");
  return {tangential / normal, std::sqrt(squares / samples)};
}

/// Both walls.
template <class K, class S, class Ball, class Friction>
Outcome slides(const Settings& settings) {
  Meter meter;
  const Slide along = slide<K, S, Ball, Friction>(settings, 0, meter);
  const Slide across = slide<K, S, Ball, Friction>(settings, std::numbers::pi / 6, meter);
  const auto off = [](const Slide& one) { return std::abs(one.friction - friction); };
  return meter.outcome({off(along) > off(across) ? along.friction : across.friction,
                        std::max(along.ripple, across.ripple), along.friction, across.friction, along.ripple,
                        across.ripple});
}

/// Kernel, law and scalar are types: which of them is settled here. The scalars other than double are there for the
/// default types only, so that this compiles in bearable time.
Outcome press(const Settings& settings) {
  using hmps::CorrectedFriction, hmps::PaperFriction, hmps::PaperMetaball, hmps::SmoothMetaball;
  const std::string& scalar = settings.word("scalar");
  const bool smooth = settings.word("kernel") == "smooth", corrected = settings.word("law") == "corrected";
  if (scalar == "double") {
    if (smooth)
      return corrected ? slides<double, double, SmoothMetaball, CorrectedFriction>(settings)
                       : slides<double, double, SmoothMetaball, PaperFriction>(settings);
    return corrected ? slides<double, double, PaperMetaball, CorrectedFriction>(settings)
                     : slides<double, double, PaperMetaball, PaperFriction>(settings);
  }
  hmps::require(smooth && corrected, "the scalar ", scalar, " is compiled for the smooth kernel and the corrected law");
  return scalar == "float" ? slides<float, float, SmoothMetaball, CorrectedFriction>(settings)
                           : slides<float, double, SmoothMetaball, CorrectedFriction>(settings);
}

}  // namespace

Scene contact(const Scale& scale) {
  std::vector<Value> spacings{4e-3 / 2, 4e-3 / 3, 1e-3}, ratios{0.02, 0.05, 0.2};
  if (scale.quick) {
    spacings = {2e-3};
    ratios = {0.05};
  }
  return {
      .name = "contact",
      .title = "A block pressed on a wall and slid along it",
      .description =
          "A block of soft tissue of 12 x 12 x 8 mm (E = 20 kPa, 1000 kg/m3, viscosity 5e-3 m2/s) is pressed by 1 kPa "
          "and slid at 0.1 m/s over 4 mm of a rigid wall with the friction coefficient 0.2. The wall's lattice lies "
          "along the slide, then at 30 degrees to it, and the worse of the two counts. Friction is the mean tangential "
          "over the mean normal force; the ripple is the root mean square of the normal force about the load. The "
          "step is a share of what is stable without contact, k~ that of the standard cadence; at a cadence of m the "
          "contact acts on each m-th step only, with the impulse of all. The margin is how far particles move before "
          "the lists of candidates are rebuilt.",
      .quantities = {{.name = "friction"},
                     {.name = "the ripple of the normal force", .scale = 1},
                     {.name = "friction at 0 degrees", .headline = false},
                     {.name = "friction at 30 degrees", .headline = false},
                     {.name = "ripple at 0 degrees", .scale = 1, .headline = false},
                     {.name = "ripple at 30 degrees", .scale = 1, .headline = false}},
      .parameters =
          {{.name = "spacing", .values = spacings, .standard = 2e-3, .unit = "mm", .per_unit = 1e-3, .refines = true},
           {.name = "kernel", .values = {"smooth", "paper"}, .standard = "smooth"},
           {.name = "law", .values = {"corrected", "paper"}, .standard = "corrected"},
           {.name = "k~", .values = ratios, .standard = 0.05},
           {.name = "cadence", .values = {1., 2., 4.}, .standard = 1.},
           {.name = "damping", .values = {0., 0.1, 0.5}, .standard = 0., .unit = "of critical"},
           {.name = "margin", .values = {0.25, 0.5, 1.}, .standard = 0.5, .unit = "l0"},
           {.name = "step", .values = {0.3, 0.6, 0.9}, .standard = 0.6},
           {.name = "scalar", .values = {"double", "mixed", "float"}, .standard = "double"},
           {.name = "E_hat", .values = {0.25, 0.5, 1.}, .standard = 0.5, .unit = "E"},
           {.name = "D1", .values = {1e5, 1e6}, .standard = 1e5, .unit = "MPa", .per_unit = 1e6, .choice = false}},
      .crossed = {"spacing", "kernel", "law", "k~"},
      .run = press,
      .known = [](const Settings&) { return std::vector<double>{friction, 0, friction, friction, 0, 0}; },
      .repeats = scale.quick ? 1 : 5};
}

}  // namespace tradeoff
