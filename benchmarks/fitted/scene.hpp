// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <hmps/hmps.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "report/table.hpp"
#include "scenes/body.hpp"

/// Bodies of fitted particles that lie in any direction.
namespace fitted {

using Vector = hmps::Vector<double, 3>;
using Piece = hmps::FittedParticles<double, 3>;

/// Where a body lies: turned about the origin, then moved.
struct Placement {
  hmps::Matrix<double, 3> turn = hmps::Matrix<double, 3>::Identity();
  Vector moved = Vector::Zero();

  [[nodiscard]] Vector local(const Vector& x) const { return turn.transpose() * (x - moved); }
  [[nodiscard]] Vector direction(const Vector& of_body) const { return turn * of_body; }
  /// A shape of the body where it lies.
  template <class Shape>
  [[nodiscard]] auto placed(Shape shape) const {
    return hmps::translated(hmps::rotated(std::move(shape), turn), moved);
  }
};

/// Turned by `degrees` about y and moved by `by` (m).
[[nodiscard]] Placement tilted(double degrees, const Vector& by);
/// `count` placements, turned about any axis by any angle and moved by up to a spacing (m) along each; always the same.
[[nodiscard]] std::vector<Placement> any_placements(int count, double spacing);

/// Fits the part of `shape` within `around` (m), both of the body where it lies unturned. The box that is sampled turns
/// with neither of them, and does not move with the body, which is moved by up to a spacing (m).
template <class Shape>
[[nodiscard]] Piece fit_where_it_lies(const Placement& at, Shape shape, const hmps::Box<double, 3>& around,
                                      double spacing) {
  const Vector middle = at.turn * (around.lower + around.upper) / 2;
  const Vector reach =
      at.turn.cwiseAbs() * (around.upper - around.lower) / 2 + Vector::Constant(2 * spacing) + at.moved.cwiseAbs();
  const auto part = hmps::intersect(std::move(shape), around);
  return hmps::fit_particles(at.placed(part), hmps::Box<double, 3>{middle - reach, middle + reach}, spacing);
}

/// A load in proportion to a pattern.
struct PatternLoad {
  std::function<Vector(const Vector&)> pattern;  ///< of the place in the body where it lies unturned
  double size;                                   ///< N/m3 where the pattern is 1
  /// Of a free body: its mean and its moment, which an uneven cloud has, are taken from the pattern.
  bool of_free_body = false;
};

/// How a body is stabilised.
enum class Choice {
  waves,      // E_hat = 4/3 mu
  sheet,      // sheet_stabiliser
  thin_wall,  // thin_wall_stabiliser
};
[[nodiscard]] std::string name(Choice choice);

/// A body of pieces, the first of which moves while the others are held.
class FittedBody {
 public:
  /// `layers`: what `sheet_stabiliser` is told. Each particle stands for its own volume if `own_volumes`, else for the
  /// cube of the spacing.
  FittedBody(double spacing, const std::vector<Piece>& pieces, Choice choice, int layers,
             const hmps::MooneyRivlin<>& law, bool own_volumes = false);

  [[nodiscard]] std::size_t moving() const { return moving_; }
  [[nodiscard]] const Vector& reference(std::size_t i) const { return body_.reference[i]; }
  [[nodiscard]] Vector displacement(std::size_t i) const { return body_.displacement(i); }
  [[nodiscard]] const Vector& position(std::size_t i) const { return body_.position[i]; }
  void place(std::size_t i, const Vector& x) { body_.position[i] = x; }

  /// Brings the body to rest under `load(i)` (N/m3) until the unbalanced forces are `tolerance` times `total` (N).
  void settle(const std::function<Vector(std::size_t)>& load, double total, double tolerance = 2e-3);
  /// Brings the body to rest from where its particles are, all of which move; `hold` takes from the forces (N/m3) what
  /// the particles may not follow. Ends as `settle` does.
  void settle_held(const std::function<void(const hmps::VectorView<double, 3>&)>& hold, double total, double tolerance);
  /// Moves the particles from the reference configuration as a linear body would under `load(i)` (N/m3), by conjugate
  /// gradients; many times faster than `settle`, and what finite elements for small strains compute. Ends as `settle`.
  void yield_linearly(const std::function<Vector(std::size_t)>& load, double total, double tolerance);
  /// How far the body gives way to a small load, in mm: the A of the displacement A `pattern` that fits best. It is
  /// what the load works, but for a factor. A particle carries its share of the load by its volume in `volumes` (m3),
  /// which counts the moving ones; all the same if empty.
  [[nodiscard]] double gives_way(const Placement& at, const PatternLoad& load, const std::vector<double>& volumes = {});
  /// The internal forces in N/m3 at rest where the particles are.
  [[nodiscard]] const std::vector<Vector>& internal_forces();
  /// The frequency in Hz of a small vibration without viscosity, started from the reference configuration with the
  /// velocities `shape` (m/s) of the particles that move: over the period from the first to the third time at which the
  /// displacement along `shape` passes zero.
  [[nodiscard]] double frequency(const std::vector<Vector>& shape, double density);

 private:
  std::size_t moving_;
  scenes::Body<3> body_;
  std::vector<double> moduli_;  // E_hat of each particle
  std::unique_ptr<hmps::BondList<double, 3>> bonds_;
  hmps::ForceFunction<double, 3> internal_;
};

/// What runs in several placements gave.
struct Spread {
  double mean, scatter, least, most;  ///< the scatter is the standard deviation over the mean
};
[[nodiscard]] Spread spread(const std::vector<double>& values);
/// A share as a percentage with a sign.
[[nodiscard]] std::string percent(double share);

/// What a table compares of one body with the answer of finite elements.
struct Comparison {
  std::string name, of, measured;  ///< of the table, of the body in words, and what is measured
  double answer;
  int digits;
  std::vector<int> layers;
  std::vector<int> placements;                           ///< of each number of layers
  std::function<double(const Placement&, int)> measure;  ///< with a number of layers
  std::function<double(int)> spacing;                    ///< with a number of layers, m
  /// Of the error: 6 % with two layers, 3 % with more.
  std::function<double(int)> bound = [](int count) { return count < 3 ? 0.06 : 0.03; };
};
/// Runs a comparison; `quick` leaves its first number of layers in one placement.
[[nodiscard]] report::Table compared(const Comparison& with, bool quick);

/// The tables of the page; `quick` leaves a small part.
[[nodiscard]] report::Table plate_about_one_axis(const std::vector<double>& spacings, bool quick);  ///< plate.cpp
[[nodiscard]] report::Table plate_about_any_axis(const std::vector<double>& spacings, bool quick);
[[nodiscard]] report::Table twisted_bar(bool quick);    ///< bar.cpp
[[nodiscard]] report::Table pinched_ring(bool quick);   ///< ring.cpp
[[nodiscard]] report::Table bent_strip(bool quick);     ///< bend.cpp
[[nodiscard]] report::Table half_cylinder(bool quick);  ///< shells.cpp
[[nodiscard]] report::Table half_ball(bool quick);
[[nodiscard]] report::Table twisted_strip(bool quick, bool own_volumes);  ///< clamped.cpp
[[nodiscard]] report::Table wedge(bool quick);
[[nodiscard]] report::Table junction(bool quick);
[[nodiscard]] report::Table leaf(bool quick);  ///< leaf.cpp

}  // namespace fitted
