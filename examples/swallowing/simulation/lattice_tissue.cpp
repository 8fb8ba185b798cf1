// SPDX-License-Identifier: MIT
#include <hmps/bonds/lattice_bonds.hpp>
#include <memory>

#include "simulation/soft_tissue.hpp"
#include "simulation/tissue_on.hpp"

namespace swallowing {

template <class S>
std::unique_ptr<SoftTissue<S>> make_lattice_tissue(const Scene& scene, const Materials& materials,
                                                   const hmps::MatrixView<S, 3>& gradients,
                                                   const hmps::OpenMP& execute) {
  return std::make_unique<detail::TissueOn<S, hmps::LatticeBonds<S, 3>>>(scene, materials, gradients, execute);
}

template std::unique_ptr<SoftTissue<float>> make_lattice_tissue(const Scene&, const Materials&,
                                                                const hmps::MatrixView<float, 3>&, const hmps::OpenMP&);
template std::unique_ptr<SoftTissue<double>> make_lattice_tissue(const Scene&, const Materials&,
                                                                 const hmps::MatrixView<double, 3>&,
                                                                 const hmps::OpenMP&);

}  // namespace swallowing
