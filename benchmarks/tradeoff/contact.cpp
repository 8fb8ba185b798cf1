// SPDX-License-Identifier: MIT
// A block of soft tissue, pressed on a wall by a dead load and slid along it: how accurate is the friction, how even is
// the normal force? The wall is a lattice, parallel to the slide or turned, which should have no effect on the forces.
#include <cmath>
#include <hmps/hmps.hpp>
#include <numbers>
#include <type_traits>
#include <utility>
#include <vector>

#include "common/error.hpp"
#include "scenes/pressed_block.hpp"
#include "tradeoff/meter.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/tissue.hpp"

namespace tradeoff {
namespace contact_detail {
namespace {

constexpr double young = 20e3, density = 1000, viscosity = 5e-3;  // Pa, kg/m3, m2/s
constexpr double width = 12e-3, height = 8e-3, pressure = 1e3;    // m, m, Pa
constexpr double friction = 0.2, speed = 0.1;                     // -, m/s
constexpr double ramp = 5e-3, settled = 15e-3, until = 55e-3;     // s

struct Slide {
  double friction;  ///< mean tangential over mean normal force
  double ripple;    ///< rms of the normal force about the load, over the load
};

using Point = hmps::Vector<double, 3>;

/// The particles of the block, whose lower surface is half a spacing above the origin.
scenes::Fit block_of(double l0, bool fitted) {
  const hmps::Box<double, 3> box{Point(-width / 2, -width / 2, l0 / 2), Point(width / 2, width / 2, l0 / 2 + height)};
  if (fitted) return scenes::fit_turned(box, scenes::oblique(), l0);
  scenes::Fit block;
  block.positions = hmps::fill_lattice(box, box, l0, Point(box.lower + Point::Constant(l0 / 2)));
  return block;
}

/// Adds the wall below the block, so that they just touch: three layers of a lattice, or fitted ones. Its lattice, or
/// the samples of the fit, are turned by `angle` (rad) about its normal.
void add_wall(scenes::BlockOnWall& parts, double l0, double angle, bool fitted) {
  const double margin = 3 * l0, reach = width + speed * until;
  const auto below_the_slide = [&](const Point& place) {
    return std::abs(place[1]) <= width / 2 + margin && place[0] >= -width / 2 - margin &&
           place[0] <= width / 2 + speed * until + margin;
  };
  if (fitted) {
    const double beyond = width / 2 + 2 * margin;  // the layers run around the rim, which is left out
    const hmps::Box<double, 3> slab{Point(-beyond, -beyond, -2.5 * l0),
                                    Point(beyond + speed * until, beyond, 0.5 * l0)};
    const auto turn = Eigen::AngleAxisd(angle, Point::UnitZ()).toRotationMatrix();
    for (const Point& place : scenes::fit_turned(slab, turn, l0).positions)
      if (below_the_slide(place)) parts.add_to_wall(place, place[2] > -0.5 * l0);
    return;
  }
  const double c = std::cos(angle), s = std::sin(angle);
  const int cells = static_cast<int>(std::ceil(1.5 * reach / l0));
  for (int k = -2; k <= 0; ++k)
    for (int j = -cells; j <= cells; ++j)
      for (int i = -cells; i <= cells; ++i) {
        // Not aligned with the block's own lattice, as is usual for walls.
        const Point place = l0 * Point(c * i - s * j + 0.3, s * i + c * j + 0.2, k);
        if (below_the_slide(place)) parts.add_to_wall(place, k == 0);
      }
}

/// The block and the wall.
scenes::BlockOnWall parts_of(std::vector<Point> block, double l0, double angle, bool fitted) {
  scenes::BlockOnWall parts{.places = std::move(block)};
  parts.block = parts.places.size();
  for (std::size_t i = 0; i < parts.block; ++i) {
    const double z = parts.places[i][2] / l0, top = 0.5 + height / l0;
    if (z < 1.5) parts.bottom.push_back(static_cast<hmps::Index>(i));
    if (z < 2.5) parts.lower.push_back(static_cast<hmps::Index>(i));
    if (z > top - 1) parts.plate.push_back(static_cast<hmps::Index>(i));
  }
  add_wall(parts, l0, angle, fitted);
  return parts;
}

/// The terms of the block's force.
template <bool fitted>
auto terms_of(const scenes::Fit& block, const scenes::BlockSettings& settings) {
  if constexpr (fitted)
    return scenes::ThinWallTerms{scenes::stabiliser_of(block, settings.spacing, scenes::law_of(settings))};
  else
    return scenes::EvenTerms{};
}

/// Forces by `Bonds` in their scalar type, state in `S`.
template <class Bonds, class S, class Ball, class Friction>
Slide slide(const Settings& settings, double angle, Meter& meter) {
  const double l0 = settings.number("spacing"), ratio = settings.number("k~");
  const scenes::BlockSettings of{.spacing = l0,
                                 .density = density,
                                 .young = young,
                                 .d1 = settings.number("D1"),
                                 .modulus = young * settings.number("E_hat"),
                                 .viscosity = viscosity,
                                 .pressure = pressure,
                                 .area = width * width,
                                 .friction = friction,
                                 .ratio = ratio,
                                 .damping = settings.number("damping"),
                                 .margin = settings.number("margin")};
  constexpr bool fitted = std::is_same_v<Bonds, hmps::BondList<double, 3>>;
  scenes::Fit filling = block_of(l0, fitted);
  auto terms = terms_of<fitted>(filling, of);
  scenes::BlockOnWall parts = parts_of(std::move(filling.positions), l0, angle, fitted);
  std::vector<bool> held(parts.block, false);
  for (const hmps::Index i : parts.plate) held[i] = true;
  const auto moves = [&](std::size_t i) { return !held[i]; };
  const auto choose = [&](auto& force, const auto& x, const auto& v) {
    const double limit = hmps::stable_step(force, x, v, density, {.spacing = l0, .moves = moves}).step;
    return settings.number("step") * limit * std::sqrt(1 - ratio);
  };
  scenes::PressedBlock<Bonds, S, Ball, Friction, decltype(terms)> block(std::move(parts), of, choose, std::move(terms));
  const int cadence = static_cast<int>(settings.number("cadence"));
  double normal = 0, tangential = 0, squares = 0;
  int samples = 0;
  const int steps = static_cast<int>(std::ceil(until / block.dt));
  for (int step = 1; step <= steps; ++step) {
    const double t = step * block.dt, speed_now = speed * std::min(t / ramp, 1.);
    meter.start();
    block.force(block.block(block.x()), block.block(block.v()), block.block(block.f()));
    block.sink();
    block.kick(block.dt, speed_now);
    if (step % cadence == 0) {  // the whole impulse of `cadence` steps at once
      block.unload();
      block.touch(block.x(), cadence * block.dt);
      block.kick(cadence * block.dt, speed_now);
    }
    block.drift();
    meter.stop();
    meter.count(block.position.size());
    if (!(std::abs(block.sinking) < 10))
      throw hmps::StateError(examples::message("the block broke down at ", rounded(t), " s"));
    if (step % cadence != 0 || t < settled) continue;
    const auto on_wall = block.on_wall();
    normal -= on_wall[2];
    tangential += on_wall[0];
    squares += std::pow(-on_wall[2] / (pressure * width * width) - 1, 2);
    ++samples;
  }
  meter.hold();
  if (!(normal > 0)) throw hmps::StateError("the block is not on the wall any more");
  return {tangential / normal, std::sqrt(squares / samples)};
}

/// Both walls.
template <class Bonds, class S, class Ball, class Friction>
Outcome slides(const Settings& settings) {
  Meter meter;
  const Slide along = slide<Bonds, S, Ball, Friction>(settings, 0, meter);
  const Slide across = slide<Bonds, S, Ball, Friction>(settings, std::numbers::pi / 6, meter);
  const auto off = [](const Slide& one) { return std::abs(one.friction - friction); };
  return meter.outcome({off(along) > off(across) ? along.friction : across.friction,
                        std::max(along.ripple, across.ripple), along.friction, across.friction, along.ripple,
                        across.ripple});
}

/// Metaball, friction law, scalar and bonds are types, which are selected here. Scalars other than double and fitted
/// particles are available only with the default types, to limit the compile time.
Outcome press(const Settings& settings) {
  using hmps::CorrectedFriction, hmps::PaperFriction, hmps::PaperMetaball, hmps::SmoothMetaball;
  using Double = hmps::LatticeBonds<double, 3>;
  using Float = hmps::LatticeBonds<float, 3>;
  if (asks_for_fitted(settings, {{"kernel", "smooth"}, {"law", "corrected"}, {"scalar", "double"}, {"E_hat", 0.5}}))
    return slides<hmps::BondList<double, 3>, double, SmoothMetaball, CorrectedFriction>(settings);
  const std::string& scalar = settings.word("scalar");
  const bool smooth = settings.word("kernel") == "smooth", corrected = settings.word("law") == "corrected";
  if (scalar == "double") {
    if (smooth)
      return corrected ? slides<Double, double, SmoothMetaball, CorrectedFriction>(settings)
                       : slides<Double, double, SmoothMetaball, PaperFriction>(settings);
    return corrected ? slides<Double, double, PaperMetaball, CorrectedFriction>(settings)
                     : slides<Double, double, PaperMetaball, PaperFriction>(settings);
  }
  examples::require(smooth && corrected, "the scalar ", scalar,
                    " is compiled for the smooth kernel and the corrected law");
  return scalar == "float" ? slides<Float, float, SmoothMetaball, CorrectedFriction>(settings)
                           : slides<Float, double, SmoothMetaball, CorrectedFriction>(settings);
}

}  // namespace
}  // namespace contact_detail

Scene contact(const Scale& scale) {
  using namespace contact_detail;
  std::vector<Value> spacings{4e-3 / 2, 4e-3 / 3, 1e-3}, ratios{0.02, 0.05, 0.2};
  if (scale.quick) {
    spacings = {2e-3};
    ratios = {0.05};
  }
  return {
      .name = "contact",
      .title = "A block pressed on a wall and slid along it",
      .description =
          "A block of soft tissue of 12 x 12 x 8 mm (E = 20 kPa, 1000 kg/m3, viscosity 5e-3 m2/s) is pressed on a "
          "rigid wall by 1 kPa and slid along it over 4 mm at 0.1 m/s, with a friction coefficient of 0.2. The "
          "lattice of the wall (of a fitted one, the grid of samples) lies along the slide in one run and at 30 "
          "degrees to it in another; the worse of the two results counts. The slide is only two to four spacings "
          "long, so that climbing over the unevenness of a wall counts too. Friction is the mean tangential force "
          "over the mean normal force; the ripple is the root mean square deviation of the normal force from the "
          "load. The step is given as a share of the stable step without contact, and k~ is that at the standard "
          "cadence. At a cadence of m, contact acts in every m-th step only, with the impulse of m steps. The margin "
          "is that of the Verlet list.",
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
           {.name = "D1", .values = {1e5, 1e6}, .standard = 1e5, .unit = "MPa", .per_unit = 1e6, .choice = false},
           particles_parameter()},
      .crossed = {{"spacing", "kernel", "law", "k~"}, {"spacing", "particles"}},
      .run = press,
      .known = [](const Settings&) { return std::vector<double>{friction, 0, friction, friction, 0, 0}; },
      .repeats = scale.quick ? 1 : 5};
}

}  // namespace tradeoff
