// SPDX-License-Identifier: MIT
// A block of soft tissue on a plate that is pulled away below it, on any number of ranks of MPI, with the same bits on
// any number. docs/across_machines.md tells how, and when it pays.
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <string>

#include "../common/arguments.hpp"
#include "../common/error.hpp"
#include "../common/streams.hpp"
#include "checkpoint.hpp"
#include "messages.hpp"
#include "partition.hpp"
#include "simulation.hpp"

namespace {

using namespace across_machines;

struct Options {
  double particles = 5000, dt = 2e-5;
  std::uint64_t steps = 200, every = 100;
  std::string out = "across_machines.state";
  bool resume = false, plain = false, network = false;
};

/// Says what it is and ends all ranks: the others may wait for messages that will never come.
[[noreturn]] void give_up(const Ranks& ranks, const char* reason) {
  std::cerr << "across_machines: rank " << ranks.rank << " of " << ranks.size << ": " << reason << std::endl;
  MPI_Abort(ranks.comm, 1);
  std::exit(1);
}

/// Rank 0 divides the scene, so that no rank can come to another division.
std::vector<int> divide(const Scene& scene, const Ranks& ranks) {
  std::vector<int> part_of(scene.size(), 0);
  if (ranks.rank == 0) part_of = CubeGraph(scene, 1).divide(ranks.size);
  MPI_Bcast(part_of.data(), static_cast<int>(part_of.size()), MPI_INT, 0, ranks.comm);
  return part_of;
}

/// The state at the start, on all ranks; returns the step that it is the end of.
std::uint64_t start(const Options& options, const Scene& scene, const Ranks& ranks, State& state) {
  for (std::size_t i = 0; i < scene.size(); ++i) state.x.push_back(scene.reference(i));
  state.v.assign(scene.size(), Vector::Zero());
  if (!options.resume) return 0;
  std::uint64_t step = 0;
  if (ranks.rank == 0) step = read_checkpoint(options.out, {scene.size(), options.dt}, state);
  MPI_Bcast(&step, 1, MPI_UINT64_T, 0, ranks.comm);
  for (auto* vectors : {&state.x, &state.v})
    MPI_Bcast(vectors->data(), static_cast<int>(3 * vectors->size()), MPI_DOUBLE, 0, ranks.comm);
  return step;
}

void report(const Ranks& ranks, const Simulation& simulation, std::uint64_t step, double dt) {
  const ContactOfRank& contact = simulation.contact();
  std::uint64_t counts[] = {contact.touching(), contact.late(), contact.gathered() == 0 ? 1U : 0U}, sums[3];
  MPI_Reduce(counts, sums, 3, MPI_UINT64_T, MPI_SUM, 0, ranks.comm);
  if (ranks.rank != 0) return;
  std::printf("step %llu, t = %.5f s: %llu particles feel contact, %llu ranks have none, after %zu surveys\n",
              static_cast<unsigned long long>(step), static_cast<double>(step) * dt,
              static_cast<unsigned long long>(sums[0]), static_cast<unsigned long long>(sums[2]), contact.surveys());
  if (sums[1] > 0)
    std::printf("  contact was seen late %llu times: bits may depend on the number of ranks; try a smaller step\n",
                static_cast<unsigned long long>(sums[1]));
  std::fflush(stdout);
}

/// Refuses at once a file that could not be written hours later.
void require_place(const std::string& out) {
  examples::require(!out.empty() && !std::filesystem::is_directory(out), "hmps: --out is '", out,
                    "', which is no name of a file; give one");
  const std::filesystem::path folder = std::filesystem::absolute(out).parent_path();
  examples::require(std::filesystem::is_directory(folder), "hmps: the folder ", folder.string(), " of --out ", out,
                    " does not exist; make it, or give a file in another one");
}

void run(const Options& options, const Ranks& ranks) {
  if (ranks.rank == 0) require_place(options.out);
  const Scene scene(options.particles);
  const RunSettings settings{scene.size(), options.dt};
  State state;
  const std::uint64_t first = start(options, scene, ranks, state);
  examples::require(first <= options.steps, "hmps: ", options.out, " is of step ", first, ", which is beyond --steps ",
                    options.steps, "; give a larger --steps, or start anew without --resume");
  if (options.plain) {
    examples::require(ranks.size == 1, "hmps: --plain is for one rank, but there are ", ranks.size);
    run_plainly(scene, options.dt, first, options.steps, state);
    write_checkpoint(options.out, settings, options.steps, state);
    return;
  }
  const std::vector<int> part_of = divide(scene, ranks);
  const std::vector<std::vector<Index>> own = own_particles(part_of, ranks.size);
  const Part part = Cutter(scene).cut(own[static_cast<std::size_t>(ranks.rank)]);
  if (ranks.rank == 0)
    std::printf("%zu particles on %d ranks; rank 0 has %zu, and borrows %zu\n", scene.size(), ranks.size, part.own,
                part.particles.size() - part.own);
  Simulation simulation(scene, ranks, part_of, part, options.dt, state);
  state = {};
  const double begin = MPI_Wtime();
  for (std::uint64_t step = first + 1; step <= options.steps; ++step) {
    simulation.advance(static_cast<double>(step) * options.dt);
    if (step % options.every != 0 && step != options.steps) continue;
    const State all = gather(ranks, own, simulation.state());
    if (ranks.rank == 0) write_checkpoint(options.out, settings, step, all);
    report(ranks, simulation, step, options.dt);
  }
  if (ranks.rank == 0) {
    const double steps = static_cast<double>(options.steps - first), million = 1e-6 * steps;
    const Times& times = simulation.times();
    std::printf("%.3g million particle-steps/s of all ranks\n",
                million * static_cast<double>(scene.size()) / (MPI_Wtime() - begin));
    std::printf("rank 0: %.3g s in the force, %.3g s in contact, %.3g s in surveys, %.3g s in messages and waiting\n",
                times.force, times.contact, times.surveys, times.messages);
    std::printf("rank 0: %.3g million particles/s in the force, %.3g million gathered particles/s in contact\n",
                million * 0.5 * static_cast<double>(part.own + part.held) / times.force,
                million * static_cast<double>(simulation.contact().gathered()) / times.contact);
  }
}

/// Half of the time that a message of 8 bytes takes there and back, and what 1 MB takes more.
void measure_network(const Ranks& ranks) {
  examples::require(ranks.size == 2, "hmps: --measure-network is for two ranks, but there are ", ranks.size);
  const auto seconds = [&](std::size_t bytes, int times) {
    std::vector<char> buffer(bytes);
    const int other = 1 - ranks.rank, size = static_cast<int>(bytes);
    double best = 1e300;
    for (int k = 0; k < times; ++k) {
      const double begin = MPI_Wtime();
      for (const bool sends : {ranks.rank == 0, ranks.rank == 1})
        if (sends)
          MPI_Send(buffer.data(), size, MPI_BYTE, other, 0, ranks.comm);
        else
          MPI_Recv(buffer.data(), size, MPI_BYTE, other, 0, ranks.comm, MPI_STATUS_IGNORE);
      best = std::min(best, 0.5 * (MPI_Wtime() - begin));
    }
    return best;
  };
  const double latency = seconds(8, 2000), megabyte = seconds(1000000, 200);
  if (ranks.rank == 0)
    std::printf("the best of many messages: %.3g us, and %.3g GB/s\n", latency * 1e6, 1e-3 / (megabyte - latency));
}

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("across_machines");
  Options options;
  CLI::App app("A block of soft tissue on a plate that is pulled away, on any number of MPI ranks.", "across_machines");
  app.add_option("--particles", options.particles, "about how many")
      ->capture_default_str()
      ->check(examples::is_decimal());
  app.add_option("--time-step", options.dt, "s")
      ->capture_default_str()
      ->check(examples::within(1e-12, 1, "the time step must lie between 1e-12 and 1 s"));
  constexpr long most = 1'000'000'000'000;
  app.add_option("--steps", options.steps, "up to which step")
      ->capture_default_str()
      ->transform(examples::whole_within(0, most, "the number of steps must lie between 0 and 1e12"));
  app.add_option("--every", options.every, "steps between checkpoints")
      ->capture_default_str()
      ->transform(examples::whole_within(1, most, "the steps between checkpoints must lie between 1 and 1e12"));
  app.add_option("--out", options.out, "the checkpoint, and at the end the result")->capture_default_str();
  app.add_flag("--resume", options.resume, "go on from the checkpoint, on any number of ranks");
  app.add_flag("--plain", options.plain, "on one rank, without parts and messages: the same bits");
  app.add_flag("--measure-network", options.network, "nothing but the time of messages between two ranks");
  CLI11_PARSE(app, argc, argv);
  MPI_Init(&argc, &argv);
  const Ranks ranks;
  try {
    options.network ? measure_network(ranks) : run(options, ranks);
  } catch (const std::exception& error) {
    give_up(ranks, error.what());
  }
  MPI_Finalize();
  return 0;
}
