// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "hmps/contact/organ.hpp"
#include "hmps/core/view.hpp"

/// Lattice boxes for the tests of contact.
namespace bodies {

/// The types over which a typed test runs.
template <class S_, int D_, class Ball_>
struct Case {
  using S = S_;
  using Ball = Ball_;
  static constexpr int D = D_;
};

using hmps::Index;

/// Runs loops forwards or backwards, and counts them. A single type for all tests, so that it is compiled only once.
struct Loops {
  bool backwards = false;
  std::size_t* count = nullptr;
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    if (count != nullptr) ++*count;
    for (std::size_t i = 0; i < n; ++i) body(backwards ? n - 1 - i : i);
  }
};

template <class S, int D>
struct Scene {
  using Point = hmps::Vector<S, D>;
  using Tensor = hmps::Matrix<S, D>;
  std::vector<Point> x, v, f;
  std::vector<Tensor> F;

  struct Box {
    std::vector<Index> bottom, top, all;
    std::vector<Index> lower, upper;  // the two lowest and highest layers
  };

  /// A box of `counts` particles with spacing `l0`, whose lowest corner is `corner`; the last axis is upright.
  Box add(const hmps::Vector<int, D>& counts, const Point& corner, S l0) {
    Box box;
    const int height = counts[D - 1];
    for (int a = 0; a < (D == 3 ? counts[0] : 1); ++a)
      for (int b = 0; b < counts[D - 2]; ++b)
        for (int c = 0; c < height; ++c) {
          Point p = corner;
          if constexpr (D == 3) p[0] += S(a) * l0;
          p[D - 2] += S(b) * l0;
          p[D - 1] += S(c) * l0;
          const auto i = static_cast<Index>(x.size());
          x.push_back(p);
          box.all.push_back(i);
          if (c == 0) box.bottom.push_back(i);
          if (c == height - 1) box.top.push_back(i);
          if (c < 2) box.lower.push_back(i);
          if (c >= height - 2) box.upper.push_back(i);
        }
    v.resize(x.size(), Point::Zero());
    f.resize(x.size(), Point::Zero());
    F.resize(x.size(), Tensor::Identity());
    return box;
  }

  /// Jitters velocities (m/s) and deformation gradients.
  void shake(S speed, S strain, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1, 1);
    for (std::size_t i = 0; i < x.size(); ++i) {
      for (int c = 0; c < D; ++c) v[i][c] += speed * static_cast<S>(u(random));
      for (int c = 0; c < D * D; ++c) F[i](c % D, c / D) += strain * static_cast<S>(u(random));
    }
  }

  void rest() { hmps::set_zero(hmps::vectors(f)); }
  template <class Contact>
  auto apply(Contact& contact, double dt, const Loops& execute = {}) {
    rest();
    return contact.add(hmps::vectors(x), hmps::vectors(v), hmps::matrices(F), hmps::vectors(f), dt, execute);
  }
  [[nodiscard]] Point total() const {
    Point sum = Point::Zero();
    for (const Point& force : f) sum += force;
    return sum;
  }
  [[nodiscard]] S magnitude() const {
    S sum = 0;
    for (const Point& force : f) sum += force.norm();
    return sum;
  }
};

/// Two boxes, one on the other: the plate below, 10 wide, and the block on it, 4 wide and shifted off
/// the plate's lattice, `gap` spacings higher than the plate's top layer.
template <class S, int D>
struct Pile : Scene<S, D> {
  using typename Scene<S, D>::Point;
  typename Scene<S, D>::Box plate, block;
  S l0;
  explicit Pile(double gap, double spacing = 1e-3) : l0(static_cast<S>(spacing)) {
    hmps::Vector<int, D> wide = hmps::Vector<int, D>::Constant(10), narrow = hmps::Vector<int, D>::Constant(4);
    wide[D - 1] = narrow[D - 1] = 3;
    plate = this->add(wide, Point::Zero(), l0);
    Point corner = Point::Constant(S(2.8) * l0);
    corner[0] += S(0.1) * l0;
    corner[D - 1] = (S(2) + static_cast<S>(gap)) * l0;
    block = this->add(narrow, corner, l0);
  }
  template <class Contact>
  std::size_t declare(Contact& contact, const hmps::PairSettings& settings = {}, bool fixed_plate = false) const {
    const auto a = contact.add_organ(
        {.name = "plate", .slaves = plate.top, .masters = plate.upper, .prescribed = [fixed_plate](Index) {
           return fixed_plate;
         }});
    const auto b =
        contact.add_organ({.name = "block", .slaves = block.bottom, .masters = block.lower, .prescribed = {}});
    return contact.add_pair(a, b, settings);
  }
};

}  // namespace bodies
