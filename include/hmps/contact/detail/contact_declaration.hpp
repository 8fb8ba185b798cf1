// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "hmps/contact/contact_settings.hpp"
#include "hmps/contact/detail/candidates.hpp"
#include "hmps/contact/detail/contact_history.hpp"
#include "hmps/contact/detail/slave_contact.hpp"
#include "hmps/contact/detail/wall_motion.hpp"
#include "hmps/contact/friction.hpp"
#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/organ.hpp"
#include "hmps/contact/overlaps.hpp"
#include "hmps/contact/penalty.hpp"
#include "hmps/contact/spring_friction.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/step.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/detail/quad.hpp"

namespace hmps::inline HMPS_ABI {

/// Contact between organs by metaball walls and penalties, \paper{22} to \paper{43}: both roles, with reactions and
/// friction. Stores only the lists of candidates, the latest normals and, for `SpringFriction`, elastic slip;
/// positions, velocities and deformation gradients belong to the caller.
///
/// Declare organs and the pairs that may touch. Then call `contact.add(x, v, F, f, dt)` in each step, with v = v* of
/// \paper{2}; it adds the force density (N/m3) of \paper{43} to `f`. Views hold all particles; F is read for slaves and
/// masters only. (The rotation of a rigid particle is irrelevant, so its F may stay the identity.)
///
/// The forces of a contact and its reactions sum to zero: the densities times l0^D, or times the volumes of the organs
/// if they have any. Their torque does not vanish exactly, because a reaction acts at the master's centre and not at
/// the point of contact (\paper{41, 42}).
///
/// Results are the same to the bit for any executor. They do not depend on when lists were built as long as `late` of
/// the report stays zero; strong deformation within a few steps, as in an impact at half the speed of sound, may be
/// detected a few steps late.
///
/// If `S` is narrower than the scalar type of the positions, such as float for double, positions are measured from an
/// origin: zero, unless the centre of all organs is further than about a thousand spacings (float) from it when lists
/// are built; then the origin moves to that centre. It thus stays constant from step to step, and results change, by
/// rounding only, each time that all organs have travelled that far.
///
/// Slaves with an undefined normal (deep inside) receive no force and are counted as lost; `check` reports them as an
/// error.
template <class S, int D, class Kernel = SmoothMetaball, class Friction = SpringFriction, class Penalty = LinearPenalty>
class MetaballContact {
  static_assert(D == 2 || D == 3, "hmps: contact is in 2 or 3 dimensions");
  static_assert(detail::RequireMetaball<Kernel>::value);
  static_assert(detail::RequireFrictionLaw<Friction>::value);
  static_assert(detail::RequirePenaltyLaw<Penalty>::value);
  using Lists = detail::Candidates<S, D, Kernel>;
  using Point = Vector<S, D>;
  using Tensor = Matrix<S, D>;
  static constexpr bool has_spring = detail::has_spring<Friction>;
  static constexpr bool is_linear = std::is_same_v<Penalty, LinearPenalty>;
  using Slip = std::conditional_t<has_spring, detail::ElasticSlip<S, D>, detail::NoSlip>;

 public:
  /// Throws `InputError` for settings that are not finite or out of range. `law` is a `PenaltyLaw`.
  explicit MetaballContact(const ContactSettings& settings, const Penalty& law = {})
      : settings_(settings),
        penalty_(law),
        lists_(static_cast<S>(settings.spacing), static_cast<S>(settings.margin * settings.spacing)) {
    detail::validate(settings, damping(1));
  }

  /// Declares an organ and returns its number for `add_pair`. Throws `InputError` if it is empty.
  std::size_t add_organ(const Organ& organ) { return lists_.add_organ(organ); }

  /// Declares that two organs may touch, and returns the number of the pair. Throws `InputError` if they share a
  /// particle, lack slaves or masters for their roles, or are already a pair in either order, and if a slave would meet
  /// the same master in the same role in another pair (for example, because one body is declared as two organs): the
  /// force would count twice. Otherwise, organs of different pairs may share slaves or masters.
  std::size_t add_pair(std::size_t first, std::size_t second, const PairSettings& settings = {}) {
    if (settings.friction) detail::require_friction(*settings.friction);
    const std::size_t pair = lists_.add_pair(first, second, settings);
    own_.push_back({settings.friction, settings.stiffness});
    return pair;
  }

  /// Makes the next call rebuild all lists and forget the history, for positions that jumped; no step needs it.
  void refresh() {
    lists_.refresh();
    history_.next_call();
  }

  /// What contact remembers between calls, as numbers that a double represents exactly: on which side of a wall each
  /// slave in contact is, from where it measures positions and, for `SpringFriction`, the elastic slip and the
  /// positions of the latest call. Store it in a checkpoint, or before calls that only probe the force.
  [[nodiscard]] std::vector<double> history() const;
  /// Replaces the history by one that `history` returned for a contact with the same settings, organs and pairs in the
  /// same order. The next call then gives the same bits as it would there, except in float if the organs have travelled
  /// a thousand spacings since lists were built: see the class. Throws `InputError` for any other numbers.
  void restore_history(std::span<const double> history);

  [[nodiscard]] const ContactSettings& settings() const { return settings_; }
  /// Sets mu of the pairs without a friction coefficient of their own (`PairSettings::friction`).
  void set_friction(double mu) {
    detail::require_friction(mu);
    settings_.friction = mu;
  }

  /// Adds the contact force densities for the step `dt` (s) to `f`. Throws `InputError` for views of the wrong size, an
  /// invalid step, a penalty that `S` cannot represent, organs without any pair, organs too far apart for an `S` that
  /// is narrower than the positions, a spacing far below that of an organ's particles at its first call, and if the
  /// deformation gradient of a particle of an organ is zero. Throws `StateError` if a position or gradient, or the
  /// velocity of a particle near another organ, is not finite, or if your own `PenaltyLaw` reaches k~ = 1. A particle
  /// whose gradient is singular but not zero, or that `S` cannot invert, forms no wall.
  template <class X, class V, class M, class T, Executor E = Serial>
  ContactReport<S> add(const VectorView<X, D>& x, const VectorView<V, D>& v, const MatrixView<M, D>& F,
                       const VectorView<T, D>& f, double dt, const E& execute = {}) {
    require_size(F, x.size(), "deformation gradients");
    return add_forces(x, v, F, f, dt, execute);
  }

  /// The same for particles that do not deform.
  template <class X, class V, class T, Executor E = Serial>
  ContactReport<S> add(const VectorView<X, D>& x, const VectorView<V, D>& v, const VectorView<T, D>& f, double dt,
                       const E& execute = {}) {
    return add_forces(x, v, detail::Undeformed<S, D>{}, f, dt, execute);
  }

  /// Adds the effect of contact over the step `dt` (s) to the velocities `v` (m/s), \paper{3}: equivalent to `add` on
  /// zeros and `kick`, but without an array of forces, and at no cost for particles far from any other organ.
  /// `prescribed` particles keep their velocity. Density `rho` in kg/m3: a number, a view or a callable. Throws as
  /// those two do, and `InputError` if a particle that may touch is so light that its own k~ = k dt^2 / rho reaches 1
  /// (for a `PenaltyLaw` of your own, k is the largest stiffness in its pair) or if `v` shares memory with `x`.
  template <class X, class V, class M, PerParticle Rho, Executor E = Serial>
  ContactReport<S> kick(const VectorView<X, D>& x, const VectorView<V, D>& v, const MatrixView<M, D>& F, const Rho& rho,
                        double dt, const E& execute = {}) {
    static_assert(!std::is_const_v<V>, "hmps: kick changes the velocities; give it a writable view of them");
    require_size(F, x.size(), "deformation gradients");
    require_apart(v, "velocities", x, "positions");
    require_positive(rho, x.size(), "density", "kg/m3");
    lists_.organs().require_particles(x.size());
    detail::require_step(dt);
    if constexpr (is_linear) require_heavy(rho, dt);
    const ContactReport<S> report = survey(x, v, F, dt, execute);
    if (report.contacts == 0) return report;
    if constexpr (!is_linear) require_heavy(rho, dt);  // with the stiffness of the rows that touch
    hand_out(
        [&](const auto& own, const Point& force) {
          if (own.flags & detail::is_prescribed) return;
          const Index i = own.particle;
          for (int c = 0; c < D; ++c) detail::kick(v(i, c), force[c], at_particle(rho, i), dt);
        },
        execute);
    return report;
  }

  /// Explains calls with arrays in place of views.
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> add(const Arguments&...);
  template <class... Arguments>
  requires(!detail::AreWrapped<Arguments...>::value) detail::RequireViews<Arguments...> kick(const Arguments&...);

  /// Throws a `StateError` if, by the latest `report`, a wall has lost a slave: time (s, if given), particle, organ,
  /// depth and remedy. Costs one comparison. Call it after each evaluation: a slave that passes through a thin wall is
  /// inside it for a few steps only, and looks valid afterwards. The check misses no slave that moves less than a
  /// spacing per step relative to the wall, which holds for all speeds below that of sound.
  void check(const ContactReport<S>& report, double time = std::numeric_limits<double>::quiet_NaN()) const {
    if (report.lost > 0) fail(report, time);
  }

  /// Finds overlaps of organs in the state `x` (m), `F`: one entry for each pair and role with slaves inside a wall;
  /// see `Overlap`. Call it before a run: overlapping bodies are flung apart, or not detected at all if they lie deeper
  /// than metaballs reach. Costs as much as building all lists. Throws as the evaluation does.
  template <class X, class M>
  [[nodiscard]] std::vector<Overlap> overlaps(const VectorView<X, D>& x, const MatrixView<M, D>& F) const {
    require_size(F, x.size(), "deformation gradients");
    return find_overlaps(x, F);
  }
  /// The same for particles that do not deform.
  template <class X>
  [[nodiscard]] std::vector<Overlap> overlaps(const VectorView<X, D>& x) const {
    return find_overlaps(x, detail::Undeformed<double, D>{});
  }

  /// Force in N on the slaves of the first organ of `pair` minus that on the slaves of the second in the latest call:
  /// the force of the second organ on the first. Throws `InputError` if there is no such pair.
  [[nodiscard]] Vector<double, D> force_on_first(std::size_t pair) const;

  /// Calls `visit(touch)` with a `Touch<D>` for each slave in contact in the latest call, once per organ that it
  /// touches: for pressures, areas and moments. The component of the force along the normal is \paper{39}, the rest is
  /// friction.
  template <class Visit>
  void for_each_touch(Visit&& visit) const;

 private:
  using Quad = detail::Quad<S>;
  struct RowState {
    Point normal, slip;  // slip: v_im
    S penetration;       // positive if the row touches, or did in the previous call
  };
  struct Batch {
    std::size_t count = 0, lost = 0;
    Index deepest = 0;  // row
    S depth = 0;
  };
  struct PairSetting {
    std::optional<double> friction;
    std::optional<PenaltyStiffness> stiffness;
  };
  struct PairLaw {
    S stiffness, damping, friction;
    double largest;  // stiffness of the law over the rows that touch, in N/m4; 0 for `LinearPenalty`
  };
  static constexpr std::size_t batch = 8, gather_batch = 64;  // rows per batch: few, because quiet scenes have few

  template <class X, class V, class G, class T, class E>
  ContactReport<S> add_forces(const X& x, const V& v, const G& F, const T& f, double dt, const E& execute) {
    require_size(f, x.size(), "contact forces");
    require_apart(f, "contact forces", x, "positions");
    require_apart(f, "contact forces", v, "velocities");
    detail::require_step(dt);
    if constexpr (is_linear) require_heavy(settings_.density, dt);
    const ContactReport<S> report = survey(x, v, F, dt, execute);
    if (report.contacts == 0) return report;
    if constexpr (!is_linear) require_heavy(settings_.density, dt);
    hand_out([&](const auto& own, const Point& force) { f.add(own.particle, force); }, execute);
    return report;
  }
  /// Throws `InputError` for organs without any pair, and for a spacing far below that of the particles of an organ.
  template <class X>
  void require_plausible_organs(const X& x);
  /// Computes the forces of all rows that touch, for `hand_out`.
  template <class X, class V, class G, class E>
  ContactReport<S> survey(const X& x, const V& v, const G& F, double dt, const E& execute);

  /// The normal damping, as a fraction of critical, of a pair with the friction coefficient `mu`.
  [[nodiscard]] double damping(double mu) const {
    return settings_.damping.value_or(mu > 0 ? detail::damping_of<Friction>() : 0);
  }
  [[nodiscard]] double friction(std::size_t pair) const { return own_[pair].friction.value_or(settings_.friction); }
  template <class X, class V, class G>
  bool touch(std::size_t r, const X& x, const V& v, const G& F, S& depth);
  [[noreturn]] void fail(const ContactReport<S>& report, double time) const;

  template <class X, class G>
  [[nodiscard]] std::vector<Overlap> find_overlaps(const X& x, const G& F) const;
  void resize();
  template <class X, class V, class G, class E>
  void gather(const X& x, const V& v, const G& F, const E& execute);
  template <class X, class V, class G>
  void check_suspects(const X& x, const V& v, const G& F) const;
  template <class X, class V, class G, class E>
  void find(const X& x, const V& v, const G& F, ContactReport<S>& report, const E& execute);
  [[nodiscard]] const PenaltyStiffness& stiffness(std::size_t pair) const {
    return own_[pair].stiffness ? *own_[pair].stiffness : settings_.stiffness;
  }
  [[nodiscard]] S penalty(std::size_t pair, double dt) const;
  template <PerParticle Rho>
  void require_heavy(const Rho& rho, double dt) const;
  void set_laws(double dt);
  void require_stable(double dt);
  template <class E>
  void weigh(const E& execute);
  template <class E>
  std::size_t push(double dt, const E& execute);
  [[nodiscard]] Point follow(Index r, double dt);
  template <class Take, class E>
  void hand_out(const Take& take, const E& execute) const;

  ContactSettings settings_;
  [[no_unique_address]] Penalty penalty_;
  std::vector<PairSetting> own_;  // per pair: overrides `settings_`
  std::vector<PairLaw> laws_;     // per pair, for the current call
  std::size_t seen_organs_ = 0;   // by `require_plausible_organs`
  Lists lists_;
  std::vector<detail::Master<S, D>> masters_;  // per awake particle
  std::vector<detail::MovingMaster<S, D>> moving_;
  // Per candidate, c / C if the row touches, else 0: row by row, and master by master.
  std::vector<S> weight_, entry_weight_;
  std::vector<RowState> state_;  // per row
  std::vector<Quad> force_;
  std::vector<Index> batch_rows_, touching_;
  std::vector<Batch> batches_;
  std::vector<Index> suspect_;  // per batch of `gather`, the first awake particle with a number that is not finite
  std::vector<S> load_;         // per awake particle: N
  detail::ContactHistory<D, Slip> history_;
  [[no_unique_address]] std::conditional_t<has_spring, detail::ParticleMotion<S, D>, detail::NoSlip> motion_;
};

}  // namespace hmps::inline HMPS_ABI
