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
  /// `layers`: what `sheet_stabiliser` is told.
  FittedBody(double spacing, const std::vector<Piece>& pieces, Choice choice, int layers,
             const hmps::MooneyRivlin<>& law);

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

/// The tables of the page; `quick` leaves a small part.
[[nodiscard]] report::Table plate_about_one_axis(const std::vector<double>& spacings, bool quick);  ///< plate.cpp
[[nodiscard]] report::Table plate_about_any_axis(const std::vector<double>& spacings, bool quick);
[[nodiscard]] report::Table twisted_bar(bool quick);   ///< bar.cpp
[[nodiscard]] report::Table pinched_ring(bool quick);  ///< ring.cpp
[[nodiscard]] report::Table bent_strip(bool quick);    ///< bend.cpp

}  // namespace fitted
