// SPDX-License-Identifier: MIT
#pragma once

#include "problem.hpp"

/// The problems by subject. `row` numbers are those of docs/verification.md.
namespace verification {

[[nodiscard]] Problem affine_patch();  ///< homogeneous.cpp
[[nodiscard]] Problem rigid_motion();
[[nodiscard]] Problem uniaxial_stress();
[[nodiscard]] Problem equibiaxial_stress();
[[nodiscard]] Problem simple_shear();
[[nodiscard]] Problem dispersion();
[[nodiscard]] Problem torsion();   ///< torsion.cpp
[[nodiscard]] Problem free_bar();  ///< vibration.cpp
[[nodiscard]] Problem rubber_bar();
[[nodiscard]] Problem oscillating_plate();
[[nodiscard]] Problem elastic_flag();
[[nodiscard]] Problem bending_column();
[[nodiscard]] Problem cantilever();  ///< statics.cpp
[[nodiscard]] Problem bonded_shear();
[[nodiscard]] Problem bonded_compression();
[[nodiscard]] Problem long_wall();  ///< pressure.cpp
[[nodiscard]] Problem thick_cylinder();
[[nodiscard]] Problem cooks_membrane();
[[nodiscard]] Problem sphere_on_block();  ///< contact.cpp
[[nodiscard]] Problem contact_patch();

}  // namespace verification
