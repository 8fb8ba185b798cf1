// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <hmps/analysis/stable_step.hpp>
#include <hmps/analysis/step_causes.hpp>
#include <hmps/contact/contact.hpp>
#include <hmps/executors/openmp.hpp>
#include <hmps/motion/control_region.hpp>
#include <hmps/time/symplectic_euler.hpp>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "scene/materials.hpp"
#include "scene/motion.hpp"
#include "scene/scene.hpp"
#include "simulation/soft_tissue.hpp"
#include "simulation/step_clock.hpp"

namespace swallowing {

/// The swallow in time: the components of the library, composed as in section 2.1 of the paper. `S` is the scalar type
/// of velocities and forces; positions are kept in double, since a step moves a particle by less than a float resolves.
template <class S>
class Simulation {
 public:
  struct Settings {
    double friction = 0.1;
    double time_step = 0;        ///< s; 0: follows the largest stable step
    double step_share = 1;       ///< of the largest stable step, if the step follows it
    double penalty = 0;          ///< k in N/m4; 0: from the ratio, or from the materials
    double penalty_ratio = 0;    ///< k~ of \paper{25}; 0: not given
    bool paper_contact = false;  ///< metaball and friction law of the paper
    int threads = 1;
  };

  Simulation(const Scene& scene, const Motion& motion, const Materials& materials, const Settings& settings)
      : scene_(&scene),
        materials_(materials),
        execute_{settings.threads},
        x_(scene.reference.size()),
        places_(x_.size()),
        v_(3 * x_.size(), S(0)),
        F_(9 * x_.size(), S(0)),
        tissue_(make_tissue<S>(scene, materials, body(gradients()), execute_)),
        step_limit_(limit_at_rest()),
        step_share_(settings.time_step > 0 ? 0 : settings.step_share),
        penalty_(chosen_penalty(settings)),
        contact_(make_contact({.spacing = scene.spacing,
                               .density = materials.density,
                               .friction = settings.friction,
                               .stiffness = hmps::PenaltyStiffness::fixed(penalty_)},
                              settings.paper_contact)) {
    clock_ = StepClock(settings.time_step > 0 ? settings.time_step : chosen_step());
    limited_by_ = hmps::describe(step_limit_, tissue_->causes(step_limit_, body(positions()), body(velocities())),
                                 tissue_->support(step_limit_.particle));
    std::vector<char> free;
    for (std::size_t i = 0; i < scene.elastic_count; ++i) free.push_back(scene.region[i] < 0);
    tissue_->restrict_to(free);
    for (std::size_t i = 0; i < x_.size(); ++i) gradients().set(i, Eigen::Matrix3d::Identity());
    add_contacts();
    add_regions(motion);
  }
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// One step of the paper's scheme, \paper{2, 3, 4}. Throws `StateError` if a wall loses a slave.
  void step() {
    const auto x = positions();
    const auto v = velocities();
    tissue_->kick(body(x), body(v), time_step());
    // Particles with a forced displacement follow it, also as walls, whatever forces act on them.
    clock_.advance();
    prescribe();

    const auto start = std::chrono::steady_clock::now();
    const auto places = touching_places();
    with_contact([&](auto& contact) {
      report_ = contact.kick(places, v, gradients(), materials_.density, time_step(), execute_);
      contact.check(report_, time());
    });
    contact_seconds_ += std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    hmps::drift(x, v, time_step(), execute_);
  }

  [[nodiscard]] double time() const { return clock_.time(); }
  /// The length (s) of the coming steps.
  [[nodiscard]] double time_step() const { return clock_.step(); }
  [[nodiscard]] double penalty() const { return penalty_; }
  /// The largest stable step of the body without contact, and the particle that limits it: at rest, or in the state of
  /// the latest refresh.
  [[nodiscard]] const hmps::StableStep& step_limit() const { return step_limit_; }
  /// Updates the limit to the present state, starting from the mode found last. The gradients are meaningless until the
  /// next step.
  void refresh_step_limit() { step_limit_ = limit(step_limit_.mode); }
  /// Adapts the step to the limit, unless the step was given. Call this on a beat of the clock.
  void follow_step_limit() {
    if (step_share_ > 0) clock_.change(chosen_step());
  }
  /// The limit at rest in words: the particle and the forces that set it.
  [[nodiscard]] const std::string& limited_by() const { return limited_by_; }
  [[nodiscard]] std::uint64_t steps() const { return clock_.steps(); }
  [[nodiscard]] double contact_seconds() const { return contact_seconds_; }
  [[nodiscard]] const hmps::ContactReport<S>& contact_report() const { return report_; }

  /// Calls `visit` with an `hmps::Touch` for each touch of the latest step; its pair is an index into
  /// `Scene::contacts`.
  template <class Visit>
  void for_each_touch(Visit&& visit) {
    with_contact([&](auto& contact) { contact.for_each_touch(visit); });
  }

  [[nodiscard]] auto positions() { return hmps::vectors(x_); }
  [[nodiscard]] hmps::VectorView<S, 3> velocities() { return structure_of_arrays<3>(v_); }
  [[nodiscard]] hmps::MatrixView<S, 3> gradients() { return structure_of_arrays<9>(F_); }
  /// The part of a view that holds the deforming body, without the plates.
  template <class View>
  [[nodiscard]] View body(const View& view) const {
    return view.part(0, scene_->elastic_count);
  }
  [[nodiscard]] StoredEnergy stored_energy() { return tissue_->stored_energy(body(positions()), body(gradients())); }
  [[nodiscard]] const hmps::OpenMP& executor() const { return execute_; }
  [[nodiscard]] const Materials& materials() const { return materials_; }

  /// The state from which the next step starts: with it and the mode that limits the step, a run continues identically
  /// to the bit.
  [[nodiscard]] std::vector<Eigen::Vector3d>& position_array() { return x_; }
  [[nodiscard]] std::vector<S>& velocity_array() { return v_; }
  [[nodiscard]] const StepClock& clock() const { return clock_; }
  void resume(const StepClock& clock, std::vector<double> limiting_mode) {
    clock_ = clock;
    step_limit_.mode = std::move(limiting_mode);
    with_contact([](auto& contact) { contact.refresh(); });
  }

 private:
  using SmoothContact = hmps::MetaballContact<S, 3, hmps::SmoothMetaball, hmps::CorrectedFriction>;
  using PaperContact = hmps::MetaballContact<S, 3, hmps::PaperMetaball, hmps::PaperFriction>;
  using EitherContact = std::variant<SmoothContact, PaperContact>;

  [[nodiscard]] static EitherContact make_contact(const hmps::ContactSettings& settings, bool paper) {
    if (paper) return EitherContact(std::in_place_type<PaperContact>, settings);
    return EitherContact(std::in_place_type<SmoothContact>, settings);
  }
  template <class Use>
  void with_contact(Use&& use) {
    std::visit(use, contact_);
  }
  /// The positions that contact uses: at the drawn surfaces, or on the stairs of the lattice.
  [[nodiscard]] auto touching_places() {
    if (!scene_->skin) return positions();
    (*scene_->skin)(positions(), gradients(), hmps::vectors(places_), execute_);
    return hmps::vectors(places_);
  }

  template <int N>
  [[nodiscard]] hmps::View<S, N> structure_of_arrays(std::vector<S>& values) const {
    std::array<S*, N> base{};
    for (std::size_t c = 0; c < N; ++c) base[c] = values.data() + c * x_.size();
    return {base, x_.size(), sizeof(S)};
  }

  [[nodiscard]] hmps::StableStep limit_at_rest() {
    x_ = scene_->reference;
    return limit({});
  }
  [[nodiscard]] hmps::StableStep limit(const std::vector<double>& start) {
    const auto moves = [this](std::size_t i) { return scene_->region[i] < 0; };
    return tissue_->stable_step(body(positions()), body(velocities()),
                                {.spacing = scene_->spacing, .seed = steps() + 1, .start = start, .moves = moves});
  }
  /// The chosen share of the step that is stable with contact too, which adds k / rho to the square of a frequency.
  [[nodiscard]] double chosen_step() const {
    const double free = step_share_ * step_limit_.step;
    return StepClock::dividing(free / std::sqrt(1 + free * free * penalty_ / materials_.density));
  }
  [[nodiscard]] double chosen_penalty(const Settings& settings) const {
    if (settings.penalty > 0) return settings.penalty;
    if (settings.penalty_ratio > 0) {
      const double step = settings.time_step > 0
                              ? settings.time_step
                              : step_share_ * step_limit_.step * std::sqrt(1 - settings.penalty_ratio);
      return settings.penalty_ratio * materials_.density / (step * step);
    }
    return materials_.contact_stiffness / scene_->spacing;
  }

  /// Gives the control regions the velocities that take them to their places at the end of the step.
  void prescribe() {
    const auto one = [&](const auto& region, const auto& execute) {
      region.prescribe(positions(), velocities(), time(), time_step(), materials_.speed_limit, execute);
    };
    // The threads share the particles of each large region, and the small regions, such as plates, as a whole.
    const auto large = [](const auto& region) { return region.particles().size() > 1000; };
    for (const auto& region : regions_)
      if (large(region)) one(region, execute_);
    execute_(regions_.size(), [&](std::size_t r) {
      if (!large(regions_[r])) one(regions_[r], hmps::Serial{});
    });
  }

  void add_contacts() {
    with_contact([this](auto& contact) { this->add_contacts_to(contact); });
  }
  template <class Contact>
  void add_contacts_to(Contact& contact) {
    const auto prescribed = [this](hmps::Index i) { return scene_->region[i] >= 0; };
    for (const ContactPair& pair : scene_->contacts) {
      const auto organ = [&](Organ name, const auto& slaves, const auto& masters) {
        return contact.add_organ({.name = std::string(swallowing::name(name)),
                                  .slaves = slaves,
                                  .masters = masters,
                                  .prescribed = prescribed});
      };
      contact.add_pair(organ(pair.first, pair.first_slaves, pair.first_masters),
                       organ(pair.second, pair.second_slaves, pair.second_masters));
    }
  }
  void add_regions(const Motion& motion) {
    const auto particles = scene_->particles_of_regions();
    for (std::size_t r = 0; r < particles.size(); ++r)
      regions_.emplace_back(particles[r], hmps::vectors(scene_->reference),
                            [&motion, region = scene_->regions[r]](double t) { return motion(region, t); });
  }

  const Scene* scene_;
  Materials materials_;
  hmps::OpenMP execute_;
  std::vector<Eigen::Vector3d> x_, places_;
  std::vector<S> v_, F_;
  std::unique_ptr<SoftTissue<S>> tissue_;
  StepClock clock_;
  hmps::StableStep step_limit_;
  std::string limited_by_;
  double step_share_, penalty_;
  EitherContact contact_;
  std::vector<hmps::ControlRegion<double, 3>> regions_;
  hmps::ContactReport<S> report_;
  double contact_seconds_ = 0;
};

}  // namespace swallowing
