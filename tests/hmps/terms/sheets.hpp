// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"

/// Waves in infinite sheets of a few particles, by the library and by theory.
namespace sheets {

using Vector = hmps::Vector<double, 3>;
using Complex = std::complex<double>;

/// Lengths in spacings, moduli in shear moduli.
inline hmps::LinearElastic<double> material(double bulk) { return {bulk - 2.0 / 3, 1}; }

/// An infinite sheet of `layers` particles as plane waves see it: the stiffness of the waves exp(i k.x), from the
/// forces of the library on one column of particles in the middle of a patch that holds all particles that act on it.
class Sheet {
 public:
  /// The force on a particle depends on those at up to `bonds` bonds from it: two, four with a mean dilatation.
  Sheet(int layers, double radius, int bonds = 2)
      : layers_(static_cast<std::size_t>(layers)), reach_(bonds * static_cast<int>(radius)) {
    for (int x = -reach_; x <= reach_; ++x)
      for (int y = -reach_; y <= reach_; ++y)
        for (int z = 0; z < layers; ++z) points_.emplace_back(x, y, z);
    bonds_.emplace_back(hmps::vectors(points_), hmps::BondSettings{.spacing = 1, .radius_ratio = radius});
  }

  /// The stiffness of a sheet with these internal forces.
  template <class... Terms>
  [[nodiscard]] Eigen::MatrixXcd stiffness(const Vector& k, const Terms&... terms) const {
    auto force = hmps::internal_force(bonds_[0], terms...);
    const std::size_t middle = (points_.size() / layers_ - 1) / 2 * layers_;
    const auto size = static_cast<Eigen::Index>(3 * layers_);
    Eigen::MatrixXcd K(size, size);
    for (Eigen::Index column = 0; column < size; ++column)
      for (const double phase : {0.0, std::acos(-1.0) / 2}) {
        std::vector<Vector> x = points_, f(points_.size());
        for (std::size_t i = 0; i < x.size(); ++i)
          if (i % layers_ == static_cast<std::size_t>(column / 3))
            x[i][column % 3] += amplitude * std::cos(k.dot(points_[i]) - phase);
        force(hmps::vectors(x), hmps::vectors(f));
        for (Eigen::Index row = 0; row < size; ++row) {
          const double resistance = -f[middle + static_cast<std::size_t>(row / 3)][row % 3] / amplitude;
          if (phase == 0)
            K(row, column) = resistance;
          else
            K(row, column) += Complex(0, resistance);
        }
      }
    return (K + K.adjoint()) / 2;
  }

  /// Frequency of the bending wave, the mode whose particles move most across the sheet, times the square root of rho.
  template <class... Terms>
  [[nodiscard]] double bending(const Vector& k, const Terms&... terms) const {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd> modes(stiffness(k, terms...));
    double most = 0, eigenvalue = 0;
    for (Eigen::Index m = 0; m < modes.eigenvalues().size(); ++m) {
      Complex across = 0;
      for (Eigen::Index i = 2; i < modes.eigenvalues().size(); i += 3) across += modes.eigenvectors()(i, m);
      if (std::norm(across) <= most) continue;
      most = std::norm(across);
      eigenvalue = modes.eigenvalues()[m];
    }
    return std::sqrt(eigenvalue);
  }

 private:
  static constexpr double amplitude = 1e-6;  // terms quadratic in it are as small as the rounding
  std::size_t layers_;
  int reach_;
  std::vector<Vector> points_;
  std::vector<hmps::BondList<double, 3>> bonds_;
};

/// The lowest antisymmetric wave in a plate of thickness h, by the equation of Rayleigh and Lamb.
inline double plate(double k, double h, double bulk) {
  const auto difference = [&](double omega) {
    const double a = std::sqrt(k * k - omega * omega / (bulk + 4.0 / 3)), b = std::sqrt(k * k - omega * omega);
    return std::tanh(b * h / 2) * 4 * k * k * a * b - std::tanh(a * h / 2) * std::pow(k * k + b * b, 2);
  };
  // At omega = 0 the two terms are equal. Below the root the first one is smaller throughout or larger throughout.
  double low = 1e-3 * k * k * h, high = k * (1 - 1e-12);
  EXPECT_LT(difference(low) * difference(high), 0);
  for (int n = 0; n < 200; ++n) {
    const double middle = (low + high) / 2;
    (difference(middle) * difference(low) > 0 ? low : high) = middle;
  }
  return low;
}

// The wave number of the first bending mode of a free beam whose length is ten times its height, times that height.
inline constexpr double slender = 0.473;

}  // namespace sheets
