// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <hmps/hmps.hpp>
#include <string>
#include <utility>
#include <vector>

#include "scenes/body.hpp"

/// The variants of the method that are compared, and the body that they act on.
namespace verification {

/// A variant of the method. To add one, add a line to `methods`, and a branch to `with_force` if it uses other terms.
struct Method {
  std::string name;
  double over_shear = 0;         ///< E_hat over the shear modulus; 0: the paper's choice, Young's modulus
  int held = 1;                  ///< layers of held particles beyond a fixed face
  bool mean_dilatation = false;  ///< whether the bulk modulus is split by `split_bulk_modulus`
  double tension = 0;            ///< modulus of the artificial tension over the shear modulus
};

inline const Method paper{.name = "E_hat = E"};
inline const Method shear_wave{.name = "E_hat = 4/3 mu", .over_shear = hmps::shear_wave_modulus(1.0)};
inline const Method two_layers{
    .name = "E_hat = 4/3 mu, two layers held", .over_shear = hmps::shear_wave_modulus(1.0), .held = 2};
inline const Method mean_dilatation{
    .name = "E_hat = 4/3 mu, mean dilatation", .over_shear = hmps::shear_wave_modulus(1.0), .mean_dilatation = true};
inline const Method soft{.name = "E_hat = mu, mean dilatation", .over_shear = 1, .mean_dilatation = true};
inline const Method bar{.name = "bar_stabiliser",
                        .over_shear = hmps::bar_stabiliser(1.0).modulus,
                        .tension = hmps::bar_stabiliser(1.0).tension};
inline const Method bar_mean_dilatation{.name = "bar_stabiliser, mean dilatation",
                                        .over_shear = bar.over_shear,
                                        .mean_dilatation = true,
                                        .tension = bar.tension};
/// The variants that differ from each other in a problem, which depends on whether a face is fixed and whether the bulk
/// modulus is high.
inline const std::vector<Method> methods{paper, shear_wave};
inline const std::vector<Method> clamped_methods{paper, shear_wave, two_layers};
inline const std::vector<Method> bulky_methods{paper, shear_wave, mean_dilatation};
inline const std::vector<Method> all_methods{paper, shear_wave, two_layers, mean_dilatation};

/// Young's modulus of a law at zero strain.
template <class Law>
[[nodiscard]] double young_of(const Law& law) {
  const double bulk = law.bulk_modulus(), shear = law.shear_modulus();
  return 9 * bulk * shear / (3 * bulk + shear);
}

/// E_hat of a method for a law.
template <class Law>
[[nodiscard]] double modulus_of(const Method& method, const Law& law) {
  return method.over_shear > 0 ? method.over_shear * law.shear_modulus() : young_of(law);
}

using scenes::Body;

/// Particles at the centres of the cells of a cubic lattice that fill [0, n0 l0] x [0, n1 l0] (x ...), with `below` and
/// `above` more layers along the first axis.
template <int D>
[[nodiscard]] std::vector<hmps::Vector<double, D>> cells(double l0, const std::array<int, D>& n, int below = 0,
                                                         int above = 0) {
  hmps::Vector<double, D> lower = hmps::Vector<double, D>::Zero(), upper;
  for (std::size_t c = 0; c < D; ++c) upper[static_cast<int>(c)] = l0 * n[c];
  lower[0] = -l0 * below;
  upper[0] += l0 * above;
  const hmps::Box<double, D> box{lower, upper};
  return hmps::fill_lattice(box, box, l0, hmps::Vector<double, D>(hmps::Vector<double, D>::Constant(l0 / 2)));
}

/// The law with another bulk modulus, for laws whose volumetric energy is that of `hmps::mean_dilatation`, K (J - 1)^2
/// / 2.
[[nodiscard]] inline hmps::MooneyRivlin<> with_bulk_modulus(hmps::MooneyRivlin<> law, double bulk) {
  law.d1 = bulk / 2;
  return law;
}
[[nodiscard]] inline hmps::NeoHookean<> with_bulk_modulus(hmps::NeoHookean<> law, double bulk) {
  law.kappa = bulk;
  return law;
}

/// Calls `use(force)` with the internal force by `method` of the particles that `bonds` connects; the force writes
/// their deformation gradients to `F`.
template <hmps::Bonds B, class Law, class Use>
decltype(auto) with_force(const Method& method, const hmps::MatrixView<double, B::dimension>& F, const B& bonds,
                          const Law& law, Use&& use) {
  const auto stabilised = [&](const auto&... elasticity) -> decltype(auto) {
    const auto artificial = hmps::artificial(modulus_of(method, law));
    if (method.tension > 0) {
      const auto tension = hmps::artificial_tension(method.tension * law.shear_modulus());
      auto force = hmps::internal_force(bonds, elasticity..., artificial, tension, hmps::record(F));
      return std::forward<Use>(use)(force);
    }
    auto force = hmps::internal_force(bonds, elasticity..., artificial, hmps::record(F));
    return std::forward<Use>(use)(force);
  };
  if constexpr (requires { with_bulk_modulus(law, 1.0); }) {
    if (method.mean_dilatation) {
      const auto share = hmps::split_bulk_modulus(law.bulk_modulus(), law.shear_modulus());
      return stabilised(hmps::elastic(with_bulk_modulus(law, share.law)), hmps::mean_dilatation(share.mean));
    }
  }
  return stabilised(hmps::elastic(law));
}

/// Brings the particles of `body` for which `moves(i)` holds to rest under `force(x, v, f)`, until the unbalanced
/// forces are `tolerance` times `load` (N, in two dimensions N/m; 0: the force that the other particles carry).
template <int D, class Force, class Moves>
hmps::Relaxation settle(Body<D>& body, Force&& force, Moves&& moves, double load, double tolerance) {
  constexpr double density = 1000;  // has no effect in statics
  return hmps::relax(force, body.x(), body.v(), body.f(), density,
                     {.spacing = body.spacing, .tolerance = tolerance, .load = load, .moves = moves});
}

}  // namespace verification
