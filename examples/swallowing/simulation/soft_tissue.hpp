// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <hmps/analysis/stable_step.hpp>
#include <hmps/analysis/step_causes.hpp>
#include <hmps/core/view.hpp>
#include <hmps/executors/openmp.hpp>
#include <memory>
#include <vector>

#include "scene/materials.hpp"
#include "scene/scene.hpp"

namespace swallowing {

/// The energies stored in the deforming body, in J.
struct StoredEnergy {
  double strain;  ///< of the law, and of the mean dilatation on fitted particles
  double artificial;
};

/// The internal forces of the deforming body, whatever bonds and terms make them. `S` is the scalar type of velocities
/// and forces; pass views of the body alone.
template <class S>
class SoftTissue {
 public:
  using Places = hmps::VectorView<double, 3>;
  using Velocities = hmps::VectorView<S, 3>;
  using Gradients = hmps::MatrixView<S, 3>;

  virtual ~SoftTissue() = default;

  /// Adds the effect of the forces over `dt` (s) to the velocities, and writes F to the view given at construction.
  virtual void kick(const Places& x, const Velocities& v, double dt) = 0;
  /// From now on, `kick` omits the particles that are not `free`.
  virtual void restrict_to(const std::vector<char>& free) = 0;
  [[nodiscard]] virtual StoredEnergy stored_energy(const Places& x, const Gradients& F) const = 0;
  [[nodiscard]] virtual hmps::StableStep stable_step(const Places& x, const Velocities& v,
                                                     const hmps::StableStepSettings& settings) = 0;
  /// Which of the forces limit the step.
  [[nodiscard]] virtual std::vector<hmps::StepCause> causes(const hmps::StableStep& limit, const Places& x,
                                                            const Velocities& v) = 0;
  /// How well its bonds support a particle, see `hmps::relative_support`.
  [[nodiscard]] virtual double support(std::size_t particle) const = 0;
};

/// The tissue of a scene on the bonds of its lattice, with the paper's terms; defined for float and double.
template <class S>
[[nodiscard]] std::unique_ptr<SoftTissue<S>> make_lattice_tissue(const Scene& scene, const Materials& materials,
                                                                 const hmps::MatrixView<S, 3>& gradients,
                                                                 const hmps::OpenMP& execute);

/// The tissue of a scene on a list of bonds of its fitted particles, with the choices for thin walls; defined for float
/// and double.
template <class S>
[[nodiscard]] std::unique_ptr<SoftTissue<S>> make_fitted_tissue(const Scene& scene, const Materials& materials,
                                                                const hmps::MatrixView<S, 3>& gradients,
                                                                const hmps::OpenMP& execute);

/// The tissue of a scene, on its lattice or on its fitted particles. F goes to `gradients`.
template <class S>
[[nodiscard]] std::unique_ptr<SoftTissue<S>> make_tissue(const Scene& scene, const Materials& materials,
                                                         const hmps::MatrixView<S, 3>& gradients,
                                                         const hmps::OpenMP& execute) {
  if (scene.layers.empty()) return make_lattice_tissue<S>(scene, materials, gradients, execute);
  return make_fitted_tissue<S>(scene, materials, gradients, execute);
}

}  // namespace swallowing
