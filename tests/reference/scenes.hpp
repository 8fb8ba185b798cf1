// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "hmps/core/types.hpp"

/// Bodies that the tests of bonds and forces run over, of every kind of surface.
namespace scenes {

/// Numbers in [0, 1) from a fixed seed, the same on every machine (splitmix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double operator()() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }
  /// In [low, high).
  double operator()(double low, double high) { return low + (high - low) * (*this)(); }
  template <class T>
  void shuffle(std::vector<T>& values) {
    for (std::size_t i = values.size(); i > 1; --i) std::swap(values[i - 1], values[bits() % i]);
  }

 private:
  std::uint64_t state_;
};

template <int D>
using Points = std::vector<hmps::Vector<double, D>>;

/// A body: reference configuration (on a cubic lattice of `spacing` unless `jittered`), and a strained,
/// moving state of it.
template <int D>
struct Scene {
  std::string name;
  Points<D> reference, x, v;
  std::function<bool(std::size_t, std::size_t)> bonded = [](std::size_t, std::size_t) { return true; };
  bool jittered = false;
  static constexpr double spacing = 1.2e-3;
};

/// The lattice cells below `extent` for which `inside(cell)` holds, as positions.
template <int D, class Inside>
Points<D> lattice(const Eigen::Matrix<int, D, 1>& extent, Inside&& inside) {
  const Eigen::Matrix<double, 3, 1> corner(0.0123, -0.0456, 0.0789);
  Points<D> points;
  for (Eigen::Matrix<int, D, 1> cell = Eigen::Matrix<int, D, 1>::Zero();;) {
    if (inside(cell)) {
      hmps::Vector<double, D> p;
      for (int d = 0; d < D; ++d) p[d] = corner[d] + Scene<D>::spacing * cell[d];
      points.push_back(p);
    }
    int d = D - 1;
    while (d >= 0 && cell[d] == extent[d] - 1) cell[d--] = 0;
    if (d < 0) break;
    ++cell[d];
  }
  return points;
}
template <int D>
Points<D> box(const Eigen::Matrix<int, D, 1>& extent) {
  return lattice<D>(extent, [](const auto&) { return true; });
}
template <int D>
Eigen::Matrix<int, D, 1> extent(int a, int b, int c) {
  Eigen::Matrix<int, D, 1> e;
  e[0] = a;
  e[1] = b;
  if constexpr (D == 3) e[2] = c;
  return e;
}

/// Strains (by up to about `strain`), rotates and jolts the reference configuration; random velocities.
template <int D>
void move(Scene<D>& scene, double strain = 0.15, std::uint64_t seed = 7) {
  Random random(seed);
  const double l0 = scene.spacing, k = 0.25 / l0;
  Eigen::Matrix<double, D, D> turn = Eigen::Matrix<double, D, D>::Identity();
  turn(0, 0) = turn(1, 1) = std::cos(0.4);
  turn(1, 0) = -(turn(0, 1) = std::sin(0.4));
  for (const auto& X : scene.reference) {
    hmps::Vector<double, D> bent = X, velocity;
    for (int d = 0; d < D; ++d) {
      bent[d] += strain / k * std::sin(k * (X[(d + 1) % D] + 0.5 * X[d])) + 0.02 * l0 * random(-1, 1);
      velocity[d] = std::cos(k * X[d]) + random(-0.5, 0.5);
    }
    scene.x.push_back(turn * bent);
    scene.v.push_back(velocity);
  }
}

/// One body of each kind.
template <int D>
std::vector<Scene<D>> all() {
  std::vector<Scene<D>> scenes;
  const auto add = [&](const char* name, Points<D> reference) -> Scene<D>& {
    Scene<D>& scene = scenes.emplace_back();
    scene.name = name;
    scene.reference = std::move(reference);
    return scene;
  };
  add("box", D == 3 ? box<D>(extent<D>(7, 6, 19)) : box<D>(extent<D>(19, 11, 1)));
  add("box whose rows are long in the first direction", box<D>(extent<D>(37, 5, 4)));
  Random random(3);
  add("box with holes", lattice<D>(extent<D>(18, 9, 6), [&](const auto&) { return random() > 0.08; }));
  add("thin sheet", box<D>(extent<D>(2, 21, 13)));
  add("L", lattice<D>(extent<D>(13, 12, 4), [](const auto& cell) { return cell[0] < 5 || cell[1] < 4; }));
  // Unbonded pairs on either side of a plane: two bodies that touch.
  Points<D> points = box<D>(extent<D>(12, 8, 5));
  const double plane = points[points.size() / 2][0];
  add("cut box", points).bonded = [points, plane](std::size_t i, std::size_t j) {
    return (points[i][0] < plane) == (points[j][0] < plane);
  };
  points = lattice<D>(extent<D>(15, 7, 5), [](const auto& cell) { return cell[0] + cell[1] > 2; });
  random.shuffle(points);
  add("shuffled", points);
  for (auto& p : points)
    for (int d = 0; d < D; ++d) p[d] += 0.15 * Scene<D>::spacing * random(-1, 1);
  add("jittered", points).jittered = true;
  for (auto& scene : scenes) move(scene);
  return scenes;
}

}  // namespace scenes
