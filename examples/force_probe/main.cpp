// SPDX-License-Identifier: MIT
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <hmps/motion/csv.hpp>
#include <hmps/output/file_replacement.hpp>
#include <iostream>
#include <string>
#include <system_error>

#include "../common/arguments.hpp"
#include "../common/csv_writer.hpp"
#include "../common/error.hpp"
#include "../common/streams.hpp"
#include "probe.hpp"

namespace {

using namespace force_probe;

/// The state in a table with the columns X,Y,Z,x,y,z,vx,vy,vz,body in any order.
State read_state(const std::string& path) {
  const hmps::Table table = hmps::read_csv(path);
  const std::size_t X[] = {table.column("X"), table.column("Y"), table.column("Z")},
                    x[] = {table.column("x"), table.column("y"), table.column("z")},
                    v[] = {table.column("vx"), table.column("vy"), table.column("vz")}, body = table.column("body");
  examples::require(table.rows() > 0, path, " has no particles; give a line for each below the header");
  State state;
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const auto triple = [&](const std::size_t(&columns)[3]) {
      return std::array{table(i, columns[0]), table(i, columns[1]), table(i, columns[2])};
    };
    state.reference.push_back(triple(X));
    state.position.push_back(triple(x));
    state.velocity.push_back(triple(v));
    const double number = table(i, body);
    examples::require(number == std::floor(number) && std::abs(number) < 1e9, path, " line ", table.lines[i],
                      ": the body of particle ", i, " is ", number, "; it must be a whole number");
    state.body.push_back(static_cast<int>(number));
  }
  return state;
}

std::string table_of(const Forces& forces) {
  std::string text;
  for (const char* name : {"elastic", "artificial", "viscous", "contact"})
    for (const char axis : {'x', 'y', 'z'}) (((text += name) += '_') += axis) += ',';
  text += "J\n";
  for (std::size_t i = 0; i < forces.J.size(); ++i) {
    std::vector<double> row;
    for (const auto* force : {&forces.elastic, &forces.artificial, &forces.viscous, &forces.contact})
      row.insert(row.end(), (*force)[i].begin(), (*force)[i].end());
    row.push_back(forces.J[i]);
    text += examples::csv_line(row);
  }
  return text;
}

}  // namespace

int main(int argc, char** argv) {
  examples::check_standard_streams("force_probe");
  Settings settings;
  std::string in, out, law = "corrected", scalar = "double";
  CLI::App app(
      "Evaluates the forces of the paper on a state that is given as CSV with the header\n"
      "X,Y,Z,x,y,z,vx,vy,vz,body: reference position, position (m), velocity (m/s) and body (a whole number) of\n"
      "each particle. Writes the force densities (N/m3) and det F of each particle. Bonds join particles of one\n"
      "body; contact, with both roles and reactions, acts between different bodies at the given velocities.",
      "force_probe");
  app.add_option("--in", in, "the state")->type_name("FILE")->required();
  app.add_option("--out", out, "the forces; without it they go to standard output")->type_name("FILE");
  const auto number = [&](const char* name, double& target, const char* unit, const char* help) {
    return app.add_option(name, target, help)->type_name(unit)->capture_default_str()->check(examples::is_decimal());
  };
  number("--spacing", settings.spacing, "M", "spacing l0 of the particles")->check(CLI::PositiveNumber);
  number("--young", settings.young, "PA", "Young's modulus E")->check(CLI::PositiveNumber);
  const auto* hat = app.add_option("--young-hat", settings.young_hat, "E_hat of the artificial force (default: E)")
                        ->type_name("PA")
                        ->check(examples::is_decimal())
                        ->check(CLI::NonNegativeNumber);
  number("--d1", settings.d1, "PA", "volumetric constant D1")->check(CLI::PositiveNumber);
  number("--density", settings.density, "KG/M3", "density")->check(CLI::PositiveNumber);
  number("--viscosity", settings.viscosity, "M2/S", "kinematic viscosity nu")->check(CLI::NonNegativeNumber);
  number("--friction", settings.friction, "MU", "friction coefficient")->check(CLI::NonNegativeNumber);
  number("--penalty-ratio", settings.penalty_ratio, "K", "spring ratio k~ of the contact")->check(CLI::PositiveNumber);
  number("--time-step", settings.time_step, "S", "time step")->check(CLI::PositiveNumber);
  app.add_option("--friction-law", law, "paper or corrected")
      ->type_name("NAME")
      ->capture_default_str()
      ->check(CLI::IsMember({"paper", "corrected"}));
  app.add_option("--scalar", scalar, "float or double, in which the forces are evaluated")
      ->type_name("TYPE")
      ->capture_default_str()
      ->check(CLI::IsMember({"float", "double"}));
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& problem) {
    if (problem.get_exit_code() == 0) {
      std::cout << app.help();
      return 0;
    }
    std::cerr << "force_probe: " << problem.what() << "\nTry force_probe --help.\n";
    return 2;
  }
  if (hat->empty()) settings.young_hat = settings.young;
  settings.paper_friction = law == "paper";
  try {
    std::error_code missing;
    examples::require(out.empty() || !std::filesystem::equivalent(in, out, missing), out,
                      " is the state itself, which the forces would replace; give --out another name");
    const State state = read_state(in);
    const std::string table =
        table_of(scalar == "float" ? probe<float>(state, settings) : probe<double>(state, settings));
    if (out.empty()) {
      std::cout << table << std::flush;
    } else {
      hmps::replace_file(out, table);
    }
  } catch (const std::exception& error) {
    std::cerr << "force_probe: " << error.what() << '\n';
    return 2;
  }
  return 0;
}
