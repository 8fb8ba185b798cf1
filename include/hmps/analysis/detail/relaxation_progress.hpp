// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hmps/analysis/detail/motion_as_a_whole.hpp"
#include "hmps/analysis/detail/relaxing_body.hpp"
#include "hmps/analysis/relaxation_settings.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Tells whether a relaxation no longer gets closer to rest. While rounding makes the forces, their peaks come every
/// few steps, with the stiffest motion. Without rounding that motion would have died away by a factor at each of so
/// many peaks, and the peaks of slower motion would come later.
class Stalling {
 public:
  /// Takes each iteration; true if the last `window` peaks came fast and did not lower the least residual by a fifth.
  [[nodiscard]] bool update(const Relaxation& now) {
    if (now.residual < least_) least_ = now.residual;
    if (now.peaks < start_.peaks + window) return false;
    const bool fast = now.iterations - start_.iterations < 6 * window, stalled = fast && least_ > 0.8 * before_;
    start_ = now;
    before_ = least_;
    return stalled;
  }

 private:
  static constexpr int window = 1000;  // peaks
  Relaxation start_;
  double least_ = std::numeric_limits<double>::infinity(), before_ = least_;
};

/// Tells whether a force or a moment moves a body of which no particle is held, and nothing resists: whether the net
/// force keeps its size while the body moves along it by three times its own, or the net moment while the body turns
/// with it by a whole turn. Pressures turn with the body, so directions do not count. A spring that holds the body
/// changes them before, unless it lets the body move by ten of its sizes, and so does a wall that the body reaches.
/// Dead loads that turn a body keep the size of their moment to 5 % over 0.75 radians at most.
template <class Body, int D>
class FreeMotion {
 public:
  FreeMotion(const Body& body, const RelaxationSettings& settings)
      : body_(body), tolerance_(settings.tolerance), extent_(body.extent() + settings.spacing) {
    for (int c = 0; c < D; ++c) free_ = free_ || body.free(c);
  }

  /// Throws `StateError` if the body moves in this way. To be called between an evaluation of the forces and the kick.
  void require_held(const Relaxation& now) {
    if (!free_ || now.iterations < next_) return;
    next_ = now.iterations + 100;  // the sums take as long as a part of a step
    const Resultant<D> own = body_.resultant();
    follow(own);
    const bool flies = moved_ > 3 * extent_ && force_matters(own, now);
    if (flies || (turned_ > 2 * std::numbers::pi && moment_matters(own, now)))
      throw_free(now, own, flies ? "moves" : "turns");
  }

  /// What the error of a search that fails says about the net force and moment; empty if a body may come to rest under
  /// them.
  [[nodiscard]] std::string remark(const Relaxation& now) const {
    if (!free_) return "";
    const Resultant<D> own = body_.resultant();
    return force_matters(own, now) || moment_matters(own, now) ? against(own) : "";
  }

 private:
  static constexpr double same = 0.05;  // change relative to the force or moment

  /// The residual cannot fall below the net force divided by the load, nor below the moment divided by the load and an
  /// arm, which is shorter than the body.
  [[nodiscard]] bool force_matters(const Resultant<D>& own, const Relaxation& now) const {
    return own.force.norm() > tolerance_ * now.load;
  }
  [[nodiscard]] bool moment_matters(const Resultant<D>& own, const Relaxation& now) const {
    return own.moment.norm() > tolerance_ * now.load * extent_;
  }
  /// Adds the motion since the last call. Where the size of the force or the moment has changed, it is measured anew.
  void follow(const Resultant<D>& own) {
    const double force = own.force.norm(), moment = own.moment.norm();
    if (force > 0) moved_ += (own.centre - centre_).dot(own.force) / force;
    if (moment > 0) turned_ += turn(own).dot(own.moment) / moment;
    if (!(std::abs(force - force_) <= same * force_)) {
      force_ = force;
      moved_ = 0;
    }
    if (!(std::abs(moment - moment_) <= same * moment_)) {
      moment_ = moment;
      turned_ = 0;
    }
    centre_ = own.centre;
    places_.resize(body_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) places_[i] = body_.place(i);
  }
  /// The sine of the angle by which the body has turned since the last call, along the axis of the turn.
  [[nodiscard]] Axial<D> turn(const Resultant<D>& own) const {
    Axial<D> sum = Axial<D>::Zero();
    double arms = 0;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      const Vector<double, D> before = places_[i] - centre_, now = body_.place(i) - own.centre;
      sum += cross<D>(before, now);
      arms += before.norm() * now.norm();
    }
    return arms > 0 ? Axial<D>(sum / arms) : sum;
  }
  [[nodiscard]] static std::string against(const Resultant<D>& own) {
    return message("no particle is held against the net force of (", own.force, ") N and the net moment of (",
                   own.moment, ") N m about the centre of the body");
  }
  [[noreturn]] static void throw_free(const Relaxation& now, const Resultant<D>& own, const char* does) {
    throw StateError(message("hmps: after ", now.iterations, " iterations of relax, ", against(own),
                             ", whose size stays the same while the body ", does,
                             ": nothing has held it so far; hold some particles by `moves`, or subtract the mean "
                             "force, and the moment, from the "
                             "forces; a body that is to meet another must start closer to it"));
  }

  const Body& body_;
  double tolerance_, extent_;  // m
  bool free_ = false;
  int next_ = 0;                   // iteration
  double force_ = 0, moment_ = 0;  // N and N m
  double moved_ = 0, turned_ = 0;  // m along the force, and radians
  Vector<double, D> centre_ = Vector<double, D>::Zero();
  std::vector<Vector<double, D>> places_;
};

/// Ends a relaxation that cannot come to rest.
template <class Body, int D = Body::dimension>
class RelaxationProgress {
 public:
  RelaxationProgress(const Body& body, const RelaxationSettings& settings)
      : settings_(settings),
        furthest_(10 * (body.extent() + settings.spacing)),
        motion_(body, settings),
        second_half_(body) {}

  /// Throws `StateError` if the search stalls or has made all permitted iterations, or if the body flies away:
  /// `flown` is the path in m of its fastest particles since the last stop. Where damping limits the step, a body moves
  /// for long without less unbalance, so that no stall shows.
  void require(const Relaxation& now, bool damped, double flown) {
    const bool stalled = stalling_.update(now) && !damped;
    if (!halved_ && now.iterations >= settings_.max_iterations / 2) {
      halved_ = true;
      second_half_.start(now.iterations);
    }
    if (stalled || now.iterations >= settings_.max_iterations)
      throw_not_at_rest(now, settings_, damped, stalled, motion_.remark(now), second_half_.remark(settings_.spacing));
    motion_.require_held(now);
    if (flown > furthest_) throw_flown(now, flown, motion_.remark(now));
  }

 private:
  const RelaxationSettings& settings_;
  double furthest_;  // m
  Stalling stalling_;
  FreeMotion<Body, D> motion_;
  MotionAsAWhole<Body, D> second_half_;  // of the permitted iterations
  bool halved_ = false;
};

}  // namespace hmps::inline HMPS_ABI::detail
