// SPDX-License-Identifier: MIT
// Tissue with fibres: a user-defined law whose direction differs from particle to particle, as in the tongue. Each
// fibre stiffens exponentially (Holzapfel, Gasser and Ogden 2000) and bears tension only.
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <type_traits>
#include <vector>

/// W of a neo-Hookean solid + k1 / (2 k2) (exp(k2 e^2) - 1), with e = a . C a - 1 if the fibre is stretched, else 0.
template <class T, int D>
struct Fibrous {
  hmps::NeoHookean<double> ground;
  hmps::Vector<T, D> a;  // unit vector along the fibre, in the reference configuration
  double k1, k2;         // Pa, 1

  hmps::Matrix<T, D> second_piola_kirchhoff(const hmps::Matrix<T, D>& C, const T& J) const {
    hmps::Matrix<T, D> S = ground.second_piola_kirchhoff(C, J);
    const T e = extension(C), tension = T(2 * k1) * e * exp(T(k2) * e * e);  // 2 dW/de
    for (int k = 0; k < D * D; ++k) S(k % D, k / D) += tension * a[k % D] * a[k / D];
    return S;
  }
  T energy(const hmps::Matrix<T, D>& C, const T& J) const {
    const T e = extension(C);
    return ground.energy(C, J) + T(k1 / (2 * k2)) * (exp(T(k2) * e * e) - T(1));
  }

 private:
  T extension(const hmps::Matrix<T, D>& C) const {
    T square(0);
    for (int k = 0; k < D * D; ++k) square += a[k % D] * C(k % D, k / D) * a[k / D];
    return hmps::select(square > T(1), square - T(1), T(0));
  }
};

int main() {
  const double l0 = 1e-3;
  const hmps::Box<double, 3> cube{Eigen::Vector3d::Zero(), Eigen::Vector3d::Constant(6 * l0)};
  const auto reference = hmps::fill_lattice(cube, l0, Eigen::Vector3d::Constant(l0 / 2));
  // The fibres lie along x in the lower half, along z in the upper.
  std::vector<Eigen::Vector3d> along;
  for (const auto& X : reference) along.push_back(X[2] < 3 * l0 ? Eigen::Vector3d::UnitX() : Eigen::Vector3d::UnitZ());

  const auto ground = hmps::NeoHookean<>::from_young_poisson(20e3, 0.45);
  const auto a = hmps::vectors(along);
  const auto law = [&](const auto& at) {
    const auto direction = at(a);  // of one particle, or of many at a time
    using Direction = std::decay_t<decltype(direction)>;
    return Fibrous<typename Direction::Scalar, 3>{ground, direction, 5e3, 2};
  };
  hmps::check_law(Fibrous<double, 3>{ground, Eigen::Vector3d(0.6, 0, 0.8), 5e3, 2});

  const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
  auto force = hmps::internal_force(bonds, hmps::elastic(law));
  double energy[2];
  for (const int axis : {0, 1}) {  // along the lower fibres, and across all of them
    auto position = reference, load = reference;
    for (auto& x : position) x[axis] *= 1.3;
    force(hmps::vectors(position), hmps::vectors(load));
    energy[axis] = force.energy(hmps::vectors(position), l0 * l0 * l0).total();
  }
  const double e = 1.3 * 1.3 - 1, fibres = 5e3 / 4 * (std::exp(2 * e * e) - 1) * 108e-9;  // of half the cube, in J
  std::printf("stretched by 30 %% along the lower fibres: %.3f mJ, of which fibres store %.3f; across: %.3f mJ\n",
              1e3 * energy[0], 1e3 * (energy[0] - energy[1]), 1e3 * energy[1]);
  return std::fflush(stdout) == 0 && std::abs(energy[0] - energy[1] - fibres) < 1e-9 * fibres ? 0 : 1;
}
