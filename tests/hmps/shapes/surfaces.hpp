// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <string_view>
#include <utility>

#include "../../reference/temporary_folder.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"

/// Closed surfaces made by the tests themselves.
namespace hmps_test {

/// The twelve triangles of the box from `lower` to `upper`.
template <class S>
[[nodiscard]] hmps::SurfaceMesh<S> box_surface(const hmps::Vector<S, 3>& lower, const hmps::Vector<S, 3>& upper) {
  hmps::SurfaceMesh<S> mesh;
  for (int k = 0; k < 8; ++k)
    mesh.vertices.emplace_back((k & 1) != 0 ? upper[0] : lower[0], (k & 2) != 0 ? upper[1] : lower[1],
                               (k & 4) != 0 ? upper[2] : lower[2]);
  mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                    {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  return mesh;
}

/// An icosahedron whose faces are cut in four `levels` times, with all vertices on the sphere.
template <class S>
[[nodiscard]] hmps::SurfaceMesh<S> sphere_surface(const hmps::Vector<S, 3>& centre, S radius, int levels) {
  const double g = std::numbers::phi;
  const std::array<std::array<double, 3>, 12> corners{{{-1, g, 0},
                                                       {1, g, 0},
                                                       {-1, -g, 0},
                                                       {1, -g, 0},
                                                       {0, -1, g},
                                                       {0, 1, g},
                                                       {0, -1, -g},
                                                       {0, 1, -g},
                                                       {g, 0, -1},
                                                       {g, 0, 1},
                                                       {-g, 0, -1},
                                                       {-g, 0, 1}}};
  hmps::SurfaceMesh<S> mesh;
  for (const auto& c : corners)
    mesh.vertices.emplace_back(static_cast<S>(c[0]), static_cast<S>(c[1]), static_cast<S>(c[2]));
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (int level = 0; level < levels; ++level) {
    std::map<std::pair<hmps::Index, hmps::Index>, hmps::Index> middles;
    const auto middle = [&](hmps::Index a, hmps::Index b) {
      const auto [at, is_new] =
          middles.try_emplace({std::min(a, b), std::max(a, b)}, static_cast<hmps::Index>(mesh.vertices.size()));
      if (is_new) mesh.vertices.push_back((mesh.vertices[a] + mesh.vertices[b]) / S(2));
      return at->second;
    };
    std::vector<std::array<hmps::Index, 3>> finer;
    for (const auto& [a, b, c] : mesh.triangles) {
      const hmps::Index ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      finer.insert(finer.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
    }
    mesh.triangles = std::move(finer);
    for (auto& v : mesh.vertices) v.normalize();
  }
  for (auto& v : mesh.vertices) v = centre + radius * v.normalized();
  return mesh;
}

/// A torus around the z axis, of `n` by `m` quads cut in two.
template <class S>
[[nodiscard]] hmps::SurfaceMesh<S> torus_surface(S ring, S radius, hmps::Index n, hmps::Index m) {
  hmps::SurfaceMesh<S> mesh;
  for (hmps::Index i = 0; i < n; ++i)
    for (hmps::Index j = 0; j < m; ++j) {
      const double a = 2 * std::numbers::pi * i / n, b = 2 * std::numbers::pi * j / m;
      const double r = static_cast<double>(ring) + static_cast<double>(radius) * std::cos(b);
      mesh.vertices.emplace_back(static_cast<S>(r * std::cos(a)), static_cast<S>(r * std::sin(a)),
                                 static_cast<S>(static_cast<double>(radius) * std::sin(b)));
    }
  for (hmps::Index i = 0; i < n; ++i)
    for (hmps::Index j = 0; j < m; ++j) {
      const hmps::Index p = i * m + j, q = (i + 1) % n * m + j, s = (i + 1) % n * m + (j + 1) % m,
                        t = i * m + (j + 1) % m;
      mesh.triangles.push_back({p, q, s});
      mesh.triangles.push_back({p, s, t});
    }
  return mesh;
}

/// Two surfaces as one.
template <class S>
[[nodiscard]] hmps::SurfaceMesh<S> joined(hmps::SurfaceMesh<S> a, const hmps::SurfaceMesh<S>& b) {
  const auto first = static_cast<hmps::Index>(a.vertices.size());
  a.vertices.insert(a.vertices.end(), b.vertices.begin(), b.vertices.end());
  for (const auto& t : b.triangles) a.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  return a;
}

/// The surface turned inside out.
template <class S>
[[nodiscard]] hmps::SurfaceMesh<S> reversed(hmps::SurfaceMesh<S> mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

/// A file in a temporary folder of its own, which is removed with the object.
class TemporaryFile {
 public:
  TemporaryFile(std::string_view ending, std::string_view bytes) {
    path_ = (folder_.path() / "file").string() + std::string(ending);
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  TemporaryFolder folder_;
  std::string path_;
};

}  // namespace hmps_test
