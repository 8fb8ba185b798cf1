// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <hmps/analysis/stable_step.hpp>
#include <hmps/analysis/step_causes.hpp>
#include <hmps/bonds/bond_list.hpp>
#include <hmps/bonds/lattice_bonds.hpp>
#include <hmps/core/view.hpp>
#include <hmps/diagnostics/energy.hpp>
#include <hmps/executors/openmp.hpp>
#include <hmps/force/internal_force.hpp>
#include <hmps/laws/mooney_rivlin.hpp>
#include <hmps/terms/artificial.hpp>
#include <hmps/terms/elastic.hpp>
#include <hmps/terms/mean_dilatation.hpp>
#include <hmps/terms/record.hpp>
#include <hmps/terms/thin_wall_stabiliser.hpp>
#include <hmps/terms/viscous.hpp>
#include <type_traits>
#include <utility>
#include <vector>

#include "scene/materials.hpp"
#include "scene/scene.hpp"
#include "simulation/soft_tissue.hpp"

namespace swallowing {

/// The parameters of each particle of the body that the forces read.
template <class S>
struct TissueParameters {
  std::vector<S> young, artificial;        ///< Pa: Young's modulus and E_hat
  std::vector<S> law_d1, mean_dilatation;  ///< Pa: D1 of the law, bulk modulus of the mean dilatation; if fitted

  TissueParameters(const Scene& scene, const Materials& materials) {
    for (std::size_t i = 0; i < scene.elastic_count; ++i)
      young.push_back(static_cast<S>(materials.young_of(scene.organ[i])));
    if (!scene.layers.empty()) choose_for_walls(scene, materials);
  }

 private:
  /// Chooses E_hat and the share of the bulk modulus that the law keeps, for each material by its own walls.
  void choose_for_walls(const Scene& scene, const Materials& materials) {
    const std::size_t n = scene.elastic_count;
    artificial.resize(n), law_d1.resize(n), mean_dilatation.resize(n);
    for (const Organ organ : {Organ::epiglottis, Organ::tongue}) {
      const double modulus = materials.young_of(organ);
      std::vector<std::size_t> members;
      std::vector<int> layers;
      std::vector<double> apart;
      for (std::size_t i = 0; i < n; ++i)
        if (materials.young_of(scene.organ[i]) == modulus)
          members.push_back(i), layers.push_back(scene.layers[i]), apart.push_back(scene.layer_spacings[i]);
      const auto law = materials.law(organ);
      const auto chosen =
          hmps::thin_wall_stabiliser(layers, apart, scene.spacing, law.bulk_modulus(), law.shear_modulus());
      for (std::size_t k = 0; k < members.size(); ++k) {
        artificial[members[k]] = static_cast<S>(chosen.moduli[k]);
        law_d1[members[k]] = static_cast<S>(chosen.bulk.law / 2);
        mean_dilatation[members[k]] = static_cast<S>(chosen.bulk.mean);
      }
    }
  }
};

namespace detail {

template <class Bonds>
inline constexpr bool on_lattice = false;
template <class S>
inline constexpr bool on_lattice<hmps::LatticeBonds<S, 3>> = true;

/// The law of each particle: C1 = C2 from its Young's modulus by \paper{18}.
template <class Bonds, class S>
[[nodiscard]] auto law(const TissueParameters<S>& parameters, const Materials& materials) {
  const auto young = hmps::scalars(parameters.young);
  if constexpr (on_lattice<Bonds>) {
    return [young, d1 = materials.d1](const auto& at) {
      const auto modulus = at(young);
      using T = std::remove_const_t<decltype(modulus)>;
      return hmps::MooneyRivlin<T>::from_young(modulus, T(d1));
    };
  } else {
    return [young, law_d1 = hmps::scalars(parameters.law_d1)](const auto& at) {
      const auto modulus = at(young);
      using T = std::remove_const_t<decltype(modulus)>;
      return hmps::MooneyRivlin<T>::from_young(modulus, at(law_d1));
    };
  }
}

/// E_hat of each particle.
template <class Bonds, class S>
[[nodiscard]] auto stabiliser(const TissueParameters<S>& parameters, const Materials& materials) {
  if constexpr (on_lattice<Bonds>) {
    return [young = hmps::scalars(parameters.young), ratio = S(materials.stabiliser_ratio)](const auto& at) {
      return at(young) * ratio;
    };
  } else {
    return [moduli = hmps::scalars(parameters.artificial)](const auto& at) { return at(moduli); };
  }
}

/// The mean dilatation of fitted particles.
template <class S>
[[nodiscard]] auto mean_dilatation(const TissueParameters<S>& parameters) {
  return hmps::mean_dilatation<2>(
      [bulk = hmps::scalars(parameters.mean_dilatation)](const auto& at) { return at(bulk); });
}

/// All internal forces of the body; F goes to `gradients`.
template <class S, class Bonds>
[[nodiscard]] auto tissue_force(const Bonds& bonds, const TissueParameters<S>& parameters, const Materials& materials,
                                const hmps::MatrixView<S, 3>& gradients) {
  const auto elastic = hmps::elastic(law<Bonds>(parameters, materials));
  const auto artificial = hmps::artificial(stabiliser<Bonds>(parameters, materials));
  const auto viscous = hmps::viscous(materials.density, materials.kinematic_viscosity);
  if constexpr (on_lattice<Bonds>)
    return hmps::internal_force(bonds, hmps::record(gradients), elastic, artificial, viscous);
  else
    return hmps::internal_force(bonds, hmps::record(gradients), elastic, mean_dilatation(parameters), artificial,
                                viscous);
}

/// The tissue on bonds of one kind: a lattice, with the paper's terms, or a list of fitted particles, with the choices
/// for thin walls.
template <class S, class Bonds>
class TissueOn final : public SoftTissue<S> {
 public:
  using typename SoftTissue<S>::Places;
  using typename SoftTissue<S>::Velocities;
  using typename SoftTissue<S>::Gradients;

  TissueOn(const Scene& scene, const Materials& materials, const Gradients& gradients, const hmps::OpenMP& execute)
      : spacing_(scene.spacing),
        materials_(materials),
        execute_(execute),
        parameters_(scene, materials),
        bonds_(hmps::vectors(scene.reference).part(0, scene.elastic_count), {.spacing = scene.spacing},
               [&scene](std::size_t i, std::size_t j) { return scene.bonded(i, j); }),
        force_(tissue_force(bonds_, parameters_, materials, gradients)) {}
  TissueOn(const TissueOn&) = delete;
  TissueOn& operator=(const TissueOn&) = delete;

  void kick(const Places& x, const Velocities& v, double dt) override {
    force_.kick(x, v, materials_.density, dt, execute_);
  }
  void restrict_to(const std::vector<char>& free) override {
    force_.restrict_to([&free](std::size_t i) { return free[i] != 0; });
  }
  [[nodiscard]] StoredEnergy stored_energy(const Places& x, const Gradients& F) const override {
    const double volume = spacing_ * spacing_ * spacing_;
    StoredEnergy stored{
        hmps::strain_energy(F, law<Bonds>(parameters_, materials_), volume, execute_),
        hmps::artificial_energy(bonds_, x, F, stabiliser<Bonds>(parameters_, materials_), volume, execute_)};
    if constexpr (!on_lattice<Bonds>)
      stored.strain +=
          hmps::mean_dilatation_energy<2>(bonds_, F, hmps::scalars(parameters_.mean_dilatation), volume, execute_);
    return stored;
  }
  [[nodiscard]] hmps::StableStep stable_step(const Places& x, const Velocities& v,
                                             const hmps::StableStepSettings& settings) override {
    return hmps::stable_step([this](const auto& at, const auto& w, const auto& f) { force_(at, w, f, execute_); }, x, v,
                             materials_.density, settings, execute_);
  }
  [[nodiscard]] std::vector<hmps::StepCause> causes(const hmps::StableStep& limit, const Places& x,
                                                    const Velocities& v) override {
    auto elasticity = hmps::internal_force(bonds_, hmps::elastic(law<Bonds>(parameters_, materials_)));
    auto artificial = hmps::internal_force(bonds_, hmps::artificial(stabiliser<Bonds>(parameters_, materials_)));
    auto viscosity = hmps::internal_force(bonds_, hmps::viscous(materials_.density, materials_.kinematic_viscosity));
    const auto of = [&](auto&&... forces) {
      return hmps::step_causes(limit, x, v, materials_.density, {.spacing = spacing_}, forces...);
    };
    const hmps::NamedForce first{"elasticity", elasticity};
    const hmps::NamedForce second{"stabiliser", artificial};
    const hmps::NamedForce third{"viscosity", viscosity};
    if constexpr (on_lattice<Bonds>) return of(first, second, third);
    auto dilatation = hmps::internal_force(bonds_, mean_dilatation(parameters_));
    return of(first, second, third, hmps::NamedForce{"mean dilatation", dilatation});
  }
  [[nodiscard]] double support(std::size_t particle) const override { return hmps::relative_support(bonds_, particle); }

 private:
  double spacing_;
  Materials materials_;
  hmps::OpenMP execute_;
  TissueParameters<S> parameters_;
  Bonds bonds_;
  decltype(tissue_force(std::declval<const Bonds&>(), std::declval<const TissueParameters<S>&>(),
                        std::declval<const Materials&>(), std::declval<const Gradients&>())) force_;
};

}  // namespace detail

}  // namespace swallowing
