// SPDX-License-Identifier: MIT
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "../common/files.hpp"
#include "comparison.hpp"
#include "options.hpp"
#include "progress.hpp"
#include "run_case.hpp"

int main(int argc, char** argv) {
  using namespace swallowing;
  int exit_code = 0;
  const auto options = parse_options(argc, argv, std::cout, std::cerr, exit_code);
  if (!options) return exit_code;
  try {
    const std::filesystem::path out(options->out);
    examples::prepare_folder(out);
    for (const auto& name : options->cases) {
      const Summary summary = run_case(*options, find_case(name));
      std::cout << name << ": ";
      if (summary.fold_time)
        std::cout << "folds below the horizontal at " << *summary.fold_time << " s";
      else
        std::cout << "does not fold until " << summary.time << " s";
      std::cout << ", smallest tip angle " << summary.tip_angle_min << " degrees; took "
                << duration(summary.wall_seconds) << '\n';
      if (summary.failure) {
        std::cerr << name << " stopped: " << *summary.failure << '\n';
        exit_code = 1;
      }
    }
    const auto results = read_results(out);
    write_table2(out / "table2.md", results);
    draw_fold(out / "fold.png", results);
  } catch (const std::exception& error) {
    std::cerr << "swallowing: " << error.what() << '\n';
    return 2;
  }
  return exit_code;
}
