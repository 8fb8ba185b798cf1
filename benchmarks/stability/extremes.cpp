// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "stability/body.hpp"
#include "stability/groups.hpp"

namespace stability {
namespace extremes_detail {
namespace {

/// Steps are this share of the value of `stable_step` at rest, because crushed bodies are stiffer.
constexpr double share = 0.25;

template <class Law>
constexpr bool may_invert = requires(const Law& law) {
  law.j_min;
};

template <class Law>
std::string law_name() {
  return may_invert<Law> ? "Continued" : "as printed";
}

/// A cube that is released after its height was multiplied by `factor`, with the paper's viscosity, in steps of
/// `share`.
template <class S, class Law>
std::vector<std::string> let_go(const Law& law, double factor, double part) {
  Body<S> body(spacing, lattice(6, 6, 6, spacing, Vector::Zero()));
  const hmps::LatticeBonds<S, 3> bonds(body.X(), {.spacing = spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(young), hmps::viscous(density, 2e-3),
                                    hmps::record(body.F()));
  const double dt = part * stable(body, force, density);
  for (auto& x : body.position) x[2] *= static_cast<S>(factor);
  const Ending ending = run(body, force, density, dt, 0.05, 500.0, may_invert<Law>);
  double least = 1e300, most = -1e300;
  for (const auto& F : body.gradient) {
    least = std::min(least, static_cast<double>(F.determinant()));
    most = std::max(most, static_cast<double>(F.determinant()));
  }
  const bool recovered = ending.alive && least > 0.9 && most < 1.1;
  std::string end = "J from " + places(least, 2) + " to " + places(most, 2);
  if (!ending.alive) end = ending.why + " after " + digits(1e3 * ending.time) + " ms";
  return {law_name<Law>(),       name_of<S>(), digits(factor), recovered ? digits(part) : "none", end,
          digits(ending.fastest)};
}

/// The largest share of the stable step at rest with which the cube recovers.
template <class S, class Law>
std::vector<std::string> recover(Table& table, const Law& law, double factor) {
  std::vector<std::string> row;
  for (const double part : {0.8, 0.4, 0.2, 0.1, 0.05, 0.02}) {
    row = let_go<S>(law, factor, part);
    if (row[3] != "none") break;
    if (!may_invert<Law> && factor <= 0) break;  // the law has no value there, whatever the step
  }
  if constexpr (may_invert<Law>) {
    const std::string label = "height times " + digits(factor) + " in " + name_of<S>();
    hmps::Matrix<double, 3> start = hmps::Matrix<double, 3>::Identity();
    start(2, 2) = factor;
    table.check(std::isfinite(law.energy(start)) && law.energy(start) > 0, label + ": no finite energy");
    table.check(law.first_piola_kirchhoff(start)(2, 2) < 0, label + ": the force does not push back");
    table.check(row[3] != "none", label + ": the cube does not recover with Continued");
  }
  return row;
}

/// The two ends of a body, of two layers each, whose motion is prescribed.
template <class S>
struct Ends {
  Body<S>& body;
  std::vector<char> end;  ///< 0: free, 1: lower, 2: upper

  Ends(Body<S>& b, double lower, double upper) : body(b), end(b.size(), 0) {
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (b.reference[i][2] < lower) end[i] = 1;
      if (b.reference[i][2] > upper) end[i] = 2;
    }
  }
  /// Sets the velocities of the ends so that they reach `place(end, X)` in the step `dt`.
  template <class Place>
  void lead(double dt, Place&& place) {
    for (std::size_t i = 0; i < end.size(); ++i)
      if (end[i] != 0)
        body.velocity[i] =
            ((place(end[i], body.reference[i]) - body.position[i].template cast<double>()) / dt).template cast<S>();
  }
};

/// Presses a cube between bonded plates to the share `last` of its height, at 1 m/s, and opens the plates again.
template <class S, class Law>
std::vector<std::string> squeeze(const Law& law, double last) {
  const int side = 10;
  const double height = spacing * (side - 1);
  Body<S> body(spacing, lattice(side, side, side, spacing, Vector::Zero()));
  const hmps::LatticeBonds<S, 3> bonds(body.X(), {.spacing = spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(young), hmps::viscous(density, 2e-3),
                                    hmps::record(body.F()));
  const double dt = 0.5 * share * stable(body, force, density), speed = 1;
  Ends<S> ends(body, 0.5 * spacing, height - 0.5 * spacing);
  const double turn = (1 - last) * height / speed;
  double now = 1;
  const auto plates = [&](double t) {
    const double closed = speed * (t < turn ? t : std::max(2 * turn - t, 0.0));
    now = 1 - closed / height;
    ends.lead(dt, [&](char end, const Vector& X) -> Vector { return end == 1 ? X : Vector(X - Vector(0, 0, closed)); });
  };
  const Ending press = run(body, force, density, dt, turn, 200.0, may_invert<Law>, plates);
  std::string back = "-";
  const double reached = now;
  if (press.alive) {
    const Ending open =
        run(body, force, density, dt, 0.05, 200.0, may_invert<Law>, [&](double t) { plates(turn + t); });
    const double least = least_jacobian(body);
    back = open.alive ? "comes back, least J " + places(least, 2) : open.why;
  }
  return {"squeeze to " + digits(last) + " of the height", law_name<Law>(), name_of<S>(),
          press.alive ? "survives to " + places(reached, 2) : "fails at " + places(reached, 2) + " by " + press.why,
          back};
}

/// A column of 1 x 1 x 6 m, its base held, of a neo-Hookean material of 17 MPa, whose particles start with the angular
/// velocity `omega` sin(pi z / 2 L) about its axis: the problem of Lee, Gil and Bonet.
template <class S, class Law>
Ending twist(const Law& law, double omega, double duration) {
  const double l0 = 1.0 / 6, rho = 1100, length = 6;
  Body<S> body(l0, lattice(6, 6, 38, l0, Vector(-2.5 * l0, -2.5 * l0, -1.5 * l0)));
  const hmps::LatticeBonds<S, 3> bonds(body.X(), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(8.5e6), hmps::record(body.F()));
  const double dt = share * stable(body, force, rho);
  Ends<S> ends(body, 0, 2 * length);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Vector& X = body.reference[i];
    const double rate = X[2] > 0 ? omega * std::sin(std::numbers::pi * X[2] / (2 * length)) : 0.0;
    body.velocity[i] = (rate * Vector(-X[1], X[0], 0)).cast<S>();
  }
  return run(body, force, rho, dt, duration, 2000.0, may_invert<Law>,
             [&](double) { ends.lead(dt, [](char, const Vector& X) -> Vector { return X; }); });
}
template <class S, class Law>
std::vector<std::string> twist_to_failure(const Law& law, bool quick) {
  std::string end = "survives 1600 rad/s";
  for (const double omega :
       quick ? std::vector<double>{105} : std::vector<double>{105, 200, 300, 400, 500, 600, 800, 1200, 1600}) {
    const Ending ending = twist<S>(law, omega, quick ? 0.02 : 0.3);
    if (quick) end = "survives 105 rad/s";
    if (ending.alive) continue;
    end = "fails at " + digits(omega) + " rad/s by " + ending.why + " after " + digits(1e3 * ending.time) + " ms";
    break;
  }
  return {"twist of a column", law_name<Law>(), name_of<S>(), end, "-"};
}

/// A bar of length 10 H whose ends are led along a circle, at 0.2 s for 360 degrees: the angle of bend that it reaches.
template <class S, class Law>
std::vector<std::string> bend(const Law& law, bool quick) {
  const int across = 4, along = 42;
  Body<S> body(spacing,
               lattice(across, across, along, spacing, Vector(-1.5 * spacing, -1.5 * spacing, -0.5 * spacing)));
  const hmps::LatticeBonds<S, 3> bonds(body.X(), {.spacing = spacing});
  auto force = hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(young / 2),
                                    hmps::viscous(density, 2e-3), hmps::record(body.F()));
  const double dt = share * stable(body, force, density);
  const double length = spacing * (along - 2), duration = 0.2, most = quick ? 20 : 360;
  Ends<S> ends(body, spacing, length - 1.5 * spacing);
  double degrees = 0;
  const Ending ending = run(body, force, density, dt, duration * most / 360, 100.0, may_invert<Law>, [&](double t) {
    degrees = 360 * t / duration;
    const double angle = degrees * std::numbers::pi / 180, radius = length / angle;
    ends.lead(dt, [&](char, const Vector& X) -> Vector {
      const double turned = angle * X[2] / length;
      return {radius - (radius - X[0]) * std::cos(turned), X[1], (radius - X[0]) * std::sin(turned)};
    });
  });
  return {"bend of a bar", law_name<Law>(), name_of<S>(),
          ending.alive ? "survives " + places(degrees, 0) + " degrees"
                       : "fails at " + places(degrees, 0) + " degrees by " + ending.why,
          "least J " + places(least_jacobian(body), 2)};
}

template <class Visit>
void for_each_law(Visit&& visit) {
  visit(tissue);
  visit(hmps::Continued{tissue});
}

}  // namespace
}  // namespace extremes_detail

Table inversion(bool quick) {
  using namespace extremes_detail;
  Table table{"inversion",
              {"Law", "Scalar", "Height times", "Recovers at this share of the stable step", "At the end",
               "Largest speed, m/s"}};
  const std::vector<double> factors =
      quick ? std::vector<double>{0.1, -0.2} : std::vector<double>{0.5, 0.3, 0.1, 0.02, 0, -0.1, -0.3, -0.5, -1};
  for (const double factor : factors) {
    for_each_law([&](const auto& law) {
      table.rows.push_back(recover<double>(table, law, factor));
      table.rows.push_back(recover<float>(table, law, factor));
    });
  }
  return table;
}

Table deformation(bool quick) {
  using namespace extremes_detail;
  Table table{"deformation", {"Deformation", "Law", "Scalar", "Outcome", "Afterwards"}};
  const auto both = [&](auto&& problem) {
    table.rows.push_back(problem(double{}));
    if (!quick) table.rows.push_back(problem(float{}));
  };
  for (const double last : quick ? std::vector<double>{0.6} : std::vector<double>{0.4, 0.2, 0.02})
    for_each_law([&](const auto& law) { both([&](auto s) { return squeeze<decltype(s)>(law, last); }); });
  // E = 17 MPa, nu = 0.45.
  const auto rubber = hmps::NeoHookean<>::from_young_poisson(17e6, 0.45);
  both([&](auto s) { return twist_to_failure<decltype(s)>(rubber, quick); });
  both([&](auto s) { return twist_to_failure<decltype(s)>(hmps::Continued{rubber}, quick); });
  for_each_law([&](const auto& law) { both([&](auto s) { return bend<decltype(s)>(law, quick); }); });
  if (quick)
    for (const auto& row : table.rows) table.check(row[3].starts_with("survives"), row[0] + " " + row[3]);
  return table;
}

}  // namespace stability
