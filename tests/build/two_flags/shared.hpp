// SPDX-License-Identifier: MIT
// What the two translation units of the test pass to each other.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

/// A user's particle: Eigen's own unaligned size, and our types.
struct Particle {
  Eigen::Vector3d position;
  hmps::Vector<double, 3> velocity;
  hmps::Matrix<double, 3> gradient;
  float density;
};

/// Sizes and offsets as a translation unit sees them.
struct Layout {
  std::size_t particle, vector4, matrix2, view, velocity, gradient;
  friend bool operator==(const Layout&, const Layout&) = default;
};

inline Layout layout() {
  // Sizes that Eigen would align to the vector unit: 4 doubles, 2 x 2 doubles.
  struct Probe {
    char offset;
    hmps::Vector<double, 4> vector;
  };
  struct ProbeMatrix {
    char offset;
    hmps::Matrix<double, 2> matrix;
  };
  return {sizeof(Particle), sizeof(Probe),
          sizeof(ProbeMatrix), sizeof(hmps::VectorView<double, 3>),
          offsetof(Particle, velocity), offsetof(Particle, gradient)};
}

Layout wide_layout();
std::vector<Particle> wide_particles(std::size_t count);
double wide_sum(const hmps::VectorView<const double, 3>& positions, const hmps::MatrixView<const double, 3>& gradients);
