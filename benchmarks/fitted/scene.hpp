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
#include "scenes/fitted_body.hpp"

/// Bodies of fitted particles at any orientation.
namespace fitted {

using Vector = hmps::Vector<double, 3>;
using Piece = scenes::Fit;

/// The placement of a body: turned about the origin, then moved.
struct Placement {
  hmps::Matrix<double, 3> turn = hmps::Matrix<double, 3>::Identity();
  Vector moved = Vector::Zero();

  [[nodiscard]] Vector local(const Vector& x) const { return turn.transpose() * (x - moved); }
  [[nodiscard]] Vector direction(const Vector& of_body) const { return turn * of_body; }
  /// A shape of the unturned body, moved to its placement.
  template <class Shape>
  [[nodiscard]] auto placed(Shape shape) const {
    return hmps::translated(hmps::rotated(std::move(shape), turn), moved);
  }
};

/// Turned by `degrees` about y and moved by `by` (m).
[[nodiscard]] Placement tilted(double degrees, const Vector& by);
/// `count` placements, turned about any axis by any angle and moved by up to a spacing (m) along each; always the same.
[[nodiscard]] std::vector<Placement> any_placements(int count, double spacing);

/// Fits the part of `shape` within the box `around` (m), both given for the unturned body. The box that is sampled does
/// not turn with them, and does not move with the body, which is moved by up to a spacing (m).
template <class Shape>
[[nodiscard]] Piece fit_where_it_lies(const Placement& at, Shape shape, const hmps::Box<double, 3>& around,
                                      double spacing) {
  const Vector middle = at.turn * (around.lower + around.upper) / 2;
  const Vector reach =
      at.turn.cwiseAbs() * (around.upper - around.lower) / 2 + Vector::Constant(2 * spacing) + at.moved.cwiseAbs();
  const auto part = hmps::intersect(std::move(shape), around);
  return hmps::fit_particles(at.placed(part), hmps::Box<double, 3>{middle - reach, middle + reach}, spacing);
}

/// A load that is proportional to a pattern.
struct PatternLoad {
  std::function<Vector(const Vector&)> pattern;  ///< as a function of the place in the unturned body
  double size;                                   ///< N/m3 for a pattern of 1
  /// For a free body: the mean and the moment, which are not zero on an uneven cloud, are subtracted from the pattern.
  bool of_free_body = false;
};

/// How a body is stabilised.
enum class Choice {
  waves,      // E_hat = 4/3 mu
  sheet,      // sheet_stabiliser
  thin_wall,  // thin_wall_stabiliser
  edges,      // thin_wall_stabiliser and edge_stabiliser
  bar,        // bar_stabiliser
};
[[nodiscard]] std::string name(Choice choice);

/// A body of pieces: the first one moves, the others are held.
class FittedBody {
 public:
  /// `layers` is passed to `sheet_stabiliser`. Each particle stands for its own volume if `own_volumes`, otherwise for
  /// the cube of the spacing.
  FittedBody(double spacing, const std::vector<Piece>& pieces, Choice choice, int layers,
             const hmps::MooneyRivlin<>& law, bool own_volumes = false);

  [[nodiscard]] std::size_t moving() const { return moving_; }
  [[nodiscard]] const Vector& reference(std::size_t i) const { return body_.reference[i]; }
  [[nodiscard]] Vector displacement(std::size_t i) const { return body_.displacement(i); }
  [[nodiscard]] const Vector& position(std::size_t i) const { return body_.position[i]; }
  void place(std::size_t i, const Vector& x) { body_.position[i] = x; }

  /// Brings the body to rest under `load(i)` (N/m3) until the unbalanced forces are `tolerance` times `total` (N).
  void settle(const std::function<Vector(std::size_t)>& load, double total, double tolerance = 2e-3);
  /// Brings the body to rest from its present state; all particles move. `hold` removes from the forces (N/m3) the
  /// parts that the particles may not follow. Ends as `settle` does.
  void settle_held(const std::function<void(const hmps::VectorView<double, 3>&)>& hold, double total, double tolerance);
  /// Displaces the particles from the reference configuration as in a linear body under `load(i)` (N/m3), by conjugate
  /// gradients. This is many times faster than `settle`, and is what finite elements for small strains compute. Ends as
  /// `settle` does.
  void yield_linearly(const std::function<Vector(std::size_t)>& load, double total, double tolerance);
  /// How far the body gives way to a small load, in mm: the A of the displacement A `pattern` that fits best, which is
  /// proportional to the work of the load. A particle carries a share of the load in proportion to its volume in
  /// `volumes` (m3), one for each moving particle; if empty, all shares are equal.
  [[nodiscard]] double gives_way(const Placement& at, const PatternLoad& load, const std::vector<double>& volumes = {});
  /// The internal forces in N/m3 at the present positions, without velocities.
  [[nodiscard]] const std::vector<Vector>& internal_forces();
  /// The frequency in Hz of a small vibration without viscosity, started from the reference configuration with the
  /// velocities `shape` (m/s) of the particles that move: over the period from the first to the third time at which the
  /// displacement along `shape` passes zero.
  [[nodiscard]] double frequency(const std::vector<Vector>& shape, double density);

 private:
  std::size_t moving_;
  scenes::Body<3> body_;
  hmps::ThinWallStabiliser<double> chosen_;
  std::vector<double> tension_;
  std::unique_ptr<hmps::BondList<double, 3>> bonds_;
  hmps::ForceFunction<double, 3> internal_;
};

/// The results of runs in several placements.
struct Spread {
  double mean, scatter, least, most;  ///< the scatter is the standard deviation over the mean
};
[[nodiscard]] Spread spread(const std::vector<double>& values);
/// A share as a percentage with a sign.
[[nodiscard]] std::string percent(double share);

/// The results for one body that a table compares with the answer of finite elements.
struct Comparison {
  std::string name, of, measured;  ///< the table's name, the body in words, the quantity
  double answer;
  int digits;
  std::vector<int> layers;
  std::vector<int> placements;                                   ///< for each number of layers
  std::function<double(const Placement&, int, Choice)> measure;  ///< with a number of layers
  std::function<double(int)> spacing;                            ///< with a number of layers, m
  /// Bound of the error: 6 % with two layers, 3 % with more.
  std::function<double(int)> bound = [](int count) { return count < 3 ? 0.06 : 0.03; };
};
/// Runs a comparison with `thin_wall_stabiliser`; with `quick` only the first number of layers in one placement.
[[nodiscard]] report::Table compared(const Comparison& with, bool quick);
/// Runs comparisons with `edge_stabiliser` too.
[[nodiscard]] report::Table compared_at_edges(const std::vector<Comparison>& with, bool quick);

/// The bodies of the page that are compared in this way.
[[nodiscard]] Comparison ring();           ///< ring.cpp
[[nodiscard]] Comparison half_cylinder();  ///< shells.cpp
[[nodiscard]] Comparison half_ball();
[[nodiscard]] Comparison strip(bool own_volumes);  ///< clamped.cpp
[[nodiscard]] Comparison wide_strip();
[[nodiscard]] Comparison wedge();
[[nodiscard]] Comparison junction();
[[nodiscard]] Comparison leaf();  ///< leaf.cpp

/// The other tables of the page; with `quick` only a small part.
[[nodiscard]] report::Table plate_about_one_axis(const std::vector<double>& spacings, bool quick);  ///< plate.cpp
[[nodiscard]] report::Table plate_about_any_axis(const std::vector<double>& spacings, bool quick);
[[nodiscard]] report::Table twisted_bar(bool quick);   ///< bar.cpp
[[nodiscard]] report::Table bent_strip(bool quick);    ///< bend.cpp
[[nodiscard]] report::Table outer_stress(bool quick);  ///< stress.cpp

}  // namespace fitted
