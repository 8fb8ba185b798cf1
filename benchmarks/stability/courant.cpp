// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "stability/body.hpp"
#include "stability/groups.hpp"
#include "stability/sheet.hpp"

namespace stability {
namespace courant_detail {
namespace {

/// Pseudo-random number in (-1, 1), a function of `number` alone (splitmix64).
double noise_of(std::uint64_t number) {
  number += 0x9e3779b97f4a7c15u;
  number = (number ^ (number >> 30)) * 0xbf58476d1ce4e5b9u;
  number = (number ^ (number >> 27)) * 0x94d049bb133111ebu;
  number ^= number >> 31;
  return (static_cast<double>(number >> 11) + 0.5) * 0x1.0p-52 - 1.0;
}

/// Whether noise in the velocities grows by changing its sign at each step. Motion that grows without changing its sign
/// is physical, such as buckling. With contact all motion must stay so small that no face opens, and the first motion
/// that has grown decides, because other motions also grow there.
template <class S>
bool alternates(Sheet<S>& scene, double dt) {
  constexpr bool single = std::is_same_v<S, float>;
  const double noise = single ? 1e-3 : 1e-9, most = noise * (single ? 300 : scene.touches() ? 1e4 : 1e5);
  const int steps = 1500, every = scene.touches() ? 1 : 20;
  Body<S>& body = scene.body();
  const auto start = body.position;
  const auto restore = [&] {
    body.position = start;
    hmps::set_zero(body.v());
    hmps::set_zero(hmps::vectors(body.carry));
  };
  restore();
  scene(body.x(), body.v(), body.f());
  const auto dead = body.load;  // the force at the start
  for (std::size_t i = 0; i < body.size() && scene.moves(i); ++i)
    for (int c = 0; c < 3; ++c)
      body.velocity[i][c] = static_cast<S>(noise * noise_of(3 * i + static_cast<std::uint64_t>(c)));
  auto before = body.velocity;
  bool found = false;
  for (int step = 1; step <= steps && !found; ++step) {
    scene(body.x(), body.v(), body.f());
    for (std::size_t i = 0; i < body.size(); ++i) {
      body.load[i] -= dead[i];
      if (!scene.moves(i)) body.load[i].setZero();
    }
    if (step % every == 0) before = body.velocity;
    hmps::kick(body.v(), body.f(), density, dt);
    hmps::drift(body.x(), body.v(), hmps::vectors(body.carry), dt);
    if (step % every != 0) continue;
    double fastest = 0, product = 0, squares = 0;
    for (std::size_t i = 0; i < body.size(); ++i) {
      const auto speed = static_cast<double>(body.velocity[i].norm());
      fastest = std::isfinite(speed) ? std::max(fastest, speed) : 1e300;
      product += static_cast<double>(body.velocity[i].dot(before[i]));
      squares += static_cast<double>(body.velocity[i].norm() * before[i].norm());
    }
    if (fastest > most) found = !std::isfinite(squares) || product < -0.8 * squares;
    if (fastest > (scene.touches() ? 1 : single ? 3 : 1000) * most) break;  // no longer a small motion
  }
  restore();
  return found;
}

/// The largest step at which the run is stable, to 0.2 %.
template <class S>
double measured(Sheet<S>& scene, double guess) {
  const auto held = [&](double dt) { return !alternates(scene, dt); };
  double low = 0.8 * guess, high = 1.2 * guess;
  while (!held(low)) high = low, low *= 0.8;
  while (held(high)) low = high, high *= 1.2;
  while (high / low > 1.002) {
    const double middle = std::sqrt(low * high);
    (held(middle) ? low : high) = middle;
  }
  return low;
}

/// The results for one case in one scalar type.
struct Found {
  double measured, step, limit;
  int evaluations;
  std::string cause;
  double support, sound;
};
template <class S>
Found find(const Case& c) {
  Sheet<S> scene(c);
  hmps::StableStepSettings settings{.spacing = spacing};
  settings.moves = [&scene](std::size_t i) { return scene.moves(i); };
  if (c.penalty > 0) settings.perturbation = 1e-6;  // much less than the penetration
  const auto found = hmps::stable_step(scene, scene.body().x(), scene.body().v(), density, settings);
  std::string text;
  for (const auto& cause : scene.causes(found, settings))
    if (std::abs(cause.share) > 0.005)
      text += (text.empty() ? "" : ", ") + cause.name + " " + places(100 * cause.share, 0) + " %";
  return {measured(scene, found.limit),
          found.step,
          found.limit,
          found.evaluations,
          text,
          hmps::relative_support(scene.bonds(), found.particle),
          scene.sound()};
}

std::vector<Case> cases(bool quick) {
  if (quick)
    return {{.group = "layers", .name = "2", .layers = 2},
            {.group = "layers", .name = "4", .layers = 4},
            {.group = "viscosity", .name = "0.02 m2/s", .layers = 3, .viscosity = 0.02}};
  std::vector<Case> all;
  for (const int n : {2, 3, 4, 8}) all.push_back({.group = "layers", .name = std::to_string(n), .layers = n});
  for (const double r : {1.5, 2.1, 2.5}) all.push_back({.group = "r_e / l0", .name = digits(r), .radius = r});
  for (const double e : {0.0, 0.5, 2.0}) all.push_back({.group = "E_hat / E", .name = digits(e), .modulus = e});
  for (const double k : {3.0, 30.0, 3000.0}) all.push_back({.group = "kappa / mu", .name = digits(k), .ratio = k});
  for (const double s : {0.3, 0.5, 0.7, 1.5, 2.0, 3.0, 5.0})
    all.push_back({.group = "stretch", .name = digits(s), .layers = 4, .stretch = s});
  for (const double nu : {2e-3, 0.02, 0.1})
    all.push_back({.group = "viscosity", .name = digits(nu) + " m2/s", .viscosity = nu});
  return all;
}

}  // namespace
}  // namespace courant_detail

Table courant(bool quick, std::vector<Ratio>& ratios) {
  using namespace courant_detail;
  Table table{"courant",
              {"Scene", "Value", "Largest step, l0 / c_p", "Step / largest, double", "Limit / largest, double",
               "Step / largest, float", "Support", "Cause", "Evaluations"}};
  double dt_c = 0, thin_dt_c = 0;
  const auto add = [&](const Case& c) {
    // Contact with a penetration of a hundred-thousandth of a spacing is beyond the precision of float.
    const bool both = c.penalty == 0;
    const Found d = find<double>(c), f = both ? find<float>(c) : d;
    table.rows.push_back({c.group, c.name, places(d.measured * d.sound / spacing), places(d.step / d.measured),
                          places(d.limit / d.measured), both ? places(f.step / f.measured) : "-", places(d.support, 2),
                          d.cause, std::to_string(d.evaluations)});
    for (const auto& [found, scalar] : {std::pair(d, "double"), std::pair(f, "float")}) {
      const std::string scene = c.group + " " + c.name;
      if (!both && scalar != std::string("double")) continue;
      ratios.push_back({scene + ", " + scalar, found.step / found.measured, found.limit / found.measured});
      // The measured limit is a lower bound, to 0.2 %.
      table.check(found.step < 1.002 * found.measured, scene + " in " + scalar + ": the step is above the limit");
      table.check(found.step > 0.9 * found.measured, scene + " in " + scalar + ": the step is 10 % below the limit");
    }
    return d;
  };
  for (const Case& c : cases(quick)) {
    const Found d = add(c);
    // The bodies in contact have the same thickness.
    if (c.group == "layers" && c.layers == 4) dt_c = d.measured;
    if (c.group == "layers" && c.layers == 2) thin_dt_c = d.measured;
  }
  for (const double k : quick ? std::vector<double>{1} : std::vector<double>{0.1, 0.3, 1, 3, 10}) {
    const Case c{.group = "contact, k dt_c^2 / rho", .name = digits(k), .layers = 4, .penalty = k, .dt_c = dt_c};
    const Found d = add(c);
    // dt = dt_c sqrt(1 - k~) with k~ = k dt^2 / rho: solved for dt.
    table.rows.push_back({"by dt_c sqrt(1 - k~)", digits(k), places(dt_c / std::sqrt(1 + k) * d.sound / spacing), "",
                          "", "", "", "rule / largest: " + places(dt_c / std::sqrt(1 + k) / d.measured), ""});
  }
  for (const double k : quick ? std::vector<double>{} : std::vector<double>{1, 10}) {
    const std::string name = digits(k);
    add({.group = "on a held body, k dt_c^2 / rho",
         .name = name,
         .layers = 4,
         .penalty = k,
         .dt_c = dt_c,
         .held = true});
    add({.group = "of 2 layers each, k dt_c^2 / rho", .name = name, .layers = 2, .penalty = k, .dt_c = thin_dt_c});
  }
  return table;
}

Table refresh(bool quick) {
  Table table{
      "refresh",
      {"Stretch", "Step of a new search, us", "Evaluations", "Step of a refresh, us", "Evaluations", "Refresh / new"}};
  const int count = quick ? 5 : 20;
  hmps::StableStep kept;
  for (int k = 0; k <= count; ++k) {
    const double stretch = 1 + 2.0 * k / count;
    Sheet<double> scene({.layers = 4, .stretch = stretch});
    hmps::StableStepSettings settings{.spacing = spacing};
    const auto search = [&] { return hmps::stable_step(scene, scene.body().x(), scene.body().v(), density, settings); };
    const auto fresh = search();
    if (k == 0) {
      kept = fresh;
      continue;
    }
    const std::vector<double> mode = kept.mode;
    settings.start = mode;
    settings.seed = static_cast<std::uint64_t>(k + 1);
    kept = search();
    table.rows.push_back({digits(stretch), digits(1e6 * fresh.step), std::to_string(fresh.evaluations),
                          digits(1e6 * kept.step), std::to_string(kept.evaluations), places(kept.step / fresh.step)});
    table.check(kept.step < fresh.limit, "the refreshed step exceeds the limit at stretch " + digits(stretch));
    table.check(2 * kept.evaluations < fresh.evaluations,
                "a refresh costs half a search at stretch " + digits(stretch));
  }
  return table;
}

}  // namespace stability
