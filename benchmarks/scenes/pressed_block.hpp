// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <hmps/hmps.hpp>
#include <optional>
#include <type_traits>
#include <utility>
#include <vector>

#include "scenes/fitted_body.hpp"

namespace scenes {

/// The particles of a block on a wall, those of the block first, and the sets of particles with a role in contact.
struct BlockOnWall {
  std::vector<hmps::Vector<double, 3>> places = {};              ///< m
  std::size_t block = 0;                                         ///< number of particles of the block
  std::vector<hmps::Index> bottom = {}, lower = {}, plate = {};  ///< of the block: slaves, masters, led by a plate
  std::vector<hmps::Index> skin = {}, wall = {};                 ///< of the wall: slaves, masters

  /// Adds a particle of the block. Add those of the wall after all of these.
  void add(const hmps::Vector<double, 3>& place, bool is_bottom, bool is_lower, bool is_led) {
    const auto index = static_cast<hmps::Index>(places.size());
    if (is_bottom) bottom.push_back(index);
    if (is_lower) lower.push_back(index);
    if (is_led) plate.push_back(index);
    places.push_back(place);
    block = places.size();
  }
  void add_to_wall(const hmps::Vector<double, 3>& place, bool is_skin) {
    wall.push_back(static_cast<hmps::Index>(places.size()));
    if (is_skin) skin.push_back(wall.back());
    places.push_back(place);
  }
};

/// SI units.
struct BlockSettings {
  double spacing, density, young, d1, modulus, viscosity;  ///< of the block; the modulus is E_hat
  double pressure, area;                                   ///< of the plate on top
  double friction, ratio;                                  ///< of the contact; the ratio is k~
  std::optional<double> damping = {};                      ///< empty: that of the friction law
  double margin = 0.5;
};

[[nodiscard]] inline hmps::MooneyRivlin<> law_of(const BlockSettings& s) {
  return hmps::MooneyRivlin<>::from_young(s.young, s.d1);
}

/// The internal force of a block with the same E_hat everywhere.
struct EvenTerms {
  template <class B, class M>
  [[nodiscard]] auto operator()(const B& bonds, const M& F, const BlockSettings& s) const {
    return hmps::internal_force(bonds, hmps::elastic(law_of(s)), hmps::artificial(s.modulus),
                                hmps::viscous(s.density, s.viscosity), hmps::record(F));
  }
};
/// That of fitted particles, whose stabiliser replaces E_hat of the settings.
struct ThinWallTerms {
  hmps::ThinWallStabiliser<double> chosen;

  template <class B, class M>
  [[nodiscard]] auto operator()(const B& bonds, const M& F, const BlockSettings& s) const {
    return thin_wall_force(bonds, law_of(s), chosen, hmps::viscous(s.density, s.viscosity), hmps::record(F));
  }
};

/// A block of soft tissue on a rigid wall, pressed by a rigid plate that sinks as far as the block allows. Its state
/// has the scalar type `S`, the forces that of `Bonds`. `Terms` makes the internal force.
template <class Bonds, class S, class Ball, class Friction, class Terms = EvenTerms>
struct PressedBlock {
  using K = typename Bonds::Scalar;
  using Vector = hmps::Vector<S, 3>;

  BlockOnWall parts;
  BlockSettings settings;
  std::vector<Vector> velocity, load, carry, position;
  std::vector<hmps::Matrix<K, 3>> gradient;
  Bonds bonds;
  Terms terms;
  decltype(std::declval<const Terms&>()(std::declval<const Bonds&>(), std::declval<hmps::MatrixView<K, 3>>(),
                                        std::declval<const BlockSettings&>())) force;
  double dt;           ///< s
  double sinking = 0;  ///< of the plate, m/s, upward
  hmps::MetaballContact<K, 3, Ball, Friction> contact;
  std::size_t pair;

  /// `choose(force, x, v)` returns the step in s.
  template <class Choose>
  PressedBlock(BlockOnWall of, const BlockSettings& s, Choose&& choose, Terms make_force = {})
      : parts(std::move(of)),
        settings(s),
        velocity(parts.places.size(), Vector::Zero()),
        load(velocity),
        carry(velocity),
        gradient(parts.places.size(), hmps::Matrix<K, 3>::Identity()),
        bonds((place(), block(x())), {.spacing = s.spacing}),
        terms(std::move(make_force)),
        force(terms(bonds, block(F()), s)),
        dt(choose(force, block(x()), block(v()))),
        contact({.spacing = s.spacing,
                 .density = s.density,
                 .friction = s.friction,
                 .stiffness = hmps::PenaltyStiffness::fixed(s.ratio * s.density / (dt * dt)),
                 .damping = s.damping,
                 .margin = s.margin}) {
    const auto below = contact.add_organ({"wall", parts.skin, parts.wall, [](hmps::Index) { return true; }});
    pair = contact.add_pair(below, contact.add_organ({"block", parts.bottom, parts.lower}));
  }

  [[nodiscard]] auto x() { return hmps::vectors(position); }
  [[nodiscard]] auto v() { return hmps::vectors(velocity); }
  [[nodiscard]] auto f() { return hmps::vectors(load); }
  [[nodiscard]] auto F() { return hmps::matrices(gradient); }
  /// The part of a view that belongs to the block.
  template <class View>
  [[nodiscard]] auto block(const View& view) const {
    return view.part(0, parts.block);
  }

  void place() {
    for (const auto& where : parts.places) position.push_back(where.template cast<S>());
  }
  void unload() { hmps::set_zero(f()); }
  /// Lets the plate sink for a step under its pressure and the force of the block.
  void sink() {
    const double volume = settings.spacing * settings.spacing * settings.spacing;
    double lift = -settings.pressure * settings.area;
    for (const hmps::Index i : parts.plate) lift += static_cast<double>(load[i][2]) * volume;
    if (!parts.plate.empty())
      sinking += dt * lift / (static_cast<double>(parts.plate.size()) * volume * settings.density);
  }
  /// Kicks the block for `time` (s), then leads the plate at `speed` (m/s) along the wall.
  void kick(double time, double speed) {
    hmps::kick(block(v()), block(f()), settings.density, time);
    for (const hmps::Index i : parts.plate) velocity[i] = Vector(static_cast<S>(speed), S(0), static_cast<S>(sinking));
  }
  /// Adds the force of contact over the step `time`, with the particles at `places`.
  void touch(const hmps::VectorView<S, 3>& places, double time) { (void)contact.add(places, v(), F(), f(), time); }
  [[nodiscard]] hmps::Vector<double, 3> on_wall() const { return contact.force_on_first(pair); }
  void drift() {
    if constexpr (std::is_same_v<S, float>)
      hmps::drift(block(x()), block(v()), block(hmps::vectors(carry)), dt);
    else
      hmps::drift(block(x()), block(v()), dt);
  }
};

}  // namespace scenes
