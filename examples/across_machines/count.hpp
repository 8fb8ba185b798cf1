// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include <hmps/contact/metaball.hpp>

#include "meeting.hpp"
#include "partition.hpp"
#include "scene.hpp"

namespace across_machines {

/// Bytes of a borrowed particle in each step: of the first layer position and velocity, of the second the position, and
/// for contact also the deformation gradient in float.
inline constexpr double first_bytes = 48, second_bytes = 24, contact_bytes = 84;

/// What a scene costs in parts, at its start: the most that any part has, and sums over all.
struct Count {
  std::size_t particles = 0;
  int parts = 1;
  std::size_t own = 0;              ///< particles, in the largest part
  std::size_t layer = 0;            ///< of the first layer, in the part with most of them
  std::size_t gathered = 0;         ///< surface particles in the contact of the part with most of them
  std::size_t peers = 0;            ///< parts that a part gets messages from
  std::size_t without_contact = 0;  ///< parts
  double bytes = 0, contact = 0;    ///< received in a step by the part with most: of bonds, of contact
  double all_bytes = 0;             ///< received in a step by all parts, of bonds and contact

  /// The largest part over the mean.
  [[nodiscard]] double balance() const { return static_cast<double>(own) * parts / static_cast<double>(particles); }
};

/// Counts `scene` in `parts`, divided by METIS along cubes of particles with `edge` of them along each side.
[[nodiscard]] inline Count count(const Scene& scene, CubeGraph& graph, const std::vector<SurfaceParticle>& surface,
                                 const std::vector<hmps::Vector<double, 3>>& place, int parts) {
  Count most{scene.size(), parts};
  const std::vector<int> part_of = graph.divide(parts);
  const std::vector<std::vector<Index>> own = own_particles(part_of, parts);
  // As in a survey at the start, where nothing is stretched.
  const double reach = 1.1 * hmps::SmoothMetaball::radius * l0 + 0.5 * l0;
  Cutter cutter(scene);
  std::vector<char> is_peer;
  for (int p = 0; p < parts; ++p) {
    const Part part = parts > 1 ? cutter.cut(own[static_cast<std::size_t>(p)]) : Part{{}, own[0].size(), own[0].size()};
    is_peer.assign(static_cast<std::size_t>(parts), 0);
    for (std::size_t k = part.own; k < part.particles.size(); ++k)
      is_peer[static_cast<std::size_t>(part_of[part.particles[k]])] = 1;
    const std::vector<Gathered> gathered =
        what_meets(surface, place, reach, [&](std::size_t k) { return part_of[surface[k].particle] == p; });
    std::size_t foreign = 0;
    for (const Gathered& g : gathered) {
      const int owner = part_of[surface[g.entry].particle];
      if (owner == p) continue;
      ++foreign;
      is_peer[static_cast<std::size_t>(owner)] = 1;
    }
    const double first = static_cast<double>(part.held - part.own),
                 second = parts > 1 ? static_cast<double>(part.particles.size() - part.held) : 0,
                 bytes = first * first_bytes + second * second_bytes,
                 contact = static_cast<double>(foreign) * contact_bytes;
    most.own = std::max(most.own, part.own);
    most.layer = std::max(most.layer, part.held - part.own);
    most.gathered = std::max(most.gathered, gathered.size());
    most.peers = std::max(most.peers, static_cast<std::size_t>(std::count(is_peer.begin(), is_peer.end(), 1)));
    most.without_contact += gathered.empty() ? 1 : 0;
    most.bytes = std::max(most.bytes, bytes);
    most.contact = std::max(most.contact, contact);
    most.all_bytes += bytes + contact;
  }
  return most;
}

/// A network between machines.
struct Network {
  const char* name;
  double latency, bandwidth;  ///< s of a message; bytes/s
};

/// What one machine does, as measured.
struct Rates {
  double force, contact;  ///< particles/s of one core: in the internal force, and gathered in contact
  double cores;           ///< of a machine, that share its work evenly
};

/// s of a step in the slowest part, each part on a machine of its own. A part evaluates the first of the two sweeps of
/// the force for its first layer as well. Two exchanges, a broadcast and a reduction wait for each other; messages of
/// one exchange are under way at once.
[[nodiscard]] inline double time_of_step(const Count& c, const Rates& rates, const Network& network) {
  const double work = (static_cast<double>(c.own) + 0.5 * static_cast<double>(c.layer)) / rates.force +
                      static_cast<double>(c.gathered) / rates.contact;
  if (c.parts == 1) return work / rates.cores;
  const double rounds = std::ceil(std::log2(c.parts));
  return work / rates.cores + (2 + 3 * rounds) * network.latency + (c.bytes + c.contact) / network.bandwidth;
}

}  // namespace across_machines
