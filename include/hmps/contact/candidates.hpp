// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hmps/contact/metaball.hpp"
#include "hmps/contact/normal_density.hpp"
#include "hmps/contact/organ.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/neighbours/grid.hpp"

namespace hmps::detail {

/// Deformation gradients of undeformed or rigid particles.
template <class S, int D>
struct Undeformed {
  [[nodiscard]] Matrix<S, D> operator[](std::size_t) const { return Matrix<S, D>::Identity(); }
};

/// An upper bound of the largest singular value of F, exact in 2D and for equal stretches: mean plus
/// sqrt(D - 1) standard deviations of the eigenvalues of F^T F (Wolkowicz and Styan 1980).
template <class S, int D>
[[nodiscard]] S stretch_bound(const Matrix<S, D>& F) {
  const Matrix<S, D> C = F.transpose().lazyProduct(F);
  const S mean = C.trace() / S(D);
  const S variance = (C - mean * Matrix<S, D>::Identity()).squaredNorm() / S(D);
  return std::sqrt(mean + std::sqrt(S(D - 1) * variance));
}

/// Which slaves may meet which masters. Two lists, each a superset of what touches:
/// - the outer one holds pairs within reach plus `skin`; built by a grid search when an organ pair has
///   moved or a reach has grown by that much;
/// - the inner one holds those of them within reach plus `margin`, by true distances, and of those
///   only the slaves that could touch if all masters were nearer by `margin`; chosen anew after as
///   many calls as the present speeds allow twice over (at most `longest_nap`), or at once when a
///   master on it has used up its share of the margin.
/// What is not on the inner list sleeps. All orders follow the particles' indices, so sums over the
/// pairs that touch do not depend on when lists were made.
///
/// A row is a slave of one side (an ordered pair of organs); a slot is a master of some row.
template <class S, int D, Metaball Ball>
class Candidates {
 public:
  using Point = Vector<S, D>;
  static constexpr std::uint8_t is_slave = 1, is_master = 2, is_prescribed = 4;

  struct OrganRange {
    std::string name;
    std::size_t begin, end;  // of members
    Point moved;             // mean displacement since the outer lists were built
    S motion, growth;        // largest displacement beyond it, largest growth of a reach
  };
  struct Side {
    std::size_t slaves, masters;  // organs
    std::size_t pair;
    S limit;  // motion that the outer list bears
  };
  struct Pair {
    std::size_t first, second;
    std::vector<Index> excluded_slaves;
    std::function<bool(Index, Index)> excluded;
  };
  struct Row {
    Index particle, touched;
    std::uint32_t side;
    Index begin;    // of its candidates; the next row's is the end
    S compression;  // bound of |F_j^-1| of its masters until the next check
  };
  struct Touched {
    Index particle;
    std::uint8_t flags;
    Index rows, slots;  // ends in touched_rows, touched_slots
  };

  NormalDensity<S, D, Ball> normal_density;
  std::vector<OrganRange> organs;
  std::vector<Pair> pairs;
  std::vector<Side> sides;

  // The inner list.
  std::vector<Row> rows;       // one more at the end
  std::vector<Index> slot_of;  // per candidate
  std::vector<Index> slot_member, slot_particle, slot_touched;
  std::vector<Index> slot_begin;  // into slot_rows
  std::vector<Index> slot_rows;   // what refers to a slot, rows ascending
  std::vector<Index> entry_of;    // per candidate, its place in slot_rows
  std::vector<Touched> touched;   // every particle of rows and slots once
  std::vector<Index> touched_rows, touched_slots;
  std::size_t rebuilds = 0, checks = 0, late = 0;

  /// `spacing` and `skin` in m.
  Candidates(S spacing, S skin)
      : normal_density(spacing), radius_(static_cast<S>(Ball::radius) * spacing), skin_(skin) {}

  std::size_t add_organ(const Organ& organ);
  std::size_t add_pair(std::size_t a, std::size_t b, const PairSettings& settings);
  void refresh() { built_ = false; }

  /// Number of particles that the views must hold at least.
  [[nodiscard]] std::size_t particles() const { return particles_; }

  /// Keeps the lists valid for this call; true if the inner one was chosen anew.
  template <class X, class V, class Gradients, class E>
  bool update(const X& x, const V& v, const Gradients& F, S dt, const E& execute) {
    if (built_ && naps_ > 0 && !probe(x)) {
      --naps_;
      return false;
    }
    check(x, v, F, dt, execute);
    return true;
  }

  /// Chooses the inner list anew, and the outer one where needed.
  template <class X, class V, class Gradients, class E>
  void check(const X& x, const V& v, const Gradients& F, S dt, const E& execute);

  /// Whether the particle of `slot`, now at `place`, has used up its half of the margin.
  [[nodiscard]] bool strayed(std::size_t slot, const Point& place) const {
    return (place - place_[slot_member[slot]]).squaredNorm() > stray_squared_;
  }

 private:
  static constexpr std::size_t chunk = 512, longest_nap = 63;
  static constexpr Index none = std::numeric_limits<Index>::max();
  struct Partial {
    std::size_t organ, begin, end;
    S motion, growth, speed, step, step_growth;
    Point sum;
  };
  struct OuterRow {
    Index particle, unique;
    std::uint32_t side;
    Index begin, member;
    Index kept;  // end of its candidates on the inner list
    S compression;
  };
  struct Near {
    Index slave, master;
  };

  void add_side(std::size_t slaves, std::size_t masters);
  template <class X>
  [[nodiscard]] bool probe(const X& x) const;
  void number();
  template <class X, class V, class Gradients, class E>
  void measure(const X& x, const V& v, const Gradients& F, const E& execute);
  template <class X>
  [[noreturn]] void fail(const X& x, const OrganRange& organ) const;
  template <class E>
  void build(const E& execute);
  template <class E>
  void build_side(std::uint32_t side, const E& execute);
  template <class E>
  void select(const E& execute);
  [[nodiscard]] S keep(std::size_t row, Index& end);
  [[nodiscard]] S margin() const { return S(0.4) * skin_; }
  void transpose();

  S radius_, skin_;
  // Of members (a particle in an organ), organ after organ, sorted by particle.
  std::vector<Index> particle_, unique_;
  std::vector<std::uint8_t> flags_;
  std::vector<Point> place_, built_place_;  // at the latest check and build
  std::vector<S> reach_, built_reach_;      // r_e times the stretch
  std::vector<S> compression_;              // bound of |F^-1| of masters; negative: no wall
  std::vector<Partial> partials_;
  // Of particles.
  std::vector<Index> unique_particle_, touched_of_;
  std::vector<std::uint8_t> unique_flags_;
  // The outer list.
  std::vector<OuterRow> outer_rows_;
  std::vector<Index> outer_member_, kept_member_;
  // Scratch.
  std::vector<Index> candidate_member_, slot_of_member_, next_;
  std::size_t particles_ = 0, naps_ = 0;
  S stray_squared_ = 0, speed_ = 0, step_ = 0, step_growth_ = 0;
  bool built_ = false;
};

}  // namespace hmps::detail

#include "hmps/contact/candidates_build.hpp"
#include "hmps/contact/candidates_select.hpp"
