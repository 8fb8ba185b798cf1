// SPDX-License-Identifier: MIT
// Counts what across_machines would send and how even its parts are, for 1 to 1024 parts, and models the time of a step
// from measured rates: writes docs/across_machines.md. Needs no MPI.
#include <CLI/CLI.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <hmps/output/file_replacement.hpp>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

#include "../common/error.hpp"
#include "../common/files.hpp"
#include "count.hpp"
#include "page.hpp"

namespace {

using namespace across_machines;

/// All counts of one size: for 1, 2, 4, ... parts, until a part would have less than 64 particles.
std::vector<Count> counts_of(double particles, int most, int contact_weight) {
  const Scene scene(particles);
  const std::vector<SurfaceParticle> surface = scene.surface();
  std::vector<hmps::Vector<double, 3>> place;
  for (const SurfaceParticle& s : surface) place.push_back(scene.reference(s.particle));
  const int edge = particles > 3e6 ? 4 : particles > 4e5 ? 2 : 1;
  CubeGraph graph(scene, edge, contact_weight);
  std::vector<Count> counts;
  for (int parts = 1; parts <= most && scene.size() / static_cast<std::size_t>(parts) >= 64; parts *= 2) {
    counts.push_back(count(scene, graph, surface, place, parts));
    const Count& c = counts.back();
    std::fprintf(stderr, "%zu particles in %d parts: balance %.3f, %.0f + %.0f bytes\n", c.particles, parts,
                 c.balance(), c.bytes, c.contact);
  }
  return counts;
}

/// The counts in the file at `path`, of one size in each line.
std::vector<std::vector<Count>> read_counts(const std::string& path) {
  std::vector<std::vector<Count>> all;
  std::istringstream lines(examples::read_file(path));
  std::string line;
  std::getline(lines, line);  // the header
  for (Count c; std::getline(lines, line); c = {}) {
    std::istringstream fields(line);
    const bool read = static_cast<bool>(fields >> c.particles >> c.parts >> c.own >> c.layer >> c.gathered >> c.peers >>
                                        c.without_contact >> c.bytes >> c.contact >> c.all_bytes);
    examples::require(read && (c.parts == 1 || !all.empty()), "hmps: cannot read a line of ", path, ": ", line);
    if (c.parts == 1) all.emplace_back();
    all.back().push_back(c);
  }
  examples::require(!all.empty(), "hmps: there are no counts in ", path);
  return all;
}

void write_counts(const std::string& path, const std::vector<std::vector<Count>>& all) {
  std::ostringstream text;
  text << "particles parts own layer gathered peers without_contact bytes contact all_bytes\n" << std::setprecision(15);
  for (const auto& row : all)
    for (const Count& c : row)
      text << c.particles << ' ' << c.parts << ' ' << c.own << ' ' << c.layer << ' ' << c.gathered << ' ' << c.peers
           << ' ' << c.without_contact << ' ' << c.bytes << ' ' << c.contact << ' ' << c.all_bytes << '\n';
  hmps::replace_file(path, text.str());
}

}  // namespace

int main(int argc, char** argv) {
  Measured measured;
  double largest = 20e6;
  int most = 1024, sizes = 7;
  int contact_weight = static_cast<int>(CubeGraph::usual_contact_weight);
  std::string counts, out;
  CLI::App app("Counts the messages and the balance of across_machines, and models its time.", "across_machines_count");
  app.add_option("--largest", largest, "particles of the largest scene; each next has a quarter")
      ->capture_default_str();
  app.add_option("--sizes", sizes, "how many scenes")->capture_default_str()->check(CLI::Range(1, 8));
  app.add_option("--parts", most, "up to how many parts")->capture_default_str()->check(CLI::Range(1, 1 << 20));
  CLI::Option* weight = app.add_option("--contact-weight", contact_weight,
                                       "of cubes in touch over that of bonded ones, for METIS; 0 does not join them")
                            ->capture_default_str()
                            ->check(CLI::Range(0, 1000));
  app.add_option("--force-rate", measured.force, "million particles/s of one core: all but contact and messages")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--contact-rate", measured.contact, "million gathered particles/s of one core in contact")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--latency", measured.latency, "us of a message between two ranks over TCP, as measured")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--bandwidth", measured.bandwidth, "GB/s between two ranks over TCP, as measured")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--counts", counts, "reads the counts from this file or, if it is not there, writes them to it")
      ->type_name("FILE")
      ->excludes(weight);  // which the file does not tell
  app.add_option("--out", out, "the page; without it, it goes to standard output")->type_name("FILE");
  CLI11_PARSE(app, argc, argv);
  try {
    std::vector<std::vector<Count>> all;
    if (!counts.empty() && std::filesystem::exists(counts)) {
      all = read_counts(counts);
    } else {
      for (int s = 0; s < sizes; ++s) all.push_back(counts_of(largest / std::pow(4, s), most, contact_weight));
      if (!counts.empty()) write_counts(counts, all);
    }
    const std::string page = page_of(all, measured, contact_weight);
    if (out.empty())
      std::cout << page;
    else
      hmps::replace_file(out, page);
  } catch (const std::exception& error) {
    std::cerr << "across_machines_count: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
