// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "verification/problem.hpp"

/// The problems by subject. Their titles have the numbers of docs/measured/verification.md.
namespace verification {

[[nodiscard]] Problem uniaxial_stress();  ///< homogeneous.cpp
[[nodiscard]] Problem equibiaxial_stress();
[[nodiscard]] Problem simple_shear();
[[nodiscard]] Problem affine_patch();  ///< affine.cpp
[[nodiscard]] Problem rigid_motion();
[[nodiscard]] Problem dispersion();
[[nodiscard]] Problem torsion();   ///< torsion.cpp
[[nodiscard]] Problem free_bar();  ///< bars.cpp
[[nodiscard]] Problem rubber_bar();
[[nodiscard]] Problem bending_column();
[[nodiscard]] Problem oscillating_plate();  ///< plates.cpp
[[nodiscard]] Problem elastic_flag();
[[nodiscard]] Problem cantilever();  ///< statics.cpp
[[nodiscard]] Problem bonded_shear();
[[nodiscard]] Problem bonded_compression();
[[nodiscard]] Problem long_wall();  ///< pressure.cpp
[[nodiscard]] Problem thick_cylinder();
[[nodiscard]] Problem cooks_membrane();
[[nodiscard]] Problem sphere_on_block();  ///< contact.cpp
[[nodiscard]] Problem contact_patch();

/// All of them in the order of the page.
[[nodiscard]] inline std::vector<Problem> problems() {
  return {affine_patch(), rigid_motion(),   uniaxial_stress(), equibiaxial_stress(), simple_shear(),
          free_bar(),     rubber_bar(),     cantilever(),      bonded_shear(),       bonded_compression(),
          torsion(),      long_wall(),      thick_cylinder(),  bending_column(),     oscillating_plate(),
          elastic_flag(), cooks_membrane(), sphere_on_block(), contact_patch(),      dispersion()};
}

}  // namespace verification
