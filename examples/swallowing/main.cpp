// SPDX-License-Identifier: MIT
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <future>
#include <iostream>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "../common/error.hpp"
#include "../common/files.hpp"
#include "../common/folder_lock.hpp"
#include "../common/streams.hpp"
#include "options.hpp"
#include "output/comparison.hpp"
#include "output/fingerprint.hpp"
#include "output/fitted_file.hpp"
#include "output/mechanisms.hpp"
#include "output/model.hpp"
#include "output/pictures.hpp"
#include "output/progress.hpp"
#include "run_case.hpp"
#include "waiting.hpp"

namespace swallowing {
namespace {

void report(const Summary& summary) {
  std::cout << summary.case_name << ": ";
  if (summary.fold_time)
    std::cout << "folds below the horizontal at " << *summary.fold_time << " s";
  else
    std::cout << "does not fold until " << summary.time << " s";
  std::cout << ", smallest tip angle " << summary.tip_angle_min << " degrees; ";
  if (const auto& nearest = summary.nearest_to_limit)
    std::cout << "the step was at most " << std::round(100 * nearest->share) << " % of its limit (at " << nearest->time
              << " s, " << nearest->organ << "); ";
  std::cout << "took " << duration(summary.wall_seconds) << '\n';
  if (summary.failure) std::cerr << summary.case_name << " stopped: " << *summary.failure << '\n';
}

/// Throws `InputError` if another process is running one of the cases in the same folder: before the first case begins,
/// not only when it is the turn of the last.
void require_free_folders(const Options& options) {
  for (const std::string& name : options.cases) {
    const auto folder = std::filesystem::path(options.out) / name;
    examples::prepare_folder(folder);
    const examples::FolderLock lock(folder);
  }
}

/// Writes the comparison of all cases in the output folder that were run with these settings, including earlier runs.
void compare_cases(const Options& options) {
  const std::filesystem::path out(options.out);
  const examples::FolderLock lock(out, examples::FolderLock::Taken::wait);
  const auto results = read_results(out, shared_settings(options));
  for (std::size_t i = 0; i < results.size(); ++i)
    if (const auto& reason = results[i].left_out; !reason.empty())
      std::cerr << cases[i].name << " is left out of table2.md: it was run with " << reason << '\n';
  write_table2(out / "table2.md", results);
  write_mechanisms(out / "mechanisms.md", results);
  draw_fold(out / "fold.png", results);
  for (const char* picture : {"outlines.png", "model.png"}) std::filesystem::remove(out / picture);
  if (results[0].summary && results[2].summary)
    draw_outlines(out / "outlines.png", {{{"X1", out / "X1" / "snapshots"}, {"Y1", out / "Y1" / "snapshots"}}});
  // Model X comes first; it has one region more.
  const auto first = std::find_if(results.begin(), results.end(), [](const auto& r) { return r.summary.has_value(); });
  if (first == results.end()) return;
  const std::string name = first->summary->case_name;
  if (const auto at_rest = load_snapshot(out / name / "snapshots", 0))
    (void)draw_model(out / "model.png", *at_rest,
                     examples::message("Organs and control regions of case ", name, " at rest, spacing ",
                                       1e3 * at_rest->spacing, " mm"));
}

/// The particles of all cases: those of the run that is resumed, or a new fit, which is kept in the output folder.
FittedOrgans fitted_organs(const Options& options) {
  const std::filesystem::path out(options.out);
  const examples::FolderLock lock(out, examples::FolderLock::Taken::wait);
  if (options.resume)
    if (auto fitted = read_fitted(out, options.spacing)) return *std::move(fitted);
  std::cerr << "fitting particles to the organs\n";
  FittedOrgans fitted = fit_organs(options.spacing, options.threads);
  write_fitted(out, fitted, options.spacing);
  return fitted;
}

/// Runs the cases, as many at a time as there are threads: cases need not wait for each other, whereas the threads of
/// one case do so several times in a step. Returns whether all cases reached their end.
bool run_cases(const Options& options) {
  Options one = options;
  const auto workers = std::min(options.cases.size(), static_cast<std::size_t>(options.threads));
  one.threads = options.threads / static_cast<int>(workers);
  one.bar = options.bar && workers == 1;

  std::optional<FittedOrgans> fitted;
  if (options.fitted) fitted = fitted_organs(options);

  SharedOrgans surfaces;
  std::atomic<std::size_t> next = 0;
  std::mutex reporting;
  bool all_ended = true;
  const auto work = [&] {
    for (std::size_t k = next++; k < options.cases.size(); k = next++) {
      const Case& chosen = find_case(options.cases[k]);
      const Summary summary =
          run_case(one, chosen, fitted ? &*fitted : nullptr, options.surfaces ? &surfaces : nullptr);
      const std::lock_guard lock(reporting);
      report(summary);
      all_ended = all_ended && !summary.failure;
    }
  };
  std::vector<std::future<void>> running;
  for (std::size_t w = 0; w < workers; ++w) running.push_back(std::async(std::launch::async, work));
  for (auto& worker : running) worker.get();
  return all_ended;
}

}  // namespace
}  // namespace swallowing

int main(int argc, char** argv) {
  using namespace swallowing;
  examples::check_standard_streams("swallowing");
  int exit_code = 0;
  const auto options = parse_options(argc, argv, std::cout, std::cerr, exit_code);
  if (!options) return exit_code;
  wait_shortly_if_busy(options->threads, argv);
  try {
    require_free_folders(*options);
    if (!run_cases(*options)) exit_code = 1;
    compare_cases(*options);
  } catch (const std::exception& error) {
    std::cerr << "swallowing: " << error.what() << '\n';
    return 2;
  }
  return exit_code;
}
