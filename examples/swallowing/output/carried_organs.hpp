// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <hmps/core/types.hpp>
#include <hmps/particles/carried_surface.hpp>
#include <mutex>
#include <optional>
#include <vector>

#include "scene/organs.hpp"
#include "scene/scene.hpp"

namespace swallowing {

/// The drawn surfaces of the organs, cut at the midsagittal plane so that the right half is left. The particles of each
/// organ carry its surface along.
class CarriedOrgans {
 public:
  using Triangle = std::array<hmps::Index, 3>;

  /// Draws the surfaces of all organs that have particles, with cells of half the coarsest spacing. Throws
  /// `hmps::InputError` if a part of an organ is too far away from the particles of the organ to follow them.
  CarriedOrgans(const Scene& scene, int threads);

  /// The positions (m) of the vertices for positions (m) of all particles of the scene.
  [[nodiscard]] std::vector<std::array<float, 3>> vertices(const std::vector<std::array<float, 3>>& particles) const;
  /// The organ of each vertex.
  [[nodiscard]] const std::vector<Organ>& organ() const { return organ_; }
  /// The triangles, counter-clockwise seen from outside. No triangle joins two organs.
  [[nodiscard]] const std::vector<Triangle>& triangles() const { return triangles_; }
  /// Whether a triangle lies in the midsagittal plane, where the organs are cut.
  [[nodiscard]] bool cut(std::size_t triangle) const { return cut_[triangle]; }

 private:
  std::vector<hmps::CarriedSurface<3>> carried_;  // of each organ that has particles
  std::vector<Organ> organ_;
  std::vector<Triangle> triangles_;
  std::vector<bool> cut_;
};

/// The surfaces that the cases of a run share, whose particles have the same reference positions: made once, when a
/// case first needs them.
class SharedOrgans {
 public:
  /// Those of `scene`; other cases wait meanwhile.
  [[nodiscard]] const CarriedOrgans& of(const Scene& scene, int threads) {
    std::call_once(made_, [&] { organs_.emplace(scene, threads); });
    return *organs_;
  }

 private:
  std::once_flag made_;
  std::optional<CarriedOrgans> organs_;
};

}  // namespace swallowing
