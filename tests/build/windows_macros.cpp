// SPDX-License-Identifier: MIT
// The headers beside the macros that <windows.h> leaves behind, NOMINMAX being defined: none of these names may be one
// of ours. It only has to compile.
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nanoflann.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <sstream>
#include <string>
#include <unordered_map>

#define near
#define far
#define small char
#define interface struct
#define IN
#define OUT
#define OPTIONAL
#define ERROR 0
#define DELETE (0x00010000L)
#define TRUE 1
#define FALSE 0
#define NO_ERROR 0L
#define pascal
#define cdecl
#define CALLBACK

// clang-format off
#include "hmps/analysis/probed_scene.hpp"
#include "hmps/analysis/relaxation.hpp"
#include "hmps/analysis/stable_step.hpp"
#include "hmps/analysis/step_causes.hpp"
#include "hmps/analysis/stable_step_settings.hpp"
#include "hmps/analysis/step_search.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/cloud_order.hpp"
#include "hmps/bonds/plausible_spacing.hpp"
#include "hmps/bonds/bonds.hpp"
#include "hmps/bonds/followed_bonds.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/bonds/lattice_cells.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/anchored.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/language.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/step.hpp"
#include "hmps/core/text_file.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/core/view_checks.hpp"
#include "hmps/core/view_types.hpp"
#include "hmps/diagnostics/energy.hpp"
#include "hmps/diagnostics/jacobian.hpp"
#include "hmps/diagnostics/momentum.hpp"
#include "hmps/diagnostics/monitor.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lanes.hpp"
#include "hmps/lanes/quad.hpp"
#include "hmps/lanes/places.hpp"
#include "hmps/lanes/slots.hpp"
#include "hmps/lanes/staging.hpp"
#include "hmps/laws/continued.hpp"
#include "hmps/laws/invariants.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/laws/neo_hookean.hpp"
#include "hmps/laws/saint_venant_kirchhoff.hpp"
#include "hmps/motion/control_region.hpp"
#include "hmps/motion/csv.hpp"
#include "hmps/motion/keyframes.hpp"
#include "hmps/motion/pose.hpp"
#include "hmps/motion/rigid_motion.hpp"
#include "hmps/particles/lattice.hpp"
#include "hmps/particles/support.hpp"
#include "hmps/particles/thicken.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/search/grid.hpp"
#include "hmps/search/nearest_spacing.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/sweep.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/mean_dilatation.hpp"
#include "hmps/terms/record.hpp"
#include "hmps/terms/shear_wave_modulus.hpp"
#include "hmps/terms/sheet_stabiliser.hpp"
#include "hmps/terms/term.hpp"
#include "hmps/terms/viscous.hpp"
#include "hmps/time/symplectic_euler.hpp"
// clang-format on

int main() {}
