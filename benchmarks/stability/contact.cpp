// SPDX-License-Identifier: MIT
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "stability/body.hpp"
#include "stability/groups.hpp"

namespace stability {
namespace contact_detail {
namespace {

/// A cube above a wall or above another cube. Both are parts of one set of particles, the upper cube first.
template <class S>
class Meeting {
 public:
  struct Settings {
    int layers = 2;      ///< of the wall
    bool held = true;    ///< the lower part does not move
    double ratio = 0.3;  ///< k~
    double friction = 0;
    double stiffness = 1;  ///< of the cube over that of the lower part, in all moduli
    double heaviness = 1;  ///< of the cube over that of the lower part
    double contact_density = density;
  };

  explicit Meeting(const Settings& s)
      : settings_(s),
        body_(spacing, points(s)),
        bonds_(cube(body_.X()), {.spacing = spacing}),
        lower_(partner(body_.X()), {.spacing = spacing}),
        upper_force_(bonds_, hmps::elastic(law(s.stiffness)), hmps::artificial(young / 2 * s.stiffness),
                     hmps::record(cube(body_.F()))),
        lower_force_(lower_, hmps::elastic(law(1)), hmps::artificial(young / 2), hmps::record(partner(body_.F()))),
        contact_({.spacing = spacing,
                  .density = s.contact_density,
                  .friction = s.friction,
                  .stiffness = hmps::PenaltyStiffness::ratio(s.ratio)}),
        density_(body_.size(), density) {
    for (std::size_t i = 0; i < cube_size; ++i) density_[i] *= s.heaviness;
    for (std::size_t i = 0; i < body_.size(); ++i) {
      const auto index = static_cast<hmps::Index>(i);
      const bool outside = i >= cube_size || is_face(i);
      if (i < cube_size) {
        if (outside) skin_[0].push_back(index);
        wall_[0].push_back(index);
      } else {
        if (body_.reference[i][2] > -0.5 * spacing) skin_[1].push_back(index);
        wall_[1].push_back(index);
      }
    }
    const auto a = contact_.add_organ({"cube", skin_[0], wall_[0]});
    hmps::Organ wall{"wall", skin_[1], wall_[1]};
    if (s.held) wall.prescribed = [](hmps::Index) { return true; };
    contact_.add_pair(a, contact_.add_organ(wall));
  }

  Body<S>& body() { return body_; }
  /// Number of slaves reported as lost so far; contacts() is the number of all contacts.
  [[nodiscard]] std::size_t lost() const { return lost_; }
  [[nodiscard]] std::size_t contacts() const { return contacts_; }

  /// The stable step of the parts without contact.
  [[nodiscard]] double stable() {
    const auto x = body_.x(), v = body_.v();
    const hmps::StableStepSettings settings{.spacing = spacing};
    const double dt = hmps::stable_step(upper_force_, cube(x), cube(v), density_[0], settings).step;
    if (settings_.held) return dt;
    return std::min(dt, hmps::stable_step(lower_force_, partner(x), partner(v), density_[cube_size], settings).step);
  }

  void step(double dt) {
    const auto x = body_.x(), v = body_.v(), f = body_.f();
    const auto rho = hmps::scalars(density_);
    body_.unload();
    upper_force_(cube(x), cube(v), cube(f));
    if (!settings_.held) lower_force_(partner(x), partner(v), partner(f));
    hmps::kick(v, f, rho, dt);
    hold();
    body_.unload();
    const auto report = contact_.add(x, v, body_.F(), f, dt);
    lost_ += report.lost;
    contacts_ += report.contacts;
    hmps::kick(v, f, rho, dt);
    hold();
    hmps::drift(x, v, hmps::vectors(body_.carry), dt);
  }

  /// Kinetic, strain and artificial energy in J.
  [[nodiscard]] double energy() {
    const double volume = spacing * spacing * spacing;
    const auto x = body_.x();
    const auto F = body_.F();
    double sum = hmps::kinetic_energy(body_.v(), hmps::scalars(density_), volume) +
                 hmps::strain_energy(cube(F), law(settings_.stiffness), volume) +
                 hmps::artificial_energy(bonds_, cube(x), cube(F), young / 2 * settings_.stiffness, volume);
    if (!settings_.held)
      sum += hmps::strain_energy(partner(F), law(1), volume) +
             hmps::artificial_energy(lower_, partner(x), partner(F), young / 2, volume);
    return sum;
  }
  [[nodiscard]] bool sound(double speed_limit = std::numeric_limits<double>::infinity()) {
    return !hmps::find_fault(body_.x(), body_.v(), hmps::StateLimits{.speed_limit = speed_limit});
  }
  /// Whether a particle of the cube is below the wall, and not beside it.
  [[nodiscard]] bool passed() const {
    for (std::size_t i = 0; i < cube_size; ++i) {
      const Vector x = body_.position[i].template cast<double>() / spacing;
      const auto within = [&](double place) { return place > 1 - margin && place < side - 2 + margin; };
      if (x[2] < 0.5 - settings_.layers && within(x[0]) && within(x[1])) return true;
    }
    return false;
  }

  static constexpr int margin = 8;  ///< of a held wall around the cube, in particles
  static constexpr int side = 4;
  static constexpr std::size_t cube_size = 64;

 private:
  using List = hmps::LatticeBonds<S, 3>;
  using Law = hmps::Continued<hmps::MooneyRivlin<>>;
  using Force = decltype(hmps::internal_force(std::declval<const List&>(), std::declval<hmps::Elastic<Law>>(),
                                              std::declval<hmps::Artificial<double>>(),
                                              hmps::record(std::declval<hmps::MatrixView<S, 3>>())));

  static Law law(double factor) { return Law{hmps::MooneyRivlin<>::from_young(young * factor, d1 * factor)}; }
  static std::vector<Vector> points(const Settings& s) {
    auto all = lattice(side, side, side, spacing, Vector(0, 0, 1.5 * spacing));
    const int rim = s.held ? margin : 0, width = side + 2 * rim;
    for (const Vector& X :
         lattice(width, width, s.layers, spacing, Vector(-rim * spacing, -rim * spacing, -(s.layers - 1) * spacing)))
      all.push_back(X);
    return all;
  }
  [[nodiscard]] static bool is_face(std::size_t i) {
    const auto n = static_cast<std::size_t>(side);
    for (const std::size_t c : {i % n, i / n % n, i / (n * n)})
      if (c == 0 || c == n - 1) return true;
    return false;
  }
  /// The part of a view that belongs to the cube; partner() is the part of the lower body if that moves, otherwise the
  /// cube again.
  template <class View>
  [[nodiscard]] static auto cube(const View& view) {
    return view.part(0, cube_size);
  }
  template <class View>
  [[nodiscard]] auto partner(const View& view) const {
    return settings_.held ? cube(view) : view.part(cube_size, view.size() - cube_size);
  }
  void hold() {
    for (std::size_t i = cube_size; settings_.held && i < body_.size(); ++i) body_.velocity[i].setZero();
  }

  Settings settings_;
  Body<S> body_;
  List bonds_, lower_;
  Force upper_force_, lower_force_;
  hmps::MetaballContact<S, 3> contact_;
  std::vector<double> density_;
  std::vector<hmps::Index> skin_[2], wall_[2];
  std::size_t lost_ = 0, contacts_ = 0;
};

/// The fate of a cube thrown at a held wall; empty if it bounces off. The cube counts as broken if a speed exceeds
/// twice the speed of sound or twice that of the throw.
template <class S>
std::string thrown(int layers, double share, double speed) {
  Meeting<S> scene({.layers = layers});
  const double dt = share * std::sqrt(1 - 0.3) * scene.stable();
  for (std::size_t i = 0; i < Meeting<S>::cube_size; ++i) scene.body().velocity[i][2] = static_cast<S>(-speed);
  const double limit = 2 * std::max(speed, hmps::sound_speed(tissue, density));
  const auto steps = std::min(static_cast<int>((0.005 + 8 * spacing / speed) / dt), 4000);
  for (int step = 0; step < steps; ++step) {
    try {
      scene.step(dt);
    } catch (const hmps::StateError&) {
      return "breaks up";
    }
    if (!scene.sound(limit)) return "breaks up";
    if (scene.lost() > 0) return "is reported";
    if (scene.passed()) return "passes unreported";
  }
  return "";
}

/// A cube that falls on another at 1 m/s and, with friction, 1 m/s along it: the largest energy during the run over
/// that at the start.
template <class S>
std::string collide(const typename Meeting<S>::Settings& settings, double sideways) {
  Meeting<S> scene(settings);
  const double dt = 0.5 * scene.stable();
  for (std::size_t i = 0; i < Meeting<S>::cube_size; ++i)
    scene.body().velocity[i] = hmps::Vector<S, 3>(static_cast<S>(sideways), 0, -1);
  const double start = scene.energy();
  double most = start;
  const double duration = 8e-3;
  const auto steps = static_cast<long>(duration / dt);
  for (long step = 1; step <= steps; ++step) {
    try {
      scene.step(dt);
    } catch (const hmps::StateError&) {
      return "breaks up after " + digits(1e3 * static_cast<double>(step) * dt) + " ms";
    }
    if (!scene.sound()) return "NaN after " + digits(1e3 * static_cast<double>(step) * dt) + " ms";
    if (step % std::max(steps / 400, 1L) == 0) most = std::max(most, scene.energy());
  }
  return scene.contacts() > 0 ? places(most / start, 3) : "no contact";
}

}  // namespace
}  // namespace contact_detail

Table impact(bool quick) {
  Table table{"impact",
              {"Layers of the wall", "Step / stable", "Double: lowest speed that fails, m/s", "How",
               "Float: lowest speed that fails, m/s", "How"}};
  for (const int layers : quick ? std::vector<int>{2} : std::vector<int>{1, 2, 3, 4})
    for (const double share : quick ? std::vector<double>{0.5} : std::vector<double>{0.1, 0.25, 0.5, 0.9}) {
      std::vector<std::string> row{std::to_string(layers), digits(share)};
      const auto sweep = [&](auto s) {
        const double last = quick ? 1.1 : 200;
        std::string how;
        double speed = 1;
        for (; speed < last; speed *= std::sqrt(2.0)) {
          how = contact_detail::thrown<decltype(s)>(layers, share, speed);
          if (!how.empty()) break;
        }
        row.push_back(how.empty() ? "survives " + digits(speed / std::sqrt(2.0)) : digits(speed));
        row.push_back(how.empty() ? "-" : how);
        table.check(how != "passes unreported", "a cube at " + digits(speed) + " m/s passes a wall of " +
                                                    std::to_string(layers) + " layers unreported");
        if (quick) table.check(how.empty(), "a cube at 1 m/s on a wall of two layers " + how);
      };
      sweep(double{});
      sweep(float{});
      table.rows.push_back(row);
    }
  return table;
}

Table partners(bool quick) {
  using namespace contact_detail;
  Table table{"partners",
              {"Cube over its partner", "Value", "Density used by contact", "Energy, double", "Energy, float"}};
  const auto add = [&](const std::string& name, double value, const std::string& rho, double heavy, double stiff,
                       double contact_density, double friction, double sideways) {
    const auto settings = [&](auto s) {
      return typename Meeting<decltype(s)>::Settings{.layers = 4,
                                                     .held = false,
                                                     .friction = friction,
                                                     .stiffness = stiff,
                                                     .heaviness = heavy,
                                                     .contact_density = contact_density};
    };
    table.rows.push_back({name, digits(value), rho, collide<double>(settings(double{}), sideways),
                          collide<float>(settings(float{}), sideways)});
  };
  const std::vector<double> ratios =
      quick ? std::vector<double>{1} : std::vector<double>{1e-3, 1e-2, 0.1, 1, 10, 100, 1e3};
  for (const double r : ratios) {
    add("mass", r, "of the lighter", r, 1, density * std::min(r, 1.0), 0, 0);
    if (r != 1) add("mass", r, "of the heavier", r, 1, density * std::max(r, 1.0), 0, 0);
  }
  for (const double r : ratios) add("stiffness", r, "of both", 1, r, density, 0, 0);
  for (const double mu : quick ? std::vector<double>{0.3} : std::vector<double>{0, 0.1, 0.3, 1, 3, 10})
    add("friction coefficient", mu, "of both", 1, 1, density, mu, 1);
  return table;
}

}  // namespace stability
