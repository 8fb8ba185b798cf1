// SPDX-License-Identifier: MIT
#pragma once

#include <hmps/particles/fitted.hpp>
#include <vector>

#include "scene/anatomy.hpp"

namespace swallowing {

/// A box (m) around all organs.
[[nodiscard]] inline hmps::Box<double, 3> bounds_of_organs() {
  return {1e-3 * Point(-82, -34, -38), 1e-3 * Point(30, 34, 104)};
}

/// Particles that are fitted to the common surface of the organs. All cases share them.
struct FittedOrgans {
  hmps::FittedParticles<double, 3> particles;
  std::vector<double> depth;  ///< depth of each particle below the surface, in layers
};

/// Fits particles of the given spacing (m). They do not depend on the number of threads. Throws `hmps::InputError` if
/// the organs are too thin for the spacing.
[[nodiscard]] FittedOrgans fit_organs(double spacing, int threads);

}  // namespace swallowing
