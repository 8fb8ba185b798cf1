// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../reference/plain.hpp"
#include "../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/view.hpp"
#include "hmps/laws/mooney_rivlin.hpp"

/// Shared by the tests of the force terms: materials that differ from particle to particle, and the plain equations
/// with them.
namespace equations {

inline constexpr double density = 1000, viscosity = 2e-3;

/// Constants per particle, in Pa.
struct Materials {
  std::vector<double> c1, c2, d1, modulus;

  Materials(std::size_t size, bool uniform = false) {
    scenes::Random random(11);
    for (std::size_t i = 0; i < size; ++i) {
      const auto pick = [&](double value) { return uniform ? value : value * random(0.5, 1.5); };
      c1.push_back(pick(1700));
      c2.push_back(pick(1500));
      d1.push_back(pick(1e4));
      modulus.push_back(pick(2e4));
    }
  }
};

/// The plain equations for one scene.
template <int D>
struct Expected {
  using Vec = Eigen::Matrix<double, D, 1>;
  using Mat = Eigen::Matrix<double, D, D>;
  plain::Body<double, D> body;
  std::vector<Vec> x, v, elastic, artificial, viscous;
  std::vector<Mat> F;

  static std::vector<Vec> convert(const scenes::Points<D>& points) { return {points.begin(), points.end()}; }

  Expected(const scenes::Scene<D>& scene, const Materials& m, double lambda, double n0)
      : body(convert(scene.reference), 1.75 * scene.spacing, scene.bonded),
        x(convert(scene.x)),
        v(convert(scene.v)),
        elastic(x.size(), Vec::Zero()),
        artificial(elastic),
        viscous(elastic),
        F(x.size()) {
    body.deformation_gradient(x, F);
    body.elastic(
        F,
        [&](std::size_t i, const Mat& Fi) {
          return plain::MooneyRivlin<double>{m.c1[i], m.c2[i], m.d1[i]}.template second_piola_kirchhoff<D>(Fi);
        },
        elastic);
    body.artificial(
        x, F, [&](std::size_t i) { return m.modulus[i]; }, artificial);
    body.viscous(v, density, viscosity, lambda, n0, viscous);
  }
};

/// Rounding of kernels in `K`: F is made of differences of displacements, so that its error is a few
/// eps of the largest displacement over the spacing; stresses multiply it by the stiffness 2 D1 + E,
/// and a force is a stress over the spacing. The sum over the bonds adds a factor of order ten.
template <class K, int D>
struct Tolerance {
  double gradient, elastic, artificial, viscous;

  explicit Tolerance(const scenes::Scene<D>& scene) {
    double displacement = 0, speed = 0;
    for (std::size_t i = 0; i < scene.x.size(); ++i) {
      const auto u = [&](std::size_t k) { return scene.x[k] - scene.reference[k]; };
      displacement = std::max(displacement, (u(i) - u(0)).norm());
      speed = std::max(speed, scene.v[i].norm());
    }
    // The state itself is in double: the rounding of its positions, of about 0.1 m, is present whatever K is.
    const double eps = std::numeric_limits<K>::epsilon() * (1 + displacement / scene.spacing) +
                       std::numeric_limits<double>::epsilon() * 0.1 / scene.spacing;
    gradient = 4 * eps;
    elastic = 10 * gradient * (2 * 1.5e4 + 6 * 1.5 * 3200) / scene.spacing;
    artificial = 10 * gradient * 3e4 / scene.spacing;
    viscous = 100 * std::numeric_limits<K>::epsilon() * density * viscosity * speed / std::pow(scene.spacing, 2);
  }
};

/// Which bonds fit a scene.
template <class B>
inline constexpr bool is_lattice = std::is_same_v<B, hmps::LatticeBonds<typename B::Scalar, B::dimension>>;

template <class B>
B make_bonds(const scenes::Scene<B::dimension>& scene) {
  return B(hmps::vectors(scene.reference), {.spacing = scene.spacing}, scene.bonded);
}

template <int D>
using Vectors = std::vector<hmps::Vector<double, D>>;

template <int D, class Value>
double largest_difference(const Vectors<D>& a, Value&& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = (a[i] - b(i)).norm();
    largest = std::isfinite(difference) ? std::max(largest, difference) : std::numeric_limits<double>::infinity();
  }
  return largest;
}

/// A small box in a strained state, for comparison with differences of an energy.
template <int D>
scenes::Scene<D> bent_box(bool jittered) {
  scenes::Scene<D> scene;
  scenes::Random random(2);
  scene.reference = scenes::box<D>(scenes::extent<D>(6, 5, 4));
  for (auto& p : scene.reference)
    for (int d = 0; jittered && d < D; ++d) p[d] += 0.15 * scene.spacing * random(-1, 1);
  scenes::move(scene);
  return scene;
}

/// Compares every third force with minus the central difference of `energy()`, which reads `x`.
template <int D, class Energy>
void expect_minus_gradient(const Vectors<D>& force, std::vector<Eigen::Matrix<double, D, 1>>& x, Energy&& energy,
                           double spacing, double tolerance) {
  double largest = 0;
  for (const auto& f : force) largest = std::max(largest, f.norm());
  const double h = 1e-4 * spacing;
  for (std::size_t i = 0; i < x.size(); i += 3)
    for (int d = 0; d < D; ++d) {
      const double old = x[i][d];
      x[i][d] = old + h;
      const double above = energy();
      x[i][d] = old - h;
      const double below = energy();
      x[i][d] = old;
      // The differences' error: h^2 of the third derivative, and the rounding of H over h.
      EXPECT_NEAR(force[i][d], -(above - below) / (2 * h), 1e-6 * largest + tolerance) << i << ' ' << d;
    }
}

}  // namespace equations
