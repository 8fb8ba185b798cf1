// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "count.hpp"

namespace across_machines {

/// What was measured on one machine: unless given, on an AMD EPYC with AVX-512.
struct Measured {
  double force = 20, contact = 7;       ///< million particles/s of one core
  double latency = 9, bandwidth = 3.8;  ///< us and GB/s between two ranks over TCP

  bool operator==(const Measured&) const = default;
};

/// Where the rates come from.
[[nodiscard]] inline const char* source_of(const Measured& measured) {
  if (measured != Measured{}) return "These are the rates that the command line gave.";
  return R"(The rate of
the force is that of docs/measured/benchmarks.md, mixed, at 300 thousand to a million particles on a quiet machine. The
rate of contact follows from its share of the time of 20,000 particles in touch, on a busy machine (0.33 and 0.49 of the
rate of the force in two runs; 0.35 is used). The figures for messages are those of `--measure-network` on that machine.)";
}

[[nodiscard, gnu::format(printf, 1, 2)]] inline std::string format(const char* pattern, ...) {
  char text[4000];
  va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(text, sizeof(text), pattern, arguments);
  va_end(arguments);
  return text;
}

/// Particles in words of three digits.
[[nodiscard]] inline std::string amount(double n) {
  return n >= 999.5e3 ? format("%.3g M", n * 1e-6) : n >= 999.5 ? format("%.3g k", n * 1e-3) : format("%.0f", n);
}

inline const char* const introduction = R"(# Across machines

`examples/across_machines` runs two bodies, control regions and contact on any number of MPI ranks. It uses only the
public interface of the library; no header of hmps includes MPI or the graph partitioner. This page describes the
method, its cost in messages, and the sizes at which it pays. The page is written by
`across_machines_count --counts docs/across_machines.txt --out docs/across_machines.md`. The counts are read from the
text file. If the file is missing, they are counted anew, which takes 170 s on one core and 0.75 GB.

    sudo apt-get install libopenmpi-dev libmetis-dev
    cmake --preset release && cmake --build --preset release --target across_machines across_machines_count
    mpirun -n 4 build/release/examples/across_machines/across_machines --particles 75000 --steps 2000 --out run.state
    mpirun -n 7 build/release/examples/across_machines/across_machines --particles 75000 --steps 4000 --out run.state --resume

If MPI or METIS is missing, CMake omits the example and reports this. `tests/run` does not install them. If they are
installed, it runs the test `examples: across_machines`.

## How a run is divided

- **Parts**: METIS partitions the bond graph into parts of nearly equal size. Few bonds join different parts. Rank 0
  computes the partition and sends the owner of each particle to all ranks (`partition.hpp`).
- **Two layers**: a rank also stores the neighbours of its particles and the neighbours of these. Its `LatticeBonds`
  bonds its own particles and the first layer; `BondSettings::unbonded` permits the second layer to have no bonds.
  `restrict_to` evaluates the force on its own particles alone. After each drift, a rank receives the positions of both
  layers and the velocities of the first layer from the ranks that own them (`messages.hpp`). `mean_dilatation` would
  need two more layers.
- **Contact**: each rank gathers every surface particle that affects the forces on its own particles: those that these
  can meet, those that the former can meet, and so on, four times, because friction depends on the load of both sides
  (`meeting.hpp`). It evaluates contact among the gathered particles and keeps the forces on its own particles. All
  ranks update the list of possible contacts together when a surface particle has moved by a quarter of a spacing or
  has stretched by a twentieth.
- **Checkpoints**: rank 0 collects the state in the order of the scene and replaces the file atomically. Any number of
  ranks can resume the run.

## The same bits on any number of ranks

On any number of ranks, a run gives the same bits as a program on one machine without messages (`--plain`). Three
properties guarantee this:

- The sums over the bonds of a `LatticeBonds` follow the offsets of the lattice. Their order depends on the axes of the
  sweeps, which are chosen to suit the particles. `BondSettings::axes` gives every part the axes of the whole body
  (`lattice_axes`).
- The force subtracts the displacement of one particle before it rounds displacements to float.
  `Blocks::subtract_displacement` gives every part the displacement that is subtracted in the whole body. The owner of
  that particle sends it to all ranks before each step.
- The sums of contact follow the numbers of the particles, and the gathered particles keep the order of the scene.
  Slaves at the rim of the gathered particles are left out, so that no row lacks a master.

`BondList` does not have this property: its neighbour order depends on all particles. If `ContactReport::late` is not
zero, contact has detected a touch late, and the bits may depend on the number of ranks; the program reports this.

## Errors

Each of these errors ends the run with a message that names the rank, and leaves the latest checkpoint intact: a rank
that dies (mpirun names its signal and ends the others), a state that is not finite, a particle lost in a wall, a part
without particles, and a checkpoint that is damaged or belongs to another run. A rank without contact continues
normally.

Limits: every rank makes the whole scene once, at the start, and rank 0 makes the graph of all bonds, so the memory of
one machine limits the size. The partition is computed once, at the start of the run. Parts are balanced by the number
of particles, not by contact. Communication does not overlap computation. Each rank uses one thread.
)";

/// A table of all sizes and numbers of parts: `cell(count)` is the text of each.
template <class Cell>
[[nodiscard]] std::string table(const std::vector<std::vector<Count>>& all, Cell&& cell) {
  std::size_t longest = 0;
  for (const auto& row : all) longest = std::max(longest, row.size());
  std::string text = "| particles |", line = "|---|";
  for (std::size_t p = 0; p < longest; ++p) {
    text += format(" %d |", 1 << p);
    line += "---|";
  }
  text += "\n" + line + "\n";
  for (const auto& row : all) {
    // By `format`, because g++ 12 warns of a false overlap in "| " + std::string.
    text += format("| %s |", amount(static_cast<double>(row[0].particles)).c_str());
    for (std::size_t p = 0; p < longest; ++p)
      text += p < row.size() ? format(" %s |", std::string(cell(row[p], row[0])).c_str()) : " |";
    text += "\n";
  }
  return text;
}

[[nodiscard]] inline std::string kilobytes(double bytes) {
  return bytes >= 999.5e3 ? format("%.3g M", bytes * 1e-6) : format("%.3g k", bytes * 1e-3);
}

[[nodiscard]] inline std::string counted(const std::vector<std::vector<Count>>& all, int contact_weight) {
  std::string text = R"(
## Counted

The scene is counted at its start, when the block lies on the plate. Each column is a number of parts. A row shows
strong scaling. Each row has four times the particles of the row below it, so two columns to the right and one row up
show weak scaling. Up to 400 thousand particles METIS partitions the graph of the particles; beyond that, the graph of
cubes with 2 particles along each side, and beyond three million with 4. Cubes that touch across the contact are joined
in the graph, )" + std::to_string(contact_weight) +
                     R"( times as strongly as by bonds (`--contact-weight`; 0: not at all).

Largest number of bytes that a part receives in each step for its two layers (48 for a particle of the first layer, 24
of the second):

)";
  text += table(all, [](const Count& c, const Count&) { return c.parts == 1 ? "0" : kilobytes(c.bytes); });
  text += "\nThe same for contact (84 for a particle):\n\n";
  text += table(all, [](const Count& c, const Count&) { return c.parts == 1 ? "0" : kilobytes(c.contact); });
  text += "\nBytes that all parts receive together:\n\n";
  text += table(all, [](const Count& c, const Count&) { return c.parts == 1 ? "0" : kilobytes(c.all_bytes); });
  text += "\nLargest number of parts that send to one part:\n\n";
  text += table(all, [](const Count& c, const Count&) { return format("%zu", c.peers); });
  text += "\nBalance, the particles of the largest part over the mean:\n\n";
  text += table(all, [](const Count& c, const Count&) { return format("%.2f", c.balance()); });
  text += "\nLargest number of surface particles that one part gathers for contact, including its own:\n\n";
  text += table(all, [](const Count& c, const Count&) { return amount(static_cast<double>(c.gathered)); });
  text += "\nNumber of parts without contact:\n\n";
  text += table(all, [](const Count& c, const Count&) { return format("%zu", c.without_contact); });
  return text;
}

/// How many particles a scene needs so that 2^`doublings` machines are `gain` times as fast as one, between the sizes
/// counted: 0 where fewer than the least of them, infinity where more than the most, nothing where no size was counted
/// in so many parts.
[[nodiscard]] inline std::optional<double> stay_below(const std::vector<std::vector<Count>>& all, const Rates& rates,
                                                      const Network& network, std::size_t doublings, double gain) {
  double above = std::numeric_limits<double>::infinity(), gain_above = 0;
  for (const auto& row : all) {  // the largest first
    if (row.size() <= doublings) break;
    const double n = static_cast<double>(row[0].particles),
                 own = time_of_step(row[0], rates, network) / time_of_step(row[doublings], rates, network);
    if (own < gain) {
      if (!std::isfinite(above)) return above;
      return std::exp(std::log(n) + (std::log(above) - std::log(n)) * (gain - own) / (gain_above - own));
    }
    above = n;
    gain_above = own;
  }
  if (!std::isfinite(above)) return std::nullopt;
  return 0;
}
[[nodiscard]] inline std::string needed(const std::optional<double>& particles) {
  if (!particles) return "not counted in so many parts";
  return *particles == 0 ? "fewer than counted" : std::isinf(*particles) ? "more than counted" : amount(*particles);
}

[[nodiscard]] inline std::string modelled(const std::vector<std::vector<Count>>& all, const Measured& m) {
  const std::vector<Network> networks{{"TCP between two ranks here, measured", m.latency * 1e-6, m.bandwidth * 1e9},
                                      {"Ethernet of 1 Gb/s, 50 us, assumed", 50e-6, 0.11e9},
                                      {"Ethernet of 25 Gb/s, 15 us, assumed", 15e-6, 2.8e9},
                                      {"InfiniBand of 200 Gb/s, 2 us, assumed", 2e-6, 22e9}};
  std::string text = "\n## Modelled\n\n";
  text += format(
      "One core evaluates %.3g million particles/s without contact and %.3g million gathered particles/s in contact.\n"
      "A message between two ranks over TCP takes %.3g us, at %.3g GB/s. %s\n\n"
      "Each part runs on its own machine. A step takes as long as its slowest part:\n\n"
      "    (own + first layer / 2) / force rate / cores + gathered / contact rate / cores\n"
      "      + (2 + 3 log2 parts) latency + bytes / bandwidth\n\n"
      "The model assumes that the cores of a machine share its work evenly; because each rank of the example uses one\n"
      "thread, this requires several ranks on each machine. Updates of the list of possible contacts are left out;\n"
      "the example prints their time. The figures of all other networks are assumed. Nothing was run on more than\n"
      "one machine.\n",
      m.force, m.contact, m.latency, m.bandwidth, source_of(m));
  for (const double cores : {2., 32.}) {
    const Rates rates{m.force * 1e6, m.contact * 1e6, cores};
    const Network& network = cores > 2 ? networks[2] : networks[0];
    text += format("\nSpeed relative to one machine, with %.0f cores each, %s:\n\n", cores, network.name);
    text += table(all, [&](const Count& c, const Count& one) {
      return format("%.3g", time_of_step(one, rates, network) / time_of_step(c, rates, network));
    });
  }
  text +=
      "\nNumber of particles from which two machines are 1.5 times as fast as one, and 16 machines 8 times as "
      "fast:\n\n";
  text +=
      "| network | 2 cores: two machines | 16 machines | 32 cores: two machines | 16 machines "
      "|\n|---|---|---|---|---|\n";
  for (const Network& network : networks) {
    text += format("| %s |", network.name);
    for (const double cores : {2., 32.})
      for (const auto& [doublings, gain] : {std::pair<std::size_t, double>{1, 1.5}, {4, 8.}})
        text +=
            format(" %s |",
                   needed(stay_below(all, {m.force * 1e6, m.contact * 1e6, cores}, network, doublings, gain)).c_str());
    text += "\n";
  }
  text += "\nUse one machine for scenes with fewer particles than the number for two machines.\n";
  return text;
}

[[nodiscard]] inline std::string page_of(const std::vector<std::vector<Count>>& all, const Measured& measured,
                                         int contact_weight) {
  return introduction + counted(all, contact_weight) + modelled(all, measured);
}

}  // namespace across_machines
