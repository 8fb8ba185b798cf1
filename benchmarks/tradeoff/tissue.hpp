// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <hmps/hmps.hpp>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "common/error.hpp"
#include "scenes/fitted_body.hpp"
#include "tradeoff/scene.hpp"

namespace tradeoff {

/// The parameter of all scenes that says how a body is filled with particles.
[[nodiscard]] inline Parameter particles_parameter() {
  return {.name = "particles", .values = {"lattice", "fitted"}, .standard = "lattice"};
}

/// Whether the settings ask for fitted particles. Throws `InputError` if they do and one of the settings `fixed`, which
/// such particles do not support or which `thin_wall_stabiliser` chooses, has another value.
[[nodiscard]] inline bool asks_for_fitted(const Settings& settings, const Settings& fixed) {
  if (settings.word("particles") != "fitted") return false;
  for (const auto& [name, value] : fixed)
    examples::require(settings.at(name) == value, "tradeoff: the parameter ", name,
                      " cannot be varied with fitted particles; leave it at its standard");
  return true;
}

/// A bar along x of `held` particles, which come first, and others that move; see `scenes::FittedBar`. On a lattice
/// only the positions of `fit` are filled in.
using Bar = scenes::FittedBar;

/// A bar of `size` (m) on a lattice; its clamped face lies half a spacing in front of the `layers` layers that are
/// held.
[[nodiscard]] inline Bar bar_on_lattice(const hmps::Vector<double, 3>& size, double spacing, double layers) {
  using Vector = hmps::Vector<double, 3>;
  const hmps::Box<double, 3> box{Vector(-layers * spacing, 0, 0), size};
  Bar bar;
  bar.fit.positions = hmps::fill_lattice(box, box, spacing, Vector::Constant(spacing / 2));
  for (const Vector& place : bar.fit.positions) bar.held += place[0] < 0 ? 1 : 0;
  return bar;
}

template <class K, class Law>
[[nodiscard]] auto tissue_force(const hmps::LatticeBonds<K, 3>& bonds, const Law& law,
                                const hmps::ThinWallStabiliser<double>& chosen) {
  return hmps::internal_force(bonds, hmps::elastic(law), hmps::artificial(chosen.moduli.front()));
}
template <class K, class Law>
[[nodiscard]] auto tissue_force(const hmps::BondList<K, 3>& bonds, const Law& law,
                                const hmps::ThinWallStabiliser<double>& chosen) {
  return scenes::thin_wall_force(bonds, law, chosen);
}

/// The bonds, forces and energies of a body. On a lattice each particle stands for the cube of the spacing and has the
/// same E_hat; fitted particles stand for their own volumes and are stabilised by `thin_wall_stabiliser`. `K` is the
/// scalar of the kernels.
template <class K, class Law, bool fitted>
class Tissue {
 public:
  using Bonds = std::conditional_t<fitted, hmps::BondList<K, 3>, hmps::LatticeBonds<K, 3>>;

  /// With particles at `x` (m) that are at rest there; `modulus` is E_hat in Pa on a lattice. Takes everything but the
  /// positions away from `fit`, so that nothing is held twice.
  template <class X>
  Tissue(scenes::Fit& fit, const X& x, const Law& law, double modulus, const hmps::BondSettings& settings)
      : cube_(settings.spacing * settings.spacing * settings.spacing),
        volumes_(std::move(fit.volumes)),
        law_(law),
        chosen_(choose(fit, law, modulus, settings.spacing)),
        bonds_(bonds_of(x, settings, volumes_)),
        force_(tissue_force(bonds_, law_, chosen_)) {
    fit.layers = std::vector<int>();
    fit.layer_spacings = std::vector<double>();
  }
  Tissue(const Tissue&) = delete;
  Tissue& operator=(const Tissue&) = delete;

  [[nodiscard]] auto& force() { return force_; }
  /// Of a particle in m3: a number or a view.
  [[nodiscard]] auto volume() const {
    if constexpr (fitted)
      return hmps::scalars(volumes_);
    else
      return cube_;
  }
  /// Volume of a particle over the cube of the spacing.
  [[nodiscard]] double share(std::size_t i) const { return fitted ? volumes_[i] / cube_ : 1; }
  /// The energy in J at positions `x` (m); the deformation gradients there go to `F`.
  template <class X, class M>
  [[nodiscard]] double stored_energy(const X& x, const M& F) const {
    hmps::deformation_gradient(bonds_, x, F);
    if constexpr (fitted)
      return hmps::strain_energy(F, scenes::with_bulk(law_, chosen_.bulk.law), volume()) +
             hmps::artificial_energy(bonds_, x, F, hmps::scalars(chosen_.moduli), volume()) +
             hmps::mean_dilatation_energy<2>(bonds_, F, chosen_.bulk.mean, volume());
    else
      return hmps::strain_energy(F, law_, volume()) +
             hmps::artificial_energy(bonds_, x, F, chosen_.moduli.front(), volume());
  }

 private:
  using Chosen = hmps::ThinWallStabiliser<double>;

  static Chosen choose(const scenes::Fit& fit, const Law& law, double modulus, double spacing) {
    if constexpr (fitted)
      return scenes::stabiliser_of(fit, spacing, law);
    else
      return {{modulus}, {law.bulk_modulus(), 0}};
  }
  template <class X>
  static Bonds bonds_of(const X& x, const hmps::BondSettings& settings, const std::vector<double>& volumes) {
    if constexpr (fitted)
      return Bonds(x, settings, hmps::scalars(volumes));
    else
      return Bonds(x, settings);
  }

  double cube_;
  std::vector<double> volumes_;
  Law law_;
  Chosen chosen_;
  Bonds bonds_;
  decltype(tissue_force(std::declval<const Bonds&>(), std::declval<const Law&>(),
                        std::declval<const Chosen&>())) force_;
};

}  // namespace tradeoff
