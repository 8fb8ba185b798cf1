// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <hmps/bonds/bond_list.hpp>
#include <hmps/contact/contact.hpp>
#include <hmps/force/deformation_gradient.hpp>
#include <hmps/force/internal_force.hpp>
#include <hmps/laws/mooney_rivlin.hpp>
#include <hmps/search/nearest_spacing.hpp>
#include <hmps/terms/artificial.hpp>
#include <hmps/terms/elastic.hpp>
#include <map>
#include <numeric>
#include <string>
#include <type_traits>
#include <vector>

#include "../common/error.hpp"

/// Computes the paper's forces for a given state, for comparison with another code.
namespace force_probe {

using Vector = std::array<double, 3>;

/// Particles as another code sees them: one element per particle in each array.
struct State {
  std::vector<Vector> reference;  ///< m
  std::vector<Vector> position;   ///< m
  std::vector<Vector> velocity;   ///< m/s
  std::vector<int> body;          ///< bonds join particles of one body, contact parts those of different ones
};

struct Settings {
  double spacing = 1.2e-3;      ///< l0 in m
  double young = 20e3;          ///< Pa, \paper{18}
  double young_hat = 20e3;      ///< Pa, \paper{20}
  double d1 = 1e6;              ///< Pa, \paper{15}
  double density = 1000;        ///< kg/m3
  double viscosity = 2e-3;      ///< m2/s, \paper{21}
  double friction = 0.1;        ///< \paper{23}
  double penalty_ratio = 0.3;   ///< \paper{25}
  double time_step = 1e-5;      ///< s, for \paper{23, 25}
  bool paper_friction = false;  ///< the cap of \paper{40} as printed, instead of the corrected one
};

/// Force densities in N/m3 and det F, per particle.
struct Forces {
  std::vector<Vector> elastic, artificial, viscous, contact;
  std::vector<double> J;
};

/// \paper{21} with the n0 and lambda of a particle inside the simple cubic lattice of `spacing`,
/// also where the bodies are too small or too thin to have one.
struct LatticeViscosity {
  Settings settings;

  template <class K>
  [[nodiscard]] double damping(const hmps::Blocks<K, 3>&) const {
    const double radius = hmps::paper_radius_ratio;
    double lambda_n0 = 0;  // in squared spacings
    for (int i = -1; i <= 1; ++i)
      for (int j = -1; j <= 1; ++j)
        for (int k = -1; k <= 1; ++k) {
          const double r = std::sqrt(i * i + j * j + k * k);
          const double w = hmps::PaperWeight{}(r, radius);
          lambda_n0 += r * r * w;
        }
    return settings.density * settings.viscosity * 2 * 3 / (lambda_n0 * settings.spacing * settings.spacing);
  }
};

/// Contact of all bodies with each other, \paper{22} to \paper{43}: every particle is slave and master.
template <class S, class Friction>
void add_contact(const State& state, const Settings& settings, const hmps::MatrixView<S, 3>& F,
                 const hmps::VectorView<double, 3>& f) {
  std::map<int, std::vector<hmps::Index>> bodies;
  for (std::size_t i = 0; i < state.body.size(); ++i) bodies[state.body[i]].push_back(static_cast<hmps::Index>(i));
  hmps::MetaballContact<S, 3, hmps::PaperMetaball, Friction> contact(
      {.spacing = settings.spacing,
       .density = settings.density,
       .friction = settings.friction,
       .stiffness = hmps::PenaltyStiffness::ratio(settings.penalty_ratio)});
  std::vector<std::size_t> organs;
  for (const auto& [body, particles] : bodies)
    organs.push_back(
        contact.add_organ({.name = "body " + std::to_string(body), .slaves = particles, .masters = particles}));
  for (std::size_t a = 0; a < organs.size(); ++a)
    for (std::size_t b = a + 1; b < organs.size(); ++b) contact.add_pair(organs[a], organs[b]);
  contact.add(hmps::vectors(state.position), hmps::vectors(state.velocity), F, f, settings.time_step);
}

/// Throws `InputError` unless all forces are finite numbers. `remedy`: what else helps.
inline void require_numbers(const Forces& forces, const char* remedy) {
  const auto check = [&](const char* name, const std::vector<Vector>& force) {
    for (std::size_t i = 0; i < force.size(); ++i)
      for (const double component : force[i])
        examples::require(
            std::isfinite(component), "the ", name, " force on particle ", i, " is (", force[i][0], ' ', force[i][1],
            ' ', force[i][2],
            ") N/m3: numbers on the way to it are too large; give smaller moduli, densities, viscosities or "
            "velocities",
            remedy);
  };
  check("elastic", forces.elastic);
  check("artificial", forces.artificial);
  check("viscous", forces.viscous);
  check("contact", forces.contact);
}

/// The forces on `state`, evaluated in the scalar type `S`. All of them, contact too, are those at
/// the given velocities: for the contact of \paper{3} pass v* of \paper{2}. Throws `InputError`
/// for a state that has none, such as an inverted particle, and for forces that are not finite.
template <class S>
[[nodiscard]] Forces probe(const State& state, const Settings& settings) {
  const std::size_t size = state.reference.size();
  const auto x = hmps::vectors(state.position);
  const auto v = hmps::vectors(state.velocity);
  hmps::require_finite(hmps::vectors(state.reference), "the reference positions");
  const double nearest = hmps::nearest_spacing(hmps::vectors(state.reference));
  examples::require(nearest == 0 || (settings.spacing < 2 * nearest && settings.spacing > nearest / 2),
                    "the spacing is ", settings.spacing, " m, but the nearest neighbours of the reference lie ",
                    nearest, " m apart; give the spacing of the particles in metres");
  hmps::require_finite(x, "the positions");
  hmps::require_finite(v, "the velocities");
  const hmps::BondList<S, 3> bonds(hmps::vectors(state.reference), {.spacing = settings.spacing},
                                   [&](std::size_t i, std::size_t j) { return state.body[i] == state.body[j]; });

  Forces forces;
  for (auto* force : {&forces.elastic, &forces.artificial, &forces.viscous, &forces.contact})
    force->resize(size, Vector{});
  std::vector<std::array<S, 9>> gradients(size);
  const auto F = hmps::matrices(gradients);
  hmps::deformation_gradient(bonds, x, F);
  for (std::size_t i = 0; i < size; ++i) {
    forces.J.push_back(static_cast<double>(F[i].determinant()));
    examples::require(forces.J[i] > 0, "particle ", i, " is turned inside out: det F = ", forces.J[i],
                      "; the law is defined for positive values only, so give a state that is less deformed");
  }
  const auto law = hmps::MooneyRivlin<S>::from_young(static_cast<S>(settings.young), static_cast<S>(settings.d1));
  hmps::internal_force(bonds, hmps::elastic(law))(x, hmps::vectors(forces.elastic));
  hmps::internal_force(bonds, hmps::artificial(static_cast<S>(settings.young_hat)))(x,
                                                                                    hmps::vectors(forces.artificial));
  hmps::internal_force(bonds, LatticeViscosity{settings})(x, v, hmps::vectors(forces.viscous));
  if (settings.paper_friction) {
    add_contact<S, hmps::PaperFriction>(state, settings, F, hmps::vectors(forces.contact));
  } else {
    add_contact<S, hmps::CorrectedFriction>(state, settings, F, hmps::vectors(forces.contact));
  }
  require_numbers(forces, std::is_same_v<S, float> ? ", or --scalar double" : "");
  return forces;
}

}  // namespace force_probe
