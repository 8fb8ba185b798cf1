// SPDX-License-Identifier: MIT
#pragma once

#include <metis.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <vector>

#include "../common/error.hpp"
#include "scene.hpp"

namespace across_machines {

/// What one rank holds: its own particles, those that these are bonded to, and those that the latter are bonded to. The
/// force on a particle needs the deformation gradients of its neighbours, and these need the positions of theirs.
struct Part {
  std::vector<Index> particles;  ///< the own ones, then the first layer, then the second; ascending in each
  std::size_t own = 0;           ///< number of its own
  std::size_t held = 0;          ///< number of its own and of the first layer

  /// Where the own `particle` of the scene stands in `particles`.
  [[nodiscard]] Index place_of(Index particle) const {
    const auto end = particles.begin() + static_cast<std::ptrdiff_t>(own);
    return static_cast<Index>(std::lower_bound(particles.begin(), end, particle) - particles.begin());
  }
};

/// Cuts parts out of a scene, one after the other.
class Cutter {
 public:
  explicit Cutter(const Scene& scene) : scene_(scene), taken_(scene.size(), 0) {}

  /// The part with its `own` particles (ascending).
  [[nodiscard]] Part cut(const std::vector<Index>& own) {
    Part part{own, own.size(), 0};
    for (const Index i : own) taken_[i] = 1;
    part.held = grow(part.particles, 0);
    grow(part.particles, part.own);
    for (const Index i : part.particles) taken_[i] = 0;
    return part;
  }

 private:
  /// Adds the neighbours of all particles from `first` on.
  std::size_t grow(std::vector<Index>& particles, std::size_t first) {
    const std::size_t last = particles.size();
    for (std::size_t k = first; k < last; ++k)
      scene_.for_each_neighbour(particles[k], [&](Index j) {
        if (taken_[j] == 0) {
          taken_[j] = 1;
          particles.push_back(j);
        }
      });
    std::sort(particles.begin() + static_cast<std::ptrdiff_t>(last), particles.end());
    return particles.size();
  }

  const Scene& scene_;
  std::vector<std::uint8_t> taken_;
};

/// The particles of each part, ascending. Throws `InputError` for a part without particles.
[[nodiscard]] inline std::vector<std::vector<Index>> own_particles(const std::vector<int>& part_of, int parts) {
  std::vector<std::vector<Index>> own(static_cast<std::size_t>(parts));
  for (std::size_t i = 0; i < part_of.size(); ++i)
    own[static_cast<std::size_t>(part_of[i])].push_back(static_cast<Index>(i));
  for (std::size_t p = 0; p < own.size(); ++p)
    examples::require(!own[p].empty(), "hmps: part ", p, " of ", parts, " has no particles, of ", part_of.size(),
                      " in all; use fewer ranks, or more particles");
  return own;
}

/// The bonds between cubes of particles, `edge` along each side, of one body each, as a graph for METIS. Where bodies
/// touch at the start, their cubes are joined as well: else METIS cuts along the contact, which takes more messages.
class CubeGraph {
 public:
  /// Of a pair of particles in touch over that of a bond: what a rank gathers for one on both sides of a cut, in bytes,
  /// is about twice that of two layers of halo, and contact reaches further along the surface.
  static constexpr idx_t usual_contact_weight = 3;

  /// Does not join the cubes of two bodies where `contact_weight` is 0.
  CubeGraph(const Scene& scene, int edge, idx_t contact_weight = usual_contact_weight) : cube_of_(scene.size()) {
    std::array<int, 3> most{};
    for (std::size_t i = 0; i < scene.size(); ++i)
      for (std::size_t d = 0; d < 3; ++d) most[d] = std::max(most[d], scene.cell(i)[d] / edge + 1);
    std::vector<idx_t> number(static_cast<std::size_t>(2 * most[0] * most[1] * most[2]), -1);
    const auto key = [&](int body, int x, int y, int z) -> idx_t* {
      if (std::min({x, y, z}) < 0 || x >= most[0] || y >= most[1] || z >= most[2]) return nullptr;
      return &number[static_cast<std::size_t>(((body * most[1] + y) * most[2] + z) * most[0] + x)];
    };
    struct Cube {
      int body, x, y, z;
    };
    std::vector<Cube> cubes;
    for (std::size_t i = 0; i < scene.size(); ++i) {
      const Cell& c = scene.cell(i);
      const Cube cube{scene.body(i), c[0] / edge, c[1] / edge, c[2] / edge};
      idx_t& k = *key(cube.body, cube.x, cube.y, cube.z);
      if (k < 0) {
        k = static_cast<idx_t>(cubes.size());
        cubes.push_back(cube);
        weight_.push_back(0);
      }
      cube_of_[i] = k;
      ++weight_[static_cast<std::size_t>(k)];
    }
    begin_.push_back(0);
    for (const Cube& cube : cubes) {
      for (int n = 0; n < (contact_weight > 0 ? 54 : 27); ++n) {
        const int dx = n % 3 - 1, dy = n / 3 % 3 - 1, dz = n / 9 % 3 - 1,
                  other_body = n < 27 ? cube.body : 1 - cube.body;
        // Of the other body, one layer of cubes is in touch, in the same row of cubes or the next.
        const int apart = std::abs(dx) + std::abs(dy) + (other_body == cube.body ? std::abs(dz) : 1);
        const idx_t* other = apart == 0 ? nullptr : key(other_body, cube.x + dx, cube.y + dy, cube.z + dz);
        if (other == nullptr || *other < 0) continue;
        neighbour_.push_back(*other);
        // Bonds between full cubes that share a face, an edge or a corner.
        const idx_t along = 3 * static_cast<idx_t>(edge) - 2, bonds = apart == 1   ? along * along
                                                                      : apart == 2 ? along
                                                                                   : 1;
        bonds_.push_back(other_body == cube.body ? bonds : contact_weight * bonds);
      }
      begin_.push_back(static_cast<idx_t>(neighbour_.size()));
    }
  }

  /// The part of each particle, of `parts`, with as few bonds between parts as METIS finds. The same on every call.
  [[nodiscard]] std::vector<int> divide(int parts) {
    auto count = static_cast<idx_t>(weight_.size()), wanted = static_cast<idx_t>(parts);
    examples::require(parts >= 1 && wanted <= count, "hmps: ", cube_of_.size(), " particles in ", count,
                      " cubes cannot be divided into ", parts, " parts; use fewer ranks, or more particles");
    std::vector<idx_t> part(weight_.size(), 0);
    if (parts > 1) {
      idx_t constraints = 1, cut = 0, options[METIS_NOPTIONS];
      METIS_SetDefaultOptions(options);
      options[METIS_OPTION_SEED] = 1;
      const int result =
          METIS_PartGraphKway(&count, &constraints, begin_.data(), neighbour_.data(), weight_.data(), nullptr,
                              bonds_.data(), &wanted, nullptr, nullptr, options, &cut, part.data());
      examples::require(result == METIS_OK, "hmps: METIS could not divide ", count, " cubes into ", parts,
                        " parts and returned ", result, "; is there enough memory?");
    }
    std::vector<int> of(cube_of_.size());
    for (std::size_t i = 0; i < of.size(); ++i) of[i] = static_cast<int>(part[static_cast<std::size_t>(cube_of_[i])]);
    return of;
  }

 private:
  std::vector<idx_t> cube_of_;  // of each particle
  std::vector<idx_t> begin_, neighbour_, bonds_, weight_;
};

}  // namespace across_machines
