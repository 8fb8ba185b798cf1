// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <hmps/shapes/surface_mesh.hpp>
#include <numbers>

namespace press {

/// A closed surface that looks like an organ, 80 x 56 x 48 mm, in m: an ellipsoid with lobes and a hollow side.
[[nodiscard]] inline hmps::SurfaceMesh<double> organ() {
  constexpr hmps::Index rings = 31, round = 64;
  const auto at = [](double down, double around) {
    const double s = std::sin(down), lobes = 1 + 0.10 * s * s * std::cos(3 * around + 2 * down);
    const double hollow = 1 - 0.28 * std::exp(-4 * (1 - s * std::cos(around - 4.4)));
    const double r = lobes * hollow;
    return hmps::Vector<double, 3>(0.040 * r * s * std::cos(around), 0.028 * r * s * std::sin(around),
                                   0.024 * r * std::cos(down));
  };
  hmps::SurfaceMesh<double> mesh;
  mesh.source = "the built-in organ";
  mesh.vertices.push_back(at(0, 0));
  for (hmps::Index i = 1; i <= rings; ++i)
    for (hmps::Index j = 0; j < round; ++j)
      mesh.vertices.push_back(at(std::numbers::pi * i / (rings + 1), 2 * std::numbers::pi * j / round));
  mesh.vertices.push_back(at(std::numbers::pi, 0));
  const auto last = static_cast<hmps::Index>(mesh.vertices.size() - 1);
  const auto name = [](hmps::Index ring, hmps::Index j) { return 1 + ring * round + j % round; };
  for (hmps::Index j = 0; j < round; ++j) {
    mesh.triangles.push_back({0, name(0, j), name(0, j + 1)});
    for (hmps::Index i = 0; i + 1 < rings; ++i) {
      mesh.triangles.push_back({name(i, j), name(i + 1, j), name(i + 1, j + 1)});
      mesh.triangles.push_back({name(i, j), name(i + 1, j + 1), name(i, j + 1)});
    }
    mesh.triangles.push_back({name(rings - 1, j), last, name(rings - 1, j + 1)});
  }
  return mesh;
}

}  // namespace press
