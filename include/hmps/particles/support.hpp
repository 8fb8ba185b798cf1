// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/detail/lattice_cells.hpp"
#include "hmps/bonds/detail/plausible_spacing.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// Settings of `find_weak` and `supported_particles`. The support of a particle is the smallest eigenvalue of A,
/// \paper{12}, with the weights of \paper{8}, divided by the squared spacing: with the paper's radius it is 3.48 in a
/// full cubic lattice, 1.74 at a flat surface, 0.99 at the corner of a cube. Weak support makes A^-1 and thus the
/// stiffness large: the particle has a small stable step of its own and can explode at rest.
struct SupportSettings {
  double spacing = 0;                        ///< Initial particle spacing l0 in m, positive.
  double radius_ratio = paper_radius_ratio;  ///< Effective radius over spacing, r_e / l0.
  double threshold = 0.75;                   ///< Weak below this; the default suits 3D and the paper's radius.
  double smallest_piece = 0.01;              ///< Detached pieces with a smaller fraction of all particles are removed.
};

/// A weakly supported particle.
struct WeakParticle {
  Index particle;  ///< its index
  double support;  ///< smallest eigenvalue of A over the squared spacing
};

/// Protects no particle: the default predicate of `supported_particles`.
struct KeepNone {
  constexpr bool operator()(std::size_t) const { return false; }
};

namespace detail {

inline void validate(const SupportSettings& settings) {
  validate(BondSettings{settings.spacing, settings.radius_ratio});
  require(detail::is_finite(settings.threshold) && settings.threshold >= 0, "hmps: the support threshold is ",
          settings.threshold, "; it must not be negative (0.75 suits the paper's radius)");
  require(detail::is_finite(settings.smallest_piece) && settings.smallest_piece >= 0 && settings.smallest_piece <= 1,
          "hmps: the smallest piece to keep is ", settings.smallest_piece,
          " of all particles; give a share from 0 to 1");
}

/// The neighbourhoods of a cloud from which particles are removed.
template <class T, int D, class Bonded>
class Supports {
 public:
  Supports(const VectorView<T, D>& points, const SupportSettings& settings, const Bonded& bonded)
      : points_(points),
        bonded_(bonded),
        radius_(settings.spacing * settings.radius_ratio),
        spacing_(settings.spacing) {
    validate(settings);
    const auto reach = reach_of(points, radius_);  // as in `BondList`
    const FixedRadiusSearch<T, D> search(points);
    require_plausible_spacing(search, {settings.spacing, settings.radius_ratio}, reach, false);
    list_ = find_neighbours(search, reach);
  }

  /// Calls `visit(j)` for each particle bonded to `i`.
  template <class Visit>
  void for_each(std::size_t i, Visit&& visit) const {
    for (const Index j : list_[i])
      if (are_bonded(bonded_, i, static_cast<std::size_t>(j))) visit(static_cast<std::size_t>(j));
  }

  /// The support of `i` from those neighbours for which `present(j)` holds.
  template <class Present>
  [[nodiscard]] double operator()(std::size_t i, const Present& present) const {
    ShapeTensor<D> shape;
    const Vector<double, D> here = points_[i].template cast<double>();
    for_each(i, [&](std::size_t j) {
      if (!present(j)) return;
      const Vector<double, D> r0 = points_[j].template cast<double>() - here;
      shape.add(r0, PaperWeight{}(std::min(r0.norm(), radius_), radius_));
    });
    return shape.support() / (spacing_ * spacing_);
  }

 private:
  VectorView<T, D> points_;
  Bonded bonded_;
  double radius_;
  double spacing_;
  NeighbourList list_;
};

/// Which of `n` particles are left when particles with a support below `threshold` are removed until none remains.
template <class Supports, class Keep>
[[nodiscard]] std::vector<char> without_weak(const Supports& supports, std::size_t n, double threshold,
                                             const Keep& keep) {
  std::vector<char> present(n, 1);
  const auto is_present = [&](std::size_t j) { return present[j] != 0; };
  std::vector<std::size_t> suspects(n), next;
  for (std::size_t i = 0; i < n; ++i) suspects[i] = i;
  while (!suspects.empty()) {
    next.clear();
    for (const std::size_t i : suspects) {
      if (!present[i] || keep(i) || !(supports(i, is_present) < threshold)) continue;
      present[i] = 0;
      supports.for_each(i, [&](std::size_t j) {
        if (present[j]) next.push_back(j);
      });
    }
    std::sort(next.begin(), next.end());
    next.erase(std::unique(next.begin(), next.end()), next.end());
    suspects.swap(next);
  }
  return present;
}

/// The support of a particle inside a full lattice, over the squared spacing.
template <int D>
[[nodiscard]] double full_support(double radius_ratio) {
  ShapeTensor<D> shape;
  for (const auto& cell : cells_within<D>(radius_ratio)) {
    Vector<double, D> r0;
    for (int c = 0; c < D; ++c) r0[c] = cell[static_cast<std::size_t>(c)];
    shape.add(r0, PaperWeight{}(r0.norm(), radius_ratio));
  }
  return shape.support();
}

}  // namespace detail

/// Finds the weakly supported particles of the reference positions `points` (m), in order. Two particles are bonded if
/// they lie within the effective radius and `bonded(i, j)` holds (symmetric). Throws `InputError` for settings out of
/// range, a spacing far above that of the particles, a predicate that is not symmetric, positions that are not finite,
/// and coincident particles.
template <class T, int D, class Bonded = EveryBond, Executor E = Serial>
[[nodiscard]] std::vector<WeakParticle> find_weak(const VectorView<T, D>& points, const SupportSettings& settings,
                                                  const Bonded& bonded = {}, const E& execute = {}) {
  const detail::Supports<T, D, Bonded> supports(points, settings, bonded);
  std::vector<double> support(points.size());
  detail::guarded(execute)(points.size(),
                           [&](std::size_t i) { support[i] = supports(i, [](std::size_t) { return true; }); });
  std::vector<WeakParticle> weak;
  for (std::size_t i = 0; i < support.size(); ++i)
    if (support[i] < settings.threshold) weak.push_back({static_cast<Index>(i), support[i]});
  return weak;
}

/// Returns the particles of `points` (m) to keep: those that remain when weakly supported particles are removed until
/// none is left, then connected pieces with a smaller fraction of all particles than `smallest_piece`. Since each
/// removal only weakens the rest, the result is the largest set in which every particle is supported, whatever the
/// order of removal. Its complement, `~set`, contains the particles to be removed.
///
///     for (const Index i : supported_particles(vectors(sites), {.spacing = l0})) reference.push_back(sites[i]);
///
/// Much of an organ one or two particles thick may be removed. Particles for which `keep(i)` holds are never removed,
/// nor is the piece that contains them; apply `find_weak` to the result to see which of them are weak. `thicken` adds
/// particles instead. Throws as `find_weak` does, and `InputError` if no particle would remain, with the apparent
/// spacing of the cloud.
template <class T, int D, class Keep = KeepNone, class Bonded = EveryBond>
[[nodiscard]] ParticleSet supported_particles(const VectorView<T, D>& points, const SupportSettings& settings,
                                              const Keep& keep = {}, const Bonded& bonded = {}) {
  const detail::Supports<T, D, Bonded> supports(points, settings, bonded);
  const std::size_t n = points.size();
  detail::require_scene(keep, n, "to be kept");
  std::vector<char> present = detail::without_weak(supports, n, settings.threshold, keep);

  const auto least = settings.smallest_piece * static_cast<double>(n);
  std::vector<char> seen(n, 0);
  std::vector<std::size_t> piece;
  for (std::size_t start = 0; start < n; ++start) {
    if (!present[start] || seen[start]) continue;
    piece.assign(1, start);
    seen[start] = 1;
    bool kept = false;
    for (std::size_t k = 0; k < piece.size(); ++k) {
      kept = kept || keep(piece[k]);
      supports.for_each(piece[k], [&](std::size_t j) {
        if (!present[j] || seen[j]) return;
        seen[j] = 1;
        piece.push_back(j);
      });
    }
    if (!kept && static_cast<double>(piece.size()) < least)
      for (const std::size_t i : piece) present[i] = 0;
  }

  ParticleSet left(n, [&](std::size_t j) { return present[j] != 0; });
  if (left.empty() && n > 0) {
    const std::string hint = detail::spacing_hint(points, settings.spacing, 0.15);
    detail::throw_input_error({"hmps: supported_particles finds none among ", n,
                               " particles: each is weakly supported or in a small piece",
                               hint.empty() ? "; thicken the body, use a finer lattice or a lower threshold" : hint});
  }
  return left;
}

}  // namespace hmps::inline HMPS_ABI
