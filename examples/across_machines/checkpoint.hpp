// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "../common/checksum.hpp"
#include "../common/error.hpp"
#include "../common/files.hpp"
#include "messages.hpp"
#include "simulation.hpp"

namespace across_machines {

/// The settings on which the bits of a run depend.
struct RunSettings {
  std::uint64_t particles = 0;  ///< of the scene
  double dt = 0;                ///< s
};

/// What is on disk: this, then all positions and all velocities in the order of the scene, whatever rank had them, so
/// that any number of ranks can go on, then a checksum.
struct CheckpointHeader {
  char magic[24] = "hmps across_machines 1\n";
  std::uint64_t byte_order = 0x0102030405060708;
  RunSettings settings;
  std::uint64_t step = 0;
};

/// Writes the state at the end of `step`; the file at `path` is whole at any moment.
inline void write_checkpoint(const std::filesystem::path& path, const RunSettings& settings, std::uint64_t step,
                             const State& state) {
  CheckpointHeader header;
  header.settings = settings;
  header.step = step;
  std::string bytes(reinterpret_cast<const char*>(&header), sizeof(header));
  for (const auto* vectors : {&state.x, &state.v})
    bytes.append(reinterpret_cast<const char*>(vectors->data()), vectors->size() * sizeof(Vector));
  const std::uint64_t sum = examples::checksum(bytes);
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof(sum));
  examples::write_atomically(path, bytes);
}

/// Reads what `write_checkpoint` wrote; returns the step. Throws `InputError` for a file that is damaged, of another
/// program, or of a run with other settings.
[[nodiscard]] inline std::uint64_t read_checkpoint(const std::filesystem::path& path, const RunSettings& settings,
                                                   State& state) {
  const std::string bytes = examples::read_file(path);
  const CheckpointHeader expected;
  CheckpointHeader header;
  examples::require(bytes.size() >= sizeof(header) + 8, "hmps: ", path.string(), " is too short for a checkpoint");
  std::memcpy(&header, bytes.data(), sizeof(header));
  examples::require(std::memcmp(header.magic, expected.magic, sizeof(header.magic)) == 0, "hmps: ", path.string(),
                    " is no checkpoint of this version of the program");
  examples::require(header.byte_order == expected.byte_order, "hmps: ", path.string(),
                    " was written on a machine with another order of bytes");
  std::uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + bytes.size() - 8, 8);
  examples::require(sum == examples::checksum(std::string_view(bytes).substr(0, bytes.size() - 8)),
                    "hmps: ", path.string(), " is damaged: its checksum does not match; start anew without --resume");
  examples::require(header.settings.particles == settings.particles && header.settings.dt == settings.dt,
                    "hmps: ", path.string(), " is of a run of ", header.settings.particles,
                    " particles with a time step of ", header.settings.dt, " s, but this one has ", settings.particles,
                    " and ", settings.dt, "; resume with the same settings, or start anew without --resume");
  const std::size_t length = settings.particles * sizeof(Vector);
  examples::require(bytes.size() == sizeof(header) + 2 * length + 8, "hmps: ", path.string(), " has ", bytes.size(),
                    " bytes, which is not the size of its particles");
  std::memcpy(state.x.data()->data(), bytes.data() + sizeof(header), length);
  std::memcpy(state.v.data()->data(), bytes.data() + sizeof(header) + length, length);
  return header.step;
}

/// The state of all particles in the order of the scene, on rank 0. `own` are the particles of each rank.
[[nodiscard]] inline State gather(const Ranks& ranks, const std::vector<std::vector<Index>>& own, const State& part) {
  std::vector<int> counts, begins;
  std::vector<Index> order;
  for (const auto& particles : own) {
    counts.push_back(static_cast<int>(particles.size()));
    begins.push_back(static_cast<int>(order.size()));
    order.insert(order.end(), particles.begin(), particles.end());
  }
  MPI_Datatype vector;
  MPI_Type_contiguous(3, MPI_DOUBLE, &vector);
  MPI_Type_commit(&vector);
  State all;
  for (const auto member : {&State::x, &State::v}) {
    std::vector<Vector> by_rank(ranks.rank == 0 ? order.size() : 0);
    MPI_Gatherv((part.*member).data(), counts[static_cast<std::size_t>(ranks.rank)], vector, by_rank.data(),
                counts.data(), begins.data(), vector, 0, ranks.comm);
    (all.*member).resize(by_rank.size());
    for (std::size_t k = 0; k < by_rank.size(); ++k) (all.*member)[order[k]] = by_rank[k];
  }
  MPI_Type_free(&vector);
  return all;
}

}  // namespace across_machines
