// SPDX-License-Identifier: MIT
#pragma once

#include <mpi.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

#include "../common/error.hpp"
#include "scene.hpp"

namespace across_machines {

/// All ranks of the run. A call of MPI that fails ends the run with the message of MPI itself.
struct Ranks {
  MPI_Comm comm = MPI_COMM_WORLD;
  int rank = 0, size = 1;

  Ranks() {
    MPI_Comm_rank(comm, &rank);
    MPI_Comm_size(comm, &size);
  }
};

/// A particle that is wanted from another rank: its number in the scene, and where it goes here.
struct Wanted {
  Index particle, target;
};

/// What one other rank gives and gets in each exchange.
struct Peer {
  int rank;
  std::vector<Index> send, receive;               ///< places in the arrays here
  std::size_t send_first = 0, receive_first = 0;  ///< how many of them are of the first kind
  std::vector<char> outgoing{}, incoming{};
};

/// Tells all ranks which particles this one wants: those of the `first` kind, then those of the `second`. `owner(i)` is
/// the rank of a particle, `place(i)` where a particle of this rank is in its arrays. Every rank has to call it.
template <class Owner, class Place>
[[nodiscard]] std::vector<Peer> introduce(const Ranks& ranks, const std::vector<Wanted>& first,
                                          const std::vector<Wanted>& second, Owner&& owner, Place&& place) {
  const auto size = static_cast<std::size_t>(ranks.size);
  std::vector<std::vector<Index>> wanted(size), targets(size);
  std::vector<int> counts(2 * size, 0), asked(2 * size);  // of both kinds, then of the first, for each rank
  for (const auto* kind : {&first, &second})
    for (const Wanted& w : *kind) {
      const auto r = static_cast<std::size_t>(owner(w.particle));
      wanted[r].push_back(w.particle);
      targets[r].push_back(w.target);
      ++counts[2 * r];
      counts[2 * r + 1] += kind == &first;
    }
  MPI_Alltoall(counts.data(), 2, MPI_INT, asked.data(), 2, MPI_INT, ranks.comm);
  std::vector<int> sizes(size), begins(size, 0), asked_sizes(size), asked_begins(size, 0);
  std::vector<Index> all, all_asked;
  for (std::size_t r = 0; r < size; ++r) {
    sizes[r] = counts[2 * r];
    asked_sizes[r] = asked[2 * r];
    begins[r] = static_cast<int>(all.size());
    all.insert(all.end(), wanted[r].begin(), wanted[r].end());
    if (r > 0) asked_begins[r] = asked_begins[r - 1] + asked_sizes[r - 1];
  }
  all_asked.resize(static_cast<std::size_t>(asked_begins.back() + asked_sizes.back()));
  MPI_Alltoallv(all.data(), sizes.data(), begins.data(), MPI_UINT32_T, all_asked.data(), asked_sizes.data(),
                asked_begins.data(), MPI_UINT32_T, ranks.comm);
  std::vector<Peer> peers;
  for (std::size_t r = 0; r < size; ++r) {
    if (sizes[r] + asked_sizes[r] == 0) continue;
    Peer peer{static_cast<int>(r), {}, targets[r]};
    for (int k = 0; k < asked_sizes[r]; ++k)
      peer.send.push_back(place(all_asked[static_cast<std::size_t>(asked_begins[r] + k)]));
    peer.send_first = static_cast<std::size_t>(asked[2 * r + 1]);
    peer.receive_first = static_cast<std::size_t>(counts[2 * r + 1]);
    peers.push_back(std::move(peer));
  }
  return peers;
}

/// One exchange with all peers: `put(place, bytes)` writes what is sent of a particle here and `take(place, bytes)`
/// reads what came; `first` and `second` are the bytes for a particle of each kind, and what is of the first comes
/// first.
template <class Put, class Take>
void exchange(const Ranks& ranks, std::vector<Peer>& peers, std::size_t first, std::size_t second, Put&& put,
              Take&& take) {
  const auto bytes = [&](std::size_t all, std::size_t of_first) {
    return of_first * first + (all - of_first) * second;
  };
  const auto length = [](const std::vector<char>& buffer) {
    examples::require(buffer.size() <= static_cast<std::size_t>(std::numeric_limits<int>::max()), "hmps: a message of ",
                      buffer.size(), " bytes is longer than MPI can send; use more ranks");
    return static_cast<int>(buffer.size());
  };
  std::vector<MPI_Request> requests;
  for (Peer& peer : peers) {
    peer.incoming.resize(bytes(peer.receive.size(), peer.receive_first));
    if (!peer.incoming.empty())
      MPI_Irecv(peer.incoming.data(), length(peer.incoming), MPI_BYTE, peer.rank, 0, ranks.comm,
                &requests.emplace_back());
  }
  for (Peer& peer : peers) {
    peer.outgoing.resize(bytes(peer.send.size(), peer.send_first));
    for (std::size_t k = 0; k < peer.send.size(); ++k)
      put(peer.send[k], peer.outgoing.data() + bytes(k, std::min(k, peer.send_first)), k < peer.send_first);
    if (!peer.outgoing.empty())
      MPI_Isend(peer.outgoing.data(), length(peer.outgoing), MPI_BYTE, peer.rank, 0, ranks.comm,
                &requests.emplace_back());
  }
  MPI_Waitall(static_cast<int>(requests.size()), requests.data(), MPI_STATUSES_IGNORE);
  for (Peer& peer : peers)
    for (std::size_t k = 0; k < peer.receive.size(); ++k)
      take(peer.receive[k], peer.incoming.data() + bytes(k, std::min(k, peer.receive_first)), k < peer.receive_first);
}

/// The largest of each number over all ranks.
template <std::size_t N>
void largest(const Ranks& ranks, std::array<double, N>& values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(N), MPI_DOUBLE, MPI_MAX, ranks.comm);
}

}  // namespace across_machines
