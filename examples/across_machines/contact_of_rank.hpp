// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <hmps/contact/contact.hpp>
#include <hmps/core/math.hpp>
#include <hmps/core/view.hpp>

#include "../common/error.hpp"
#include "meeting.hpp"
#include "messages.hpp"
#include "partition.hpp"

namespace across_machines {

using Vector = hmps::Vector<double, 3>;
using Gradient = hmps::Matrix<float, 3>;
/// Not `SpringFriction`: its elastic slip would have to follow particles from rank to rank in each survey.
using Contact = hmps::MetaballContact<double, 3, hmps::SmoothMetaball, hmps::CorrectedFriction>;
inline constexpr const char* body_name[] = {"plate", "block"};
inline const hmps::ContactSettings contact_settings{
    .spacing = l0, .density = rho, .friction = mu, .stiffness = hmps::PenaltyStiffness::ratio(0.05)};

/// Declares both bodies, of which `surface` are the particles, numbered as `number(k)` for the k-th of them.
template <class Slave, class Number, class Held>
void declare(Contact& contact, const std::vector<SurfaceParticle>& surface, Slave&& slave, Number&& number,
             Held&& held) {
  std::array<std::vector<Index>, 2> slaves, masters;
  for (std::size_t k = 0; k < surface.size(); ++k) {
    masters[static_cast<std::size_t>(surface[k].body)].push_back(number(k));
    if (slave(k)) slaves[static_cast<std::size_t>(surface[k].body)].push_back(number(k));
  }
  for (std::size_t b = 0; b < 2; ++b) contact.add_organ({body_name[b], slaves[b], masters[b], held});
  // A part of a surface may have no slave of one body.
  contact.add_pair(0, 1,
                   {.roles = slaves[1].empty()   ? hmps::Roles::only_first_is_slave
                             : slaves[0].empty() ? hmps::Roles::only_second_is_slave
                                                 : hmps::Roles::both});
}

/// The contact forces on the particles of one rank. Each rank gathers the surfaces that decide about its own forces
/// (`what_meets`), in the order of the scene, so that all sums are those of one rank. Which these are is found anew by
/// all ranks together, in a survey, when some surface particle has moved by `margin` or stretched by a twentieth.
class ContactOfRank {
 public:
  static constexpr double margin = 0.25 * l0;  ///< m
  /// A particle reaches as far as the largest stretch of all times this, so that it may grow until the next survey.
  static constexpr double growth = 1.1, tolerated_growth = 1.05;

  ContactOfRank(const Scene& scene, const Ranks& ranks, const std::vector<int>& part_of, const Part& part)
      : scene_(scene), ranks_(ranks), part_of_(part_of), part_(part), surface_(scene.surface()) {
    const auto size = static_cast<std::size_t>(ranks.size);
    counts_.resize(size);
    begins_.resize(size);
    std::vector<std::vector<Index>> entries(size);
    for (std::size_t k = 0; k < surface_.size(); ++k)
      entries[static_cast<std::size_t>(part_of[surface_[k].particle])].push_back(static_cast<Index>(k));
    for (std::size_t r = 0; r < size; ++r) {
      counts_[r] = static_cast<int>(3 * entries[r].size());
      begins_[r] = static_cast<int>(3 * entry_.size());
      entry_.insert(entry_.end(), entries[r].begin(), entries[r].end());
    }
    for (const Index k : entries[static_cast<std::size_t>(ranks.rank)])
      own_.push_back(part_.place_of(surface_[k].particle));
    surveyed_.resize(own_.size());
  }

  /// How far some own surface particle has moved in m since the latest survey, and the largest of their stretches over
  /// what was seen then: with the largest of all ranks `due` tells whether a survey has to be.
  [[nodiscard]] std::array<double, 2> change(const std::vector<Vector>& x, const std::vector<Gradient>& F) const {
    if (!known_) return {1e300, 1e300};
    double moved = 0, stretch = 0;
    for (std::size_t k = 0; k < own_.size(); ++k) {
      moved = std::max(moved, (x[own_[k]] - surveyed_[k]).squaredNorm());
      stretch = std::max(stretch, hmps::stretch_bound<double, 3>(F[own_[k]].cast<double>()));
    }
    return {std::sqrt(moved), stretch / stretch_};
  }
  [[nodiscard]] static bool due(const std::array<double, 2>& change) {
    return change[0] > margin || change[1] > tolerated_growth;
  }

  /// Throws `StateError` where an own surface particle moves by more than `margin` in a step. A survey forgets where
  /// contact has seen the particles before, and such a one may pass a thin wall in the step that follows, unseen.
  void require_slow(double t, double dt, const std::vector<Vector>& v) const {
    for (std::size_t k = 0; k < own_.size(); ++k)
      if (const double way = v[own_[k]].norm() * dt; way > margin)
        throw hmps::StateError(examples::message(
            "hmps: at t = ", t, " s, surface particle ", part_.particles[own_[k]], " of the scene moves by ", way,
            " m in a step, but contact between ranks ", "follows at most ", margin, " m; try a smaller time step"));
  }

  /// To be called by all ranks at once.
  void survey(const std::vector<Vector>& x, const std::vector<Gradient>& F) {
    std::array<double, 1> stretch{1};
    for (std::size_t k = 0; k < own_.size(); ++k) {
      surveyed_[k] = x[own_[k]];
      stretch[0] = std::max(stretch[0], hmps::stretch_bound<double, 3>(F[own_[k]].cast<double>()));
    }
    largest(ranks_, stretch);
    stretch_ = stretch[0];
    known_ = true;
    ++surveys_;
    std::vector<Vector> by_rank(surface_.size()), place(surface_.size());
    MPI_Allgatherv(surveyed_.data(), static_cast<int>(3 * surveyed_.size()), MPI_DOUBLE, by_rank.data(), counts_.data(),
                   begins_.data(), MPI_DOUBLE, ranks_.comm);
    for (std::size_t q = 0; q < place.size(); ++q) place[entry_[q]] = by_rank[q];
    const double reach = radius * stretch_ * growth + 2 * margin;
    const std::vector<Gathered> gathered = what_meets(surface_, place, reach, [&](std::size_t k) { return mine(k); });
    keep(gathered);
  }

  /// Brings positions `x`, velocities `v` and deformation gradients `F` of what was gathered here. To be called by all
  /// ranks at once.
  void gather(const std::vector<Vector>& x, const std::vector<Vector>& v, const std::vector<Gradient>& F) {
    for (const auto& [from, to] : copies_) {
      x_[to] = x[from];
      v_[to] = v[from];
      F_[to] = F[from];
    }
    constexpr std::size_t vector = sizeof(Vector), all = 2 * vector + sizeof(Gradient);
    exchange(
        ranks_, peers_, all, 0,
        [&](Index i, char* bytes, bool) {
          std::memcpy(bytes, x[i].data(), vector);
          std::memcpy(bytes + vector, v[i].data(), vector);
          std::memcpy(bytes + 2 * vector, F[i].data(), sizeof(Gradient));
        },
        [&](Index i, const char* bytes, bool) {
          std::memcpy(x_[i].data(), bytes, vector);
          std::memcpy(v_[i].data(), bytes + vector, vector);
          std::memcpy(F_[i].data(), bytes + 2 * vector, sizeof(Gradient));
        });
  }

  /// Adds the contact force densities on the own particles to `f`. Throws `StateError` where a wall has lost a
  /// particle.
  void add(std::vector<Vector>& f, double t, double dt) {
    if (!contact_) return;
    hmps::set_zero(hmps::vectors(f_));
    const auto report = contact_->add(hmps::vectors(std::as_const(x_)), hmps::vectors(std::as_const(v_)),
                                      hmps::matrices(std::as_const(F_)), hmps::vectors(f_), dt);
    late_ = late_before_ + report.late;
    if (report.lost > 0)
      throw hmps::StateError(examples::message("hmps: at t = ", t, " s, the wall of '", body_name[report.lost_in],
                                               "' has lost particle ", particle_[report.lost_slave], " of the scene, ",
                                               report.lost_depth, " m deep in it or through; try a smaller time step"));
    touching_ = 0;
    for (const auto& [from, to] : copies_) {
      f[from] += f_[to];
      touching_ += f_[to].isZero() ? 0 : 1;
    }
  }

  [[nodiscard]] std::size_t touching() const { return touching_; }  ///< own particles with a force, in the latest call
  [[nodiscard]] std::size_t gathered() const { return x_.size(); }
  [[nodiscard]] std::size_t late() const { return late_; }  ///< see `ContactReport::late`
  [[nodiscard]] std::size_t surveys() const { return surveys_; }

 private:
  static constexpr double radius = hmps::SmoothMetaball::radius * l0;

  [[nodiscard]] bool mine(std::size_t entry) const { return part_of_[surface_[entry].particle] == ranks_.rank; }

  /// Makes the arrays and the contact of what was gathered.
  void keep(const std::vector<Gathered>& gathered) {
    std::vector<SurfaceParticle> surface;
    std::vector<Wanted> wanted;
    particle_.clear();
    copies_.clear();
    for (std::size_t k = 0; k < gathered.size(); ++k) {
      const Index i = surface_[gathered[k].entry].particle, here = static_cast<Index>(k);
      surface.push_back(surface_[gathered[k].entry]);
      particle_.push_back(i);
      if (mine(gathered[k].entry))
        copies_.emplace_back(part_.place_of(i), here);
      else
        wanted.push_back({i, here});
    }
    peers_ = introduce(
        ranks_, wanted, {}, [&](Index i) { return part_of_[i]; }, [&](Index i) { return part_.place_of(i); });
    x_.resize(gathered.size());
    v_.resize(gathered.size());
    F_.resize(gathered.size());
    f_.resize(gathered.size());
    contact_.reset();
    late_before_ = late_;
    touching_ = 0;
    // A rank without contact has none to compute.
    if (std::none_of(gathered.begin(), gathered.end(), [](const Gathered& g) { return g.slave; })) return;
    contact_.emplace(contact_settings);
    declare(
        *contact_, surface, [&](std::size_t k) { return gathered[k].slave; },
        [](std::size_t k) { return static_cast<Index>(k); }, [&](Index k) { return scene_.prescribed(particle_[k]); });
  }

  const Scene& scene_;
  const Ranks& ranks_;
  const std::vector<int>& part_of_;
  const Part& part_;
  std::vector<SurfaceParticle> surface_;
  std::vector<int> counts_, begins_;  // of numbers, per rank
  std::vector<Index> entry_;          // of the surface, rank by rank
  std::vector<Index> own_;            // places of own surface particles
  std::vector<Vector> surveyed_;      // their positions in the latest survey
  double stretch_ = 1;                // the largest then
  bool known_ = false;
  // What was gathered.
  std::vector<Index> particle_;                  // numbers in the scene
  std::vector<std::pair<Index, Index>> copies_;  // own ones: place among the own particles, and here
  std::vector<Peer> peers_;
  std::vector<Vector> x_, v_, f_;
  std::vector<Gradient> F_;
  std::optional<Contact> contact_;
  std::size_t touching_ = 0, late_ = 0, late_before_ = 0, surveys_ = 0;
};

}  // namespace across_machines
