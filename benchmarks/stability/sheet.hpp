// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "stability/body.hpp"

namespace stability {

/// One scene whose largest step is measured.
struct Case {
  std::string group = {}, name = {};
  int layers = 8;        ///< particles through the sheet
  double radius = 1.75;  ///< r_e / l0
  double modulus = 1;    ///< E_hat / E
  double ratio = 300;    ///< kappa / mu
  double stretch = 1;    ///< along z, at constant volume
  double viscosity = 0;  ///< m2/s
  double penalty = 0;    ///< k dt_c^2 / rho with the limit dt_c without contact; if not zero, two bodies
  double dt_c = 0;       ///< s
  bool held = false;     ///< the second body does not move
};

/// The composed force of a case, on one body or two that are pressed together.
template <class S>
class Sheet {
 public:
  explicit Sheet(const Case& c)
      : body_(spacing, points(c)),
        movable_(c.held ? split(c) : body_.size()),
        law_(hmps::MooneyRivlin<>::from_young(young, c.ratio * young / 6)),
        bonds_(body_.X(), {.spacing = spacing, .radius_ratio = c.radius},
               [half = split(c)](std::size_t i, std::size_t j) { return (i < half) == (j < half); }),
        elastic_(bonds_, hmps::elastic(law_)),
        stabiliser_(bonds_, hmps::artificial(c.modulus * young)),
        viscous_(bonds_, hmps::viscous(density, c.viscosity)),
        whole_(bonds_, hmps::elastic(law_), hmps::artificial(c.modulus * young), hmps::viscous(density, c.viscosity),
               hmps::record(body_.F())),
        contact_({.spacing = spacing, .density = density, .stiffness = stiffness(c)}) {
    const double across = 1 / std::sqrt(c.stretch);
    for (auto& x : body_.position) x = x.cwiseProduct(Vector(across, across, c.stretch).cast<S>());
    if (c.penalty > 0) press(c);
  }

  Body<S>& body() { return body_; }
  [[nodiscard]] const auto& bonds() const { return bonds_; }
  [[nodiscard]] bool touches() const { return !skin_[0].empty(); }
  [[nodiscard]] bool moves(std::size_t i) const { return i < movable_; }
  [[nodiscard]] double sound() const { return hmps::sound_speed(law_, density); }

  template <class X, class V, class F>
  void operator()(const X& x, const V& v, const F& f) {
    whole_(x, v, f);
    touch(x, v, f);
  }
  template <class X, class V, class F>
  void touch(const X& x, const V& v, const F& f) {
    if (touches()) contact_.add(x, v, body_.F(), f, 2e-6);
  }

  [[nodiscard]] std::vector<hmps::StepCause> causes(const hmps::StableStep& found,
                                                    const hmps::StableStepSettings& settings) {
    const auto contact = [this](const auto& x, const auto& v, const auto& f) { this->touch(x, v, f); };
    return hmps::step_causes(found, body_.x(), body_.v(), density, settings, hmps::NamedForce{"elastic", elastic_},
                             hmps::NamedForce{"stabiliser", stabiliser_}, hmps::NamedForce{"viscosity", viscous_},
                             hmps::NamedForce{"contact", contact});
  }

 private:
  using List = hmps::BondList<S, 3>;
  static constexpr int side = 10;
  static constexpr double pressure = 200;  ///< Pa, much less than Young's modulus: the bodies must not buckle

  static std::size_t split(const Case& c) { return static_cast<std::size_t>(side * side * c.layers); }
  static std::vector<Vector> points(const Case& c) {
    // The layers follow each other along x, so that each body is contiguous in memory.
    return lattice(c.penalty > 0 ? 2 * c.layers : c.layers, side, side, spacing, Vector::Constant(0.01));
  }
  static hmps::PenaltyStiffness stiffness(const Case& c) {
    return c.penalty > 0 ? hmps::PenaltyStiffness::fixed(c.penalty * density / (c.dt_c * c.dt_c))
                         : hmps::PenaltyStiffness::ratio(0.3);
  }
  /// Moves the second body towards the first until contact pushes it back with `pressure`.
  void press(const Case& c) {
    std::vector<std::size_t> second;
    for (std::size_t i = 0; i < body_.size(); ++i) {
      const auto layer = static_cast<int>(i) / (side * side);
      const std::size_t half = layer < c.layers ? 0 : 1;
      if (half == 1) second.push_back(i);
      const int depth = half == 0 ? c.layers - 1 - layer : layer - c.layers;
      if (depth < 1) skin_[half].push_back(static_cast<hmps::Index>(i));
      if (depth < 3) wall_[half].push_back(static_cast<hmps::Index>(i));
    }
    const auto a = contact_.add_organ({"first", skin_[0], wall_[0]});
    const auto b = contact_.add_organ({"second", skin_[1], wall_[1]});
    contact_.add_pair(a, b);
    const auto start = body_.position;
    double open = -0.2 * spacing, closed = 0.2 * spacing;
    while (closed - open > 1e-12) {
      const double shift = (open + closed) / 2;
      body_.position = start;
      for (const std::size_t i : second) body_.position[i][0] -= static_cast<S>(shift);
      body_.unload();
      touch(body_.x(), body_.v(), body_.f());
      double push = 0;
      for (const std::size_t i : second) push += static_cast<double>(body_.load[i][0]);
      (push * spacing / (side * side) > pressure ? closed : open) = shift;
    }
  }

  Body<S> body_;
  std::size_t movable_;  ///< number of particles that move, the first ones
  hmps::MooneyRivlin<> law_;
  List bonds_;
  hmps::InternalForce<List, hmps::Elastic<hmps::MooneyRivlin<>>> elastic_;
  hmps::InternalForce<List, hmps::Artificial<double>> stabiliser_;
  hmps::InternalForce<List, hmps::Viscous> viscous_;
  decltype(hmps::internal_force(std::declval<const List&>(), std::declval<hmps::Elastic<hmps::MooneyRivlin<>>>(),
                                std::declval<hmps::Artificial<double>>(), std::declval<hmps::Viscous>(),
                                hmps::record(std::declval<hmps::MatrixView<S, 3>>()))) whole_;
  hmps::MetaballContact<S, 3> contact_;
  std::vector<hmps::Index> skin_[2], wall_[2];
};

}  // namespace stability
