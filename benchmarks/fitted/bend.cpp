// SPDX-License-Identifier: MIT
// A wide strip that is bent by large angles in plane strain (Rivlin's flexure), at any orientation.
#include <algorithm>
#include <array>
#include <cmath>

#include "fitted/scene.hpp"
#include "report/text.hpp"

namespace fitted {
namespace bend_detail {
namespace {

constexpr double wall = 4.8e-3;            // m
constexpr double free_length = 12 * wall;  // m; at half of it the ends still have an effect of 1 to 2 %
constexpr double spacings_held = 4, spacings_wide = 8;

/// Flexure of a strip in plane strain: the point at x along the strip and z across it, where z is -wall / 2 on the
/// inner side, moves to the radius r(z) and the angle `turn` x. Both faces are free. Computed by integration across the
/// wall.
class Flexure {
 public:
  /// `turn` is the angle in rad per m of the strip.
  Flexure(const hmps::MooneyRivlin<>& law, double turn) : law_(law), turn_(turn) {
    // The inner radius at which the outer face is free, by the secant method from that of an incompressible law.
    const double first = std::exp(-std::asinh(wall * turn) / 2) / turn;
    std::array<double, 2> inner{0.99 * first, 1.01 * first}, stress{integrate(inner[0]), integrate(inner[1])};
    for (int k = 0; k < 30 && std::abs(inner[1] - inner[0]) > 1e-13 * first; ++k) {
      const double next = inner[1] - stress[1] * (inner[1] - inner[0]) / (stress[1] - stress[0]);
      inner = {inner[1], next};
      stress = {stress[1], integrate(next)};
    }
  }

  /// The bending moment per width in N.
  [[nodiscard]] double moment() const { return moment_; }
  /// The strain energy per length and width in J/m2.
  [[nodiscard]] double energy() const { return energy_; }
  /// The position of a point of the bent strip, in m; the middle of the strip stays at the origin.
  [[nodiscard]] Vector operator()(const Vector& X) const {
    const double angle = turn_ * X[0], r = radius(X[2]);
    return {r * std::sin(angle), X[1], r * std::cos(angle) - radius(0)};
  }

 private:
  static constexpr int steps = 200;
  struct Section {
    double radius, stress, moment, energy;  // m, nominal radial stress in Pa, N, J/m2
    [[nodiscard]] Section moved(const Section& slope, double by) const {
      return {radius + by * slope.radius, stress + by * slope.stress, moment + by * slope.moment,
              energy + by * slope.energy};
    }
  };

  [[nodiscard]] static hmps::Matrix<double, 3> stretched(double radial, double around) {
    return Vector(around, 1, radial).asDiagonal();
  }

  /// Derivatives across the wall: equilibrium d(P_r)/dz = turn P_around, and the integrands of the moment and the
  /// energy.
  [[nodiscard]] Section slope(const Section& at) const {
    const double around = turn_ * at.radius;
    double radial = 1 / around;
    for (int k = 0; k < 20; ++k) {  // Newton: the radial stretch for the radial stress
      const double change = 1e-6;
      const double here = hmps::first_piola_kirchhoff(law_, stretched(radial, around))(2, 2);
      const double there = hmps::first_piola_kirchhoff(law_, stretched(radial + change, around))(2, 2);
      const double by = (at.stress - here) * change / (there - here);
      radial += by;
      if (std::abs(by) < 1e-13) break;
    }
    const hmps::Matrix<double, 3> F = stretched(radial, around);
    const double along = hmps::first_piola_kirchhoff(law_, F)(0, 0);
    return {radial, turn_ * along, along * at.radius, hmps::energy_density(law_, F)};
  }

  /// Integrates from the free inner face by a Runge-Kutta method. Returns the stress at the outer face.
  double integrate(double inner) {
    Section at{inner, 0, 0, 0};
    constexpr double dz = wall / steps;
    radii_[0] = inner;
    for (std::size_t k = 1; k <= steps; ++k) {
      const Section a = slope(at), b = slope(at.moved(a, dz / 2)), c = slope(at.moved(b, dz / 2)),
                    d = slope(at.moved(c, dz));
      at = at.moved(a, dz / 6).moved(b, dz / 3).moved(c, dz / 3).moved(d, dz / 6);
      radii_[k] = at.radius;
    }
    moment_ = at.moment;
    energy_ = at.energy;
    return at.stress;
  }

  [[nodiscard]] double radius(double z) const {
    const double place = std::clamp((z / wall + 0.5) * steps, 0.0, steps - 1e-9);
    const auto k = static_cast<std::size_t>(place);
    return radii_[k] + (place - static_cast<double>(k)) * (radii_[k + 1] - radii_[k]);
  }

  hmps::MooneyRivlin<> law_;
  double turn_, moment_ = 0, energy_ = 0;
  std::array<double, std::size_t{steps + 1}> radii_{};
};

[[nodiscard]] hmps::MooneyRivlin<> material() { return hmps::MooneyRivlin<>::from_young(100e3, 1e6); }

/// Whether the moment of `Flexure` is the derivative of its energy and, for a nearly incompressible law, that of
/// Rivlin.
[[nodiscard]] bool agrees_with_rivlin(double turn) {
  constexpr double change = 1e-4;
  const hmps::MooneyRivlin<> law = material();
  const double by_energy =
      (Flexure(law, turn * (1 + change)).energy() - Flexure(law, turn * (1 - change)).energy()) / (2 * change * turn);
  const double moment = Flexure(law, turn).moment();
  const double q = std::asinh(wall * turn);  // the logarithm of the outer radius over the inner one
  const double rivlin = law.shear_modulus() / (2 * turn * turn) * (std::sinh(2 * q) / 2 - q);
  hmps::MooneyRivlin<> stiff = law;
  stiff.d1 *= 1e3;
  return std::abs(by_energy / moment - 1) < 1e-6 && std::abs(Flexure(stiff, turn).moment() / rivlin - 1) < 1e-4;
}

/// The bending moment over the exact one, at `turn` rad per m. All particles start where the exact solution has them.
/// Those of one end stay there. Those of the other end move together without turning, so that no net force acts on
/// them. Those of the narrow sides stay in their planes. The moment is that of the forces on an end, which at rest is
/// the derivative of the energy by the angle between the ends.
[[nodiscard]] double bend(FittedBody& body, const Placement& at, double turn, double spacing) {
  const Flexure exact(material(), turn);
  const double width = spacings_wide * spacing;
  const Vector across = at.direction(Vector(0, 1, 0));
  std::vector<std::size_t> first, last, sides;
  for (std::size_t i = 0; i < body.moving(); ++i) {
    const Vector X = at.local(body.reference(i));
    body.place(i, at.moved + at.direction(exact(X)));
    if (X[0] < -free_length / 2) first.push_back(i);
    if (X[0] > free_length / 2) last.push_back(i);
    if (std::abs(X[1]) > width / 2 - spacing) sides.push_back(i);
  }
  body.settle_held(
      [&](const hmps::VectorView<double, 3>& f) {
        Vector mean = Vector::Zero();
        for (const std::size_t i : last) mean += f[i] / static_cast<double>(last.size());
        mean -= mean.dot(across) * across;
        for (const std::size_t i : sides) f.set(i, Vector(f[i] - f[i].dot(across) * across));
        for (const std::size_t i : first) f.set(i, Vector::Zero());
        for (const std::size_t i : last) f.set(i, mean);
      },
      12 * exact.moment() * width / wall, 3e-4);
  Vector middle = Vector::Zero(), torque = Vector::Zero();
  for (const std::size_t i : last) middle += body.position(i) / static_cast<double>(last.size());
  const std::vector<Vector>& forces = body.internal_forces();
  for (const std::size_t i : last) torque += std::pow(spacing, 3) * (body.position(i) - middle).cross(forces[i]);
  return -torque.dot(across) / (width * exact.moment());
}

/// The moments over the exact ones for `bends` (thickness over radius) of one strip.
[[nodiscard]] std::vector<double> moments_of(const Piece& strip, const Placement& at, Choice choice, int layers,
                                             const std::vector<double>& bends) {
  const double l0 = wall / layers;
  FittedBody body(l0, {strip}, choice, layers, material());
  std::vector<double> moments;
  for (const double ratio : bends) moments.push_back(bend(body, at, ratio / wall, l0));
  return moments;
}

[[nodiscard]] Vector half_of_strip(double l0) {
  return {free_length / 2 + spacings_held * l0, spacings_wide / 2 * l0, wall / 2};
}

[[nodiscard]] Piece fitted_strip(const Placement& at, double l0) {
  const Vector half = half_of_strip(l0), reach = at.turn.cwiseAbs() * half + Vector::Constant(2 * l0);
  return hmps::fit_particles(at.placed(hmps::Box<double, 3>{-half, half}), hmps::Box<double, 3>{-reach, reach}, l0);
}

/// A lattice along the strip.
[[nodiscard]] Piece lattice_strip(double l0) {
  const Vector half = half_of_strip(l0);
  const hmps::Box<double, 3> box{-half, half};
  Piece strip;
  strip.positions = hmps::fill_lattice(box, box, l0, Vector(Vector::Constant(l0 / 2) - half));
  return strip;
}

}  // namespace
}  // namespace bend_detail

report::Table bent_strip(bool quick) {
  using namespace bend_detail;
  using report::places;
  report::Table table{
      .name = "bend",
      .header = {"particles", "layers", "E_hat", "thickness / radius", "moment / exact", "range", "scatter"}};
  const std::vector<double> bends = quick ? std::vector<double>{0.25} : std::vector<double>{0.05, 0.25, 0.5};
  for (const double ratio : bends)
    table.check(agrees_with_rivlin(ratio / wall), "the exact moment at " + places(ratio, 2) + " is not Rivlin's");
  // `runs` are the moments of each placement.
  const auto add = [&](const char* particles, int layers, Choice choice, const std::vector<std::vector<double>>& runs) {
    for (std::size_t k = 0; k < bends.size(); ++k) {
      std::vector<double> moments;
      for (const auto& run : runs) moments.push_back(run[k]);
      const Spread moment = spread(moments);
      const bool once = runs.size() == 1;
      table.rows.push_back({particles, std::to_string(layers), name(choice), places(bends[k], 2),
                            places(moment.mean, 3),
                            once ? "" : places(moment.least, 3) + " to " + places(moment.most, 3),
                            once ? "" : places(100 * moment.scatter, 1) + " %"});
      if (choice != Choice::thin_wall) continue;
      const std::string which = std::to_string(layers) + " layers bent to " + places(bends[k], 2) + " ";
      table.check(std::abs(moment.mean - 1) < 0.05, which + "miss the exact moment by more than 5 %");
      table.check(moment.scatter < 0.02, which + "depend on how they lie");
    }
  };
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{2, 3, 4}) {
    const double l0 = wall / layers;
    if (!quick)
      for (const Choice choice : {Choice::waves, Choice::sheet})
        add("lattice", layers, choice, {moments_of(lattice_strip(l0), {}, choice, layers, bends)});
    for (const Choice choice : {Choice::waves, Choice::thin_wall}) {
      if (quick && choice == Choice::waves) continue;
      std::vector<std::vector<double>> runs;
      for (const Placement& at : any_placements(quick ? 1 : 3, l0))
        runs.push_back(moments_of(fitted_strip(at, l0), at, choice, layers, bends));
      add("fitted", layers, choice, runs);
    }
  }
  return table;
}

}  // namespace fitted
