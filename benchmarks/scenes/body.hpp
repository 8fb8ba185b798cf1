// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

/// Scenes and helpers that several studies share.
namespace scenes {

/// Particles in `D` dimensions (two: plane strain) with their state in `S`, at rest in their reference configuration.
template <int D, class S = double>
struct Body {
  double spacing;  ///< m
  std::vector<hmps::Vector<double, D>> reference;
  std::vector<hmps::Vector<S, D>> position, velocity, load, carry;
  std::vector<hmps::Matrix<S, D>> gradient;

  Body(double l0, std::vector<hmps::Vector<double, D>> points) : spacing(l0), reference(std::move(points)) {
    for (const auto& X : reference) position.push_back(X.template cast<S>());
    velocity.assign(size(), hmps::Vector<S, D>::Zero());
    load = carry = velocity;
    gradient.assign(size(), hmps::Matrix<S, D>::Identity());
  }

  [[nodiscard]] std::size_t size() const { return reference.size(); }
  [[nodiscard]] double volume() const { return std::pow(spacing, D); }
  [[nodiscard]] hmps::Vector<double, D> displacement(std::size_t i) const {
    return position[i].template cast<double>() - reference[i];
  }
  [[nodiscard]] auto X() const { return hmps::vectors(reference); }
  [[nodiscard]] auto x() { return hmps::vectors(position); }
  [[nodiscard]] auto v() { return hmps::vectors(velocity); }
  [[nodiscard]] auto f() { return hmps::vectors(load); }
  [[nodiscard]] auto F() { return hmps::matrices(gradient); }
  void unload() { hmps::set_zero(f()); }
};

}  // namespace scenes
