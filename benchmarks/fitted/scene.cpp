// SPDX-License-Identifier: MIT
#include "fitted/scene.hpp"

#include <algorithm>
#include <numbers>
#include <random>

#include <hmps/core/error.hpp>

#include "report/text.hpp"

namespace fitted {

Placement tilted(double degrees, const Vector& by) {
  const double angle = degrees * std::numbers::pi / 180, c = std::cos(angle), s = std::sin(angle);
  Placement at{.moved = by};
  at.turn << c, 0, -s, 0, 1, 0, s, 0, c;
  return at;
}

std::vector<Placement> any_placements(int count, double spacing) {
  std::mt19937 random(20261128);
  const auto share = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Placement> all;
  while (static_cast<int>(all.size()) < count) {
    // A quaternion that is even over the unit sphere: any turn is as likely as any other.
    const double split = share(), first = 2 * std::numbers::pi * share(), second = 2 * std::numbers::pi * share();
    const double a = std::sqrt(1 - split), b = std::sqrt(split);
    const Eigen::Quaterniond turn(b * std::cos(second), a * std::sin(first), a * std::cos(first), b * std::sin(second));
    const double x = share(), y = share(), z = share();
    all.push_back({turn.toRotationMatrix(), spacing * Vector(x, y, z)});
  }
  return all;
}

std::string name(Choice choice) {
  return choice == Choice::waves ? "4/3 mu" : choice == Choice::sheet ? "sheet_stabiliser" : "thin_wall_stabiliser";
}

FittedBody::FittedBody(double spacing, const std::vector<Piece>& pieces, Choice choice, int layers,
                       const hmps::MooneyRivlin<>& material)
    : moving_(pieces.front().size()), body_(spacing, [&] {
        std::vector<Vector> all;
        for (const Piece& piece : pieces) all.insert(all.end(), piece.positions.begin(), piece.positions.end());
        return all;
      }()) {
  bonds_ = std::make_unique<hmps::BondList<double, 3>>(body_.X(), hmps::BondSettings{.spacing = spacing});
  hmps::MooneyRivlin<> law = material;
  const double shear = law.shear_modulus(), bulk = law.bulk_modulus();
  hmps::SheetStabiliser<double> even{hmps::shear_wave_modulus(shear), {bulk, 0.0}};
  if (choice == Choice::sheet) even = hmps::sheet_stabiliser(layers, bulk, shear);
  law.d1 = even.bulk.law / 2;
  if (choice == Choice::thin_wall) {
    std::vector<int> through;
    std::vector<double> apart;
    for (const Piece& piece : pieces) {
      through.insert(through.end(), piece.layers.begin(), piece.layers.end());
      apart.insert(apart.end(), piece.layer_spacings.begin(), piece.layer_spacings.end());
    }
    auto wall = hmps::thin_wall_stabiliser(through, apart, spacing, bulk, shear);
    moduli_ = std::move(wall.moduli);
    law.d1 = wall.bulk.law / 2;
    internal_ = hmps::internal_force(
        *bonds_, hmps::elastic(law), hmps::mean_dilatation<2>(wall.bulk.mean),
        hmps::artificial([modulus = hmps::scalars(moduli_)](const auto& of) { return of(modulus); }));
  } else if (even.bulk.mean > 0) {
    internal_ = hmps::internal_force(*bonds_, hmps::elastic(law), hmps::mean_dilatation(even.bulk.mean),
                                     hmps::artificial(even.modulus));
  } else {
    internal_ = hmps::internal_force(*bonds_, hmps::elastic(law), hmps::artificial(even.modulus));
  }
}

void FittedBody::settle(const std::function<Vector(std::size_t)>& load, double total, double tolerance) {
  std::vector<Vector> loads;
  for (std::size_t i = 0; i < body_.size(); ++i) loads.push_back(load(i));
  const auto force = [&](const auto& x, const auto& v, const auto& f) {
    internal_(x, v, f);
    for (std::size_t i = 0; i < f.size(); ++i)
      for (int c = 0; c < 3; ++c) f(i, c) += loads[i][c];
  };
  constexpr double density = 1000;  // means nothing in statics
  hmps::relax(force, body_.x(), body_.v(), body_.f(), density,
              {.spacing = body_.spacing, .tolerance = tolerance, .load = total, .moves = [&](std::size_t i) {
                 return i < moving_;
               }});
}

void FittedBody::settle_held(const std::function<void(const hmps::VectorView<double, 3>&)>& hold, double total,
                             double tolerance) {
  const auto force = [&](const auto& x, const auto& v, const auto& f) {
    internal_(x, v, f);
    hold(f);
  };
  constexpr double density = 1000;  // means nothing in statics
  hmps::relax(force, body_.x(), body_.v(), body_.f(), density,
              {.spacing = body_.spacing, .tolerance = tolerance, .load = total});
}

const std::vector<Vector>& FittedBody::internal_forces() {
  body_.velocity.assign(body_.size(), Vector::Zero());
  body_.unload();
  internal_(body_.x(), body_.v(), body_.f());
  return body_.load;
}

double FittedBody::frequency(const std::vector<Vector>& shape, double density) {
  body_.position = body_.reference;
  body_.velocity = shape;
  body_.velocity.resize(body_.size(), Vector::Zero());  // of the held particles
  const auto moves = [&](std::size_t i) { return i < moving_; };
  const double dt =
      0.75 *
      hmps::stable_step(internal_, body_.x(), body_.v(), density, {.spacing = body_.spacing, .moves = moves}).limit;
  std::vector<double> crossings;
  double last = 0;
  constexpr long most_steps = 1'000'000;  // the slowest of these bodies passes zero three times in some ten thousand
  for (long step = 1; crossings.size() < 3; ++step) {
    if (step > most_steps) throw hmps::StateError("a body does not vibrate along the shape in which it was started");
    internal_(body_.x(), body_.v(), body_.f());
    hmps::kick(body_.v(), body_.f(), density, dt);
    for (std::size_t i = moving_; i < body_.size(); ++i) body_.velocity[i].setZero();
    hmps::drift(body_.x(), body_.v(), dt);
    double along = 0;
    for (std::size_t i = 0; i < moving_; ++i) along += shape[i].dot(body_.displacement(i));
    if (step > 1 && (along > 0) != (last > 0))
      crossings.push_back((static_cast<double>(step) - along / (along - last)) * dt);
    last = along;
    if (step % 64 == 0) hmps::check_state(body_.x(), body_.v(), body_.F(), {.time = static_cast<double>(step) * dt});
  }
  return 1 / (crossings[2] - crossings[0]);
}

Spread spread(const std::vector<double>& values) {
  double sum = 0, squares = 0;
  for (const double value : values) sum += value;
  const double mean = sum / static_cast<double>(values.size());
  for (const double value : values) squares += (value - mean) * (value - mean);
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {mean, std::sqrt(squares / static_cast<double>(values.size())) / mean, *least, *most};
}

std::string percent(double share) {
  std::string text = share < 0 ? "" : "+";
  text += report::places(100 * share, 1);
  return text + " %";
}

}  // namespace fitted
