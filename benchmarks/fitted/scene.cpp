// SPDX-License-Identifier: MIT
#include "fitted/scene.hpp"

#include <algorithm>
#include <numbers>
#include <random>
#include <stdexcept>

#include <hmps/core/error.hpp>

#include "report/text.hpp"

namespace fitted {
namespace scene_detail {
namespace {

/// Subtracts the mean and the moment from a pattern, so that a free body neither drifts nor turns.
void balance(std::vector<Vector>& pattern, const std::vector<Vector>& places) {
  const auto count = static_cast<double>(pattern.size());
  Vector sum = Vector::Zero(), moment = Vector::Zero(), middle = Vector::Zero();
  for (std::size_t i = 0; i < pattern.size(); ++i) middle += places[i] / count;
  hmps::Matrix<double, 3> inertia = hmps::Matrix<double, 3>::Zero();
  for (std::size_t i = 0; i < pattern.size(); ++i) {
    const Vector arm = places[i] - middle;
    sum += pattern[i];
    moment += arm.cross(pattern[i]);
    inertia += arm.squaredNorm() * hmps::Matrix<double, 3>::Identity() - arm * arm.transpose();
  }
  const Vector turn = inertia.ldlt().solve(moment);
  for (std::size_t i = 0; i < pattern.size(); ++i) pattern[i] -= sum / count + turn.cross(places[i] - middle);
}

}  // namespace
}  // namespace scene_detail

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
    // A quaternion with a uniform distribution over the unit sphere: all turns are equally likely.
    const double split = share(), first = 2 * std::numbers::pi * share(), second = 2 * std::numbers::pi * share();
    const double a = std::sqrt(1 - split), b = std::sqrt(split);
    const Eigen::Quaterniond turn(b * std::cos(second), a * std::sin(first), a * std::cos(first), b * std::sin(second));
    const double x = share(), y = share(), z = share();
    all.push_back({turn.toRotationMatrix(), spacing * Vector(x, y, z)});
  }
  return all;
}

std::string name(Choice choice) {
  switch (choice) {
    case Choice::waves:
      return "4/3 mu";
    case Choice::sheet:
      return "sheet_stabiliser";
    case Choice::thin_wall:
      return "thin_wall_stabiliser";
    case Choice::edges:
      return "edge_stabiliser";
    case Choice::bar:
      return "bar_stabiliser";
  }
  throw std::logic_error("a choice of stabiliser without a name");
}

FittedBody::FittedBody(double spacing, const std::vector<Piece>& pieces, Choice choice, int layers,
                       const hmps::MooneyRivlin<>& material, bool own_volumes)
    : moving_(pieces.front().size()), body_(spacing, scenes::joined(pieces).positions) {
  if (own_volumes) {
    const std::vector<double> volumes = scenes::joined(pieces).volumes;
    bonds_ = std::make_unique<hmps::BondList<double, 3>>(body_.X(), hmps::BondSettings{.spacing = spacing},
                                                         hmps::scalars(volumes));
  } else {
    bonds_ = std::make_unique<hmps::BondList<double, 3>>(body_.X(), hmps::BondSettings{.spacing = spacing});
  }
  hmps::MooneyRivlin<> law = material;
  const double shear = law.shear_modulus(), bulk = law.bulk_modulus();
  hmps::SheetStabiliser<double> even{hmps::shear_wave_modulus(shear), {bulk, 0.0}};
  if (choice == Choice::sheet) even = hmps::sheet_stabiliser(layers, bulk, shear);
  law.d1 = even.bulk.law / 2;
  if (choice == Choice::thin_wall) {
    chosen_ = scenes::stabiliser_of(scenes::joined(pieces), spacing, material);
    internal_ = scenes::thin_wall_force(*bonds_, material, chosen_);
  } else if (choice == Choice::edges) {
    const Piece all = scenes::joined(pieces);
    chosen_ = scenes::stabiliser_of(all, spacing, material);
    auto of = hmps::edge_stabiliser(chosen_.moduli, all.edges);
    chosen_.moduli = std::move(of.moduli);
    tension_ = std::move(of.tension);
    internal_ = scenes::thin_wall_force(*bonds_, material, chosen_, hmps::artificial_tension(hmps::scalars(tension_)));
  } else if (choice == Choice::bar) {
    const auto [modulus, tension] = hmps::bar_stabiliser(shear);
    internal_ =
        hmps::internal_force(*bonds_, hmps::elastic(law), hmps::artificial(modulus), hmps::artificial_tension(tension));
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

void FittedBody::yield_linearly(const std::function<Vector(std::size_t)>& load, double total, double tolerance) {
  const auto dot = [](const std::vector<Vector>& a, const std::vector<Vector>& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
    return sum;
  };
  std::vector<Vector> moved(moving_, Vector::Zero()), left, along;
  for (std::size_t i = 0; i < moving_; ++i) left.push_back(load(i));
  along = left;
  double squares = dot(left, left);
  constexpr int most_iterations = 100'000;
  for (int iteration = 0;; ++iteration) {
    double unbalanced = 0, longest = 0;
    for (std::size_t i = 0; i < moving_; ++i) {
      unbalanced += left[i].norm() * body_.volume();
      longest = std::max(longest, along[i].norm());
    }
    if (unbalanced <= tolerance * total) break;
    if (iteration == most_iterations) throw hmps::StateError("a body does not come to rest under a small load");
    // The derivative of the forces, over a step in which they are linear and still much larger than rounding errors.
    const double step = 1e-6 * body_.spacing / longest;
    for (std::size_t i = 0; i < moving_; ++i) body_.position[i] = body_.reference[i] + step * along[i];
    const std::vector<Vector>& forces = internal_forces();
    double stiffness = 0;
    for (std::size_t i = 0; i < moving_; ++i) stiffness -= along[i].dot(forces[i]) / step;
    const double by = squares / stiffness;
    for (std::size_t i = 0; i < moving_; ++i) {
      moved[i] += by * along[i];
      left[i] += by / step * forces[i];
    }
    const double before = std::exchange(squares, dot(left, left));
    for (std::size_t i = 0; i < moving_; ++i) along[i] = left[i] + squares / before * along[i];
  }
  for (std::size_t i = 0; i < moving_; ++i) body_.position[i] = body_.reference[i] + moved[i];
}

double FittedBody::gives_way(const Placement& at, const PatternLoad& load, const std::vector<double>& volumes) {
  std::vector<Vector> pattern;
  for (std::size_t i = 0; i < moving_; ++i) pattern.emplace_back(at.direction(load.pattern(at.local(reference(i)))));
  if (load.of_free_body) scene_detail::balance(pattern, body_.reference);
  const double cube = body_.volume();
  const auto share = [&](std::size_t i) { return volumes.empty() ? 1.0 : volumes[i] / cube; };
  double total = 0;
  for (std::size_t i = 0; i < moving_; ++i) total += load.size * share(i) * pattern[i].norm() * cube;
  const auto loads = [&](std::size_t i) {
    Vector of = Vector::Zero();
    if (i < moving_) of = load.size * share(i) * pattern[i];
    return of;
  };
  yield_linearly(loads, total, 1e-3);
  double along = 0, squares = 0;
  for (std::size_t i = 0; i < moving_; ++i) {
    along += share(i) * displacement(i).dot(pattern[i]);
    squares += share(i) * pattern[i].squaredNorm();
  }
  return 1e3 * along / squares;
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
  constexpr long most_steps = 1'000'000;  // the slowest of these bodies needs about ten thousand
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

report::Table compared(const Comparison& with, bool quick) {
  using report::places;
  report::Table table{.name = with.name,
                      .header = {"layers", "placements", with.measured, "range", "scatter", "error"}};
  for (std::size_t k = 0; k < (quick ? 1 : with.layers.size()); ++k) {
    const int layers = with.layers[k];
    std::vector<double> found;
    for (const Placement& at : any_placements(quick ? 1 : with.placements[k], with.spacing(layers)))
      found.push_back(with.measure(at, layers, Choice::thin_wall));
    const Spread by = spread(found);
    const double error = by.mean / with.answer - 1;
    table.rows.push_back({std::to_string(layers), std::to_string(found.size()), places(by.mean, with.digits),
                          places(by.least, with.digits) + " to " + places(by.most, with.digits),
                          places(100 * by.scatter, 1) + " %", percent(error)});
    const std::string which = with.of + " of " + std::to_string(layers) + " layers ";
    table.check(std::abs(error) < with.bound(layers), which + "misses its bound");
    table.check(by.scatter < 0.02, which + "depends on how it lies");
  }
  return table;
}

report::Table compared_at_edges(const std::vector<Comparison>& with, bool quick) {
  using report::places;
  report::Table table{
      .name = "edges",
      .header = {"body", "layers", "placements", name(Choice::thin_wall), "scatter", name(Choice::edges), "scatter"}};
  for (const Comparison& body : with)
    for (std::size_t k = 0; k < (quick ? 1 : body.layers.size()); ++k) {
      const int layers = body.layers[k];
      const auto placements = any_placements(quick ? 1 : body.placements[k], body.spacing(layers));
      report::Cells row{body.of, std::to_string(layers), std::to_string(placements.size())};
      for (const Choice choice : {Choice::thin_wall, Choice::edges}) {
        std::vector<double> found;
        for (const Placement& at : placements) found.push_back(body.measure(at, layers, choice));
        const Spread by = spread(found);
        row.push_back(percent(by.mean / body.answer - 1));
        row.push_back(places(100 * by.scatter, 1) + " %");
        if (choice == Choice::edges)
          table.check(std::abs(by.mean / body.answer - 1) < body.bound(layers),
                      body.of + " of " + std::to_string(layers) + " layers misses its bound");
      }
      table.rows.push_back(row);
    }
  return table;
}

std::string percent(double share) {
  std::string text = share < 0 ? "" : "+";
  text += report::places(100 * share, 1);
  return text + " %";
}

}  // namespace fitted
