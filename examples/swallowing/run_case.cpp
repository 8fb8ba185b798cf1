// SPDX-License-Identifier: MIT
#include "run_case.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "../common/error.hpp"
#include "../common/files.hpp"
#include "../common/folder_lock.hpp"
#include "output/checkpoint.hpp"
#include "output/contacts.hpp"
#include "output/describe.hpp"
#include "output/effort.hpp"
#include "output/fingerprint.hpp"
#include "output/history.hpp"
#include "output/measure.hpp"
#include "output/motion_digest.hpp"
#include "output/observe.hpp"
#include "output/pictures.hpp"
#include "output/progress.hpp"
#include "output/step_watch.hpp"
#include "scene/build_scene.hpp"
#include "simulation/schedule.hpp"
#include "simulation/simulation.hpp"

namespace swallowing {
namespace {

constexpr double sample_interval = 1e-3;      // s, simulated
constexpr double checkpoint_interval = 0.02;  // s, simulated
constexpr double limit_interval = 0.02;       // s, simulated
constexpr double volume_time = 1.667;         // s, when the paper states det F

template <class S>
class Run {
 public:
  Run(const Options& options, const Case& chosen, const FittedOrgans* fitted, SharedOrgans* surfaces)
      : options_(options),
        surfaces_(surfaces),
        chosen_(chosen),
        friction_(options.friction.value_or(chosen.friction)),
        folder_(prepared(std::filesystem::path(options.out) / chosen.name)),
        lock_(folder_),
        data_(data_folder(options)),
        materials_(Materials{}.stiffened(options.stiffness)),
        motion_(data_),
        scene_(make_scene({.spacing = options.spacing,
                           .lattice_shift = options.lattice_shift,
                           .model = chosen.model,
                           .constrictors = options.constrictors,
                           .drawn_surfaces = !options.paper_contact,
                           .data = data_,
                           .fitted = fitted})),
        motion_so_far_(scene_, motion_),
        simulation_(scene_, motion_, materials_,
                    {.friction = friction_,
                     .time_step = options.time_step,
                     .step_share = options.step_share,
                     .penalty = options.penalty.value_or(0),
                     .penalty_ratio = options.penalty_ratio.value_or(0),
                     .paper_contact = options.paper_contact,
                     .threads = options.threads}),
        settings_(
            fingerprint(options, chosen, fitted, data_, friction_, simulation_.time_step(), simulation_.penalty())) {
    summary_.case_name = chosen.name;
    summary_.scalar = options.single_precision ? "float" : "double";
    summary_.threads = options.threads;
    summary_.spacing = options.spacing;
    summary_.friction = friction_;
    summary_.penalty = simulation_.penalty();
    summary_.paper_contact = options.paper_contact;
    summary_.time_step_min = summary_.time_step_max = simulation_.time_step();
    summary_.time_step_limit = simulation_.step_limit().limit;
    summary_.settings = shared_settings(options);
    for (const int region : scene_.region) ++(region < 0 ? summary_.particles_free : summary_.particles_control);
  }

  Summary operator()() {
    const auto before = options_.resume ? last_checkpoint() : std::nullopt;
    History history(folder_, contacts_header(scene_), options_.frames, options_.frames && surfaces_, before);
    if (before) resume(*before);
    for (const Sample& sample : history.series.samples()) measure(sample);

    if (surfaces_) (void)organs();  // before the first step, so that an error costs no run and none of its time
    accounted_ = std::chrono::steady_clock::now();
    const auto first_step = simulation_.steps();
    Every sample(sample_interval), frame(options_.frame_interval), keep(checkpoint_interval), limit(limit_interval);
    if (before)
      for (Every* what : {&sample, &frame}) what->skip(before->time, simulation_.time_step());
    for (Every* what : {&keep, &limit}) what->skip(simulation_.time(), simulation_.time_step());
    Progress progress(std::cerr, {.name = std::string(chosen_.name),
                                  .start = simulation_.time(),
                                  .until = options_.until,
                                  .particles = scene_.reference.size(),
                                  .terminal = options_.bar && is_terminal()});
    const bool step_is_given = options_.time_step > 0;
    StepWatch<S> watch(simulation_, scene_, summary_, step_is_given);
    std::cerr << describe_step(summary_, simulation_, scene_, step_is_given) << describe_regions(summary_, scene_);
    if (!before) watch.compare(0);
    double smallest_j = 1;
    try {
      for (;;) {
        const double time = simulation_.time(), dt = simulation_.time_step();
        if (sample.due(time, dt)) {
          const Sample now = observe(simulation_, scene_, std::exchange(penetration_, 0) / scene_.spacing);
          smallest_j = now.smallest_j;
          history.series.add(now);
          history.contacts.add(observe_contacts(simulation_, scene_));
          measure(now);
          snap(history, time);
        }
        if (history.frames && frame.due(time, dt)) add_frame(*history.frames, simulation_, scene_);
        if (limit.due(time, dt)) watch.refresh(time);
        if (keep.due(time, dt)) checkpoint(history);
        if (time >= options_.until - dt / 2) break;
        simulation_.step();
        penetration_ = std::max(penetration_, static_cast<double>(simulation_.contact_report().penetration));
        if (simulation_.steps() % 32 == 0) check(simulation_, scene_);
        progress.update(simulation_.time(), simulation_.steps() - first_step, smallest_j);
      }
      checkpoint(history);
    } catch (const hmps::StateError& error) {
      summary_.failure = error.what();
    }
    const auto steps = simulation_.steps() - first_step;
    progress.finish(simulation_.time(), steps, smallest_j);
    account();
    finish();
    draw(history.snapshots);
    return summary_;
  }

 private:
  /// Adds to the effort what was spent since the last call.
  void account() {
    const auto now = std::chrono::steady_clock::now();
    effort_.add(simulation_.time(), std::chrono::duration<double>(now - accounted_).count(),
                simulation_.contact_seconds() - contact_accounted_);
    accounted_ = now;
    contact_accounted_ = simulation_.contact_seconds();
  }
  void measure(const Sample& now) {
    fold_.add(now.time, now.tip_angle);
    fold_base_.add(now.time, now.base_angle);
    summary_.max_penetration = std::max(summary_.max_penetration, now.penetration);
    if (!summary_.det_f && now.time >= volume_time - 1e-9 && std::abs(now.time - simulation_.time()) < 1e-9) {
      const auto J = volume(simulation_, scene_);
      summary_.det_f = DetF{J.mean, J.share_within, J.min, J.max};
    }
  }
  [[nodiscard]] static std::filesystem::path prepared(const std::filesystem::path& folder) {
    examples::prepare_folder(folder);
    return folder;
  }
  void snap(History& history, double time) {
    for (const double moment : snapshot_times) {
      if (std::abs(time - moment) >= sample_interval / 2) continue;
      const Snapshot shot = snapshot(simulation_, scene_);
      history.snapshots.add(moment, shot);
      if (history.surfaces) add_surfaces(*history.surfaces, organs(), shot);
    }
  }
  [[nodiscard]] const CarriedOrgans& organs() { return surfaces_->of(scene_, options_.threads); }
  void draw(const Snapshots& snapshots) {
    draw_sheet(folder_ / "sheet.png", snapshots, title());
    draw_rear(folder_ / "rear.png", snapshots, title() + ": the leaf from behind and the left");
    draw_sections(folder_ / "sections.png", snapshots, title() + ": sections of the pharynx from above");
    if (surfaces_) draw_surfaces(folder_ / "surfaces.png", snapshots, organs(), title() + ": surfaces");
  }
  [[nodiscard]] std::string title() const {
    return examples::message("Case ", chosen_.name, ": model ", chosen_.model == Model::X ? "X" : "Y", ", friction ",
                             friction_, ", spacing ", 1e3 * options_.spacing, " mm");
  }
  void finish() {
    summary_.time = simulation_.time();
    summary_.steps = simulation_.steps();
    summary_.time_step = summary_.time / static_cast<double>(std::max<std::uint64_t>(summary_.steps, 1));
    summary_.fold_time = fold_.time();
    summary_.fold_time_base = fold_base_.time();
    summary_.tip_angle_min = fold_.smallest();
    summary_.wall_seconds = effort_.seconds();
    summary_.particle_steps_per_second =
        static_cast<double>(summary_.steps * scene_.reference.size()) / std::max(summary_.wall_seconds, 1e-9);
    summary_.contact_share = effort_.contact_share();
    summary_.contact_share_per_tenth = effort_.contact_share_per_tenth();
    write_summary(folder_ / "summary.json", summary_);
  }

  [[nodiscard]] std::filesystem::path checkpoint_file() const { return folder_ / "checkpoint.bin"; }
  void checkpoint(History& history) {
    account();
    Checkpoint state;
    history.flush(state);
    state.settings = settings_;
    state.time = simulation_.time();
    state.step = simulation_.steps();
    state.set("positions", positions());
    state.set("velocities", simulation_.velocity_array());
    state.set("penetration", penetration_);
    std::vector<double> volume;
    if (const auto& J = summary_.det_f) volume = {J->mean, J->share_within_0_98_1_02, J->min, J->max};
    state.set("det F", volume);
    std::vector<double> nearest;
    if (const auto& n = summary_.nearest_to_limit)
      nearest = {n->share, n->limit, n->time, static_cast<double>(n->particle)};
    state.set("nearest to limit", nearest);
    state.set("range of steps", std::array{summary_.time_step_min, summary_.time_step_max});
    state.set("motion so far", motion_so_far_.until(state.time));
    state.set("clock", std::array{simulation_.clock()});
    state.set("limiting mode", simulation_.step_limit().mode);
    state.set("seconds", effort_.wall);
    state.set("of them for contact", effort_.contact);
    state.save(checkpoint_file());
  }
  /// The checkpoint to resume from; nothing if the run was stopped before its first checkpoint. Throws `InputError` if
  /// there must have been one, or if it is that of another run.
  [[nodiscard]] std::optional<Checkpoint> last_checkpoint() {
    std::optional<Checkpoint> state = Checkpoint::load(checkpoint_file());
    if (state) {
      const bool same_motion = state->contains("motion so far") &&
                               state->value<std::uint64_t>("motion so far") == motion_so_far_.until(state->time);
      require_same_settings(*state, settings_, checkpoint_file(), same_motion);
      std::cerr << examples::message(chosen_.name, ": resumed at ", state->time, " s\n");
      return state;
    }
    const auto samples = read_series(folder_ / "series.csv");
    examples::require(samples.empty() || samples.back().time < checkpoint_interval + sample_interval / 2,
                      (folder_ / "series.csv").string(), " extends to ", samples.empty() ? 0 : samples.back().time,
                      " s, but there is no ", checkpoint_file().string(),
                      " to resume from; put it back, or start anew without --resume");
    std::cerr << examples::message(chosen_.name, ": there is no checkpoint to resume from: starts at 0 s\n");
    return std::nullopt;
  }
  void resume(const Checkpoint& state) {
    std::vector<std::array<double, 3>> x(scene_.reference.size());
    state.get("positions", x);
    for (std::size_t i = 0; i < x.size(); ++i)
      simulation_.position_array()[i] = Eigen::Vector3d(x[i][0], x[i][1], x[i][2]);
    state.get("velocities", simulation_.velocity_array());
    penetration_ = state.value<double>("penetration");
    effort_ = {state.get<double>("seconds"), state.get<double>("of them for contact")};
    if (const auto J = state.get<double>("det F"); J.size() == 4) summary_.det_f = DetF{J[0], J[1], J[2], J[3]};
    if (const auto n = state.get<double>("nearest to limit"); n.size() == 4) {
      const auto particle = static_cast<std::uint64_t>(n[3]);
      summary_.nearest_to_limit =
          NearestToLimit{n[0], n[1], n[2], particle, std::string(name(scene_.organ.at(particle)))};
    }
    std::array<double, 2> range{};
    state.get("range of steps", range);
    summary_.time_step_min = range[0], summary_.time_step_max = range[1];
    simulation_.resume(state.value<StepClock>("clock"), state.get<double>("limiting mode"));
  }
  [[nodiscard]] std::vector<std::array<double, 3>> positions() {
    std::vector<std::array<double, 3>> x;
    for (const auto& p : simulation_.position_array()) x.push_back({p[0], p[1], p[2]});
    return x;
  }

  Options options_;
  SharedOrgans* surfaces_;
  Case chosen_;
  double friction_;
  std::filesystem::path folder_;
  examples::FolderLock lock_;
  std::filesystem::path data_;
  Materials materials_;
  Motion motion_;
  Scene scene_;
  MotionDigest motion_so_far_;
  Simulation<S> simulation_;
  RunSettings settings_;
  Summary summary_;
  FoldTime fold_, fold_base_;
  double penetration_ = 0;  ///< m, largest since the last sample
  Effort effort_;
  std::chrono::steady_clock::time_point accounted_;
  double contact_accounted_ = 0;  ///< s
};

}  // namespace

Summary run_case(const Options& options, const Case& chosen, const FittedOrgans* fitted, SharedOrgans* surfaces) {
  if (options.single_precision) return Run<float>(options, chosen, fitted, surfaces)();
  return Run<double>(options, chosen, fitted, surfaces)();
}

}  // namespace swallowing
