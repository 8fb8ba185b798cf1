// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/cloud_order.hpp"
#include "hmps/bonds/own_bonds.hpp"
#include "hmps/bonds/plausible_spacing.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/places.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace hmps::inline HMPS_ABI {

/// The bonds of any cloud of particles in its reference configuration: w0 (\paper{8}) and A^-1 (\paper{12}); r0 is
/// computed when needed. `K` is the scalar type in which forces are evaluated, independent of that of the user's state.
///
/// The order of the particles does not matter: internally they are sorted into rods (`detail::CloudOrder`), in which
/// neighbours of consecutive particles are consecutive too, or nearly so. A row of bonds is a run of such neighbours
/// for each half of the lanes of a block, with a weight per lane, which is zero where there is no bond.
///
/// Models `Bonds`. `LatticeBonds` takes less memory and time for particles on a lattice.
template <class K, int D>
class BondList : public Blocks<K, D> {
  using Base = Blocks<K, D>;

 public:
  using Base::width;
  template <std::size_t N>
  using Slots = detail::SlotArrays<K, N>;  ///< storage for what bonds read of neighbours

  /// Bonds all pairs of `reference` (m) within the effective radius for which `bonded(i, j)` holds; the predicate must
  /// be symmetric. Throws `InputError` for coincident particles, positions that are not finite, neighbourhoods that do
  /// not span space, a spacing that does not fit the cloud (another unit, or far too large or small), a predicate that
  /// is not symmetric (unless particles may be unbonded), and a weight that is negative or not finite.
  template <class T, class Bonded = EveryBond, class Weight = PaperWeight>
  explicit BondList(const VectorView<T, D>& reference, const BondSettings& settings, Bonded&& bonded = {},
                    Weight&& weight = {})
      : Base(reference, checked_order(reference, settings)) {
    const double radius = settings.spacing * settings.radius_ratio;
    using S = typename VectorView<T, D>::Scalar;
    // Rounding in the user's scalar type must not decide whether a lattice neighbour is bonded.
    const auto reach = static_cast<S>(radius * (1 + 16 * static_cast<double>(std::numeric_limits<S>::epsilon())));
    const FixedRadiusSearch<T, D> search(reference);
    detail::require_plausible_spacing(search, settings, reach);
    const NeighbourList list = find_neighbours(search, reach);
    keep_bonds(
        static_cast<double>(reach),
        [&](Index i, const auto& keep) {
          for (const Index j : list[i]) {
            if (!detail::are_bonded(bonded, std::size_t{i}, std::size_t{j}, settings.unbonded)) continue;
            const Vector<double, D> r0 = this->reference(j) - this->reference(i);
            const double w = weight(std::min(r0.norm(), radius), radius);
            detail::require_weight(w, r0.norm());
            if (w > 0) keep(j, r0, w);
          }
        },
        settings.unbonded);
  }

  /// User-defined bonds: `neighbours` (`BondNeighbours`) specifies the bonds; `weights` is one number, one number per
  /// bond in the shape of `neighbours`, or a callable `w(i, j)`:
  ///
  ///     hmps::BondList<double, 3> bonds(X, pairs, weights);
  ///
  /// The order of the bonds does not matter. Throws `InputError`, naming the particles, for an index out of range, a
  /// bond of a particle to itself or to a coincident one, a bond that is repeated or given from one end only, a weight
  /// that is not positive and finite or differs between the ends, and neighbourhoods that do not span space.
  template <class T, BondNeighbours N, class W>
  requires(!std::convertible_to<const N&, BondSettings>)
      BondList(const VectorView<T, D>& reference, const N& neighbours, const W& weights)
      : BondList(reference, detail::OwnBonds::make<K>(reference.size(), neighbours, weights)) {}

  /// Calls `visit(j, r0, w)` for each bond of particle `i`: neighbour, reference position relative to `i` (m) and
  /// weight.
  template <class Visit>
  void for_each_bond(std::size_t i, Visit&& visit) const {
    const std::size_t own = this->slot(i), block = own / width, l = own % width;
    const std::int32_t* start = starts_.data() + groups_[block].start;
    for (std::size_t row = groups_[block].row; row < groups_[block + 1].row; ++row) {
      const bool split = row >= groups_[block].split;
      const std::int32_t first = start[split && l >= half_width ? 1 : 0];
      start += split ? 2 : 1;
      const K w = weights_[row].lane[l];
      if (!(w > K(0))) continue;
      const auto slot = static_cast<std::size_t>(first + static_cast<std::int32_t>(l));
      Vector<K, D> r0;
      for (int c = 0; c < D; ++c) {
        const K* const place = places_.slots(*this, c);
        r0[c] = places_.offset(place[slot], place[own]);
      }
      visit(this->particle(slot), r0, w);
    }
  }

  [[nodiscard]] std::size_t bytes() const {
    return Base::bytes() + places_.bytes() + weights_.size() * sizeof(Lanes<K>) +
           starts_.size() * sizeof(std::int32_t) + groups_.size() * sizeof(Group);
  }

  /// The slot from which on the last of the rows of `block` without a split reads.
  [[nodiscard]] HMPS_INLINE std::size_t last_slot(std::size_t block) const {
    const Group& group = groups_[block];
    if (group.split == group.row) return block * width;
    return static_cast<std::size_t>(std::max(starts_[group.start + group.split - group.row - 1], 0));
  }

  /// A row: at most one bond per lane of a block. The neighbour of lane l is slot `first + l`, or for the second half
  /// of a split row, slot `second + l`.
  template <bool split>
  class Row {
   public:
    HMPS_INLINE Row(const BondList& bonds, const Lanes<K>* own, const Lanes<K>& weights, const std::int32_t* start)
        : weights_(weights), first_(start[0]), second_(start[split ? 1 : 0]) {
      for (int c = 0; c < D; ++c) {
        const K* const places = bonds.places_.slots(bonds, c);
        if constexpr (split)
          r0_[c] = bonds.places_.offset(detail::load_halves(places + first_, places + second_), own[c]);
        else
          r0_[c] = bonds.places_.offset(detail::load(places + first_), own[c]);
      }
    }
    template <std::size_t N>
    [[nodiscard]] HMPS_INLINE auto gather(const detail::SlotArrays<K, N>& slots) const {
      if constexpr (split)
        return slots.run(first_, second_);
      else
        return slots.run(first_);
    }
    static constexpr bool skips = false;
    [[nodiscard]] HMPS_INLINE static constexpr bool along(int) { return true; }
    [[nodiscard]] HMPS_INLINE const Lanes<K>& offset(int c) const { return r0_[c]; }
    [[nodiscard]] HMPS_INLINE const Lanes<K>& weight() const { return weights_; }

   private:
    const Lanes<K>& weights_;
    std::ptrdiff_t first_, second_;
    Lanes<K> r0_[std::size_t{D}];
  };

  /// Calls `visit(row)` for each row of bonds of `block`: whole rows first, then split ones.
  template <class Visit>
  HMPS_INLINE void for_each_row(std::size_t block, Visit&& visit) const {
    Lanes<K> own[std::size_t{D}];
    for (int c = 0; c < D; ++c) own[c] = detail::load(places_.slots(*this, c) + block * width);
    const Group &group = groups_[block], &next = groups_[block + 1];
    const Lanes<K>* weights = weights_.data() + group.row;
    const Lanes<K>* const split = weights_.data() + group.split;
    const Lanes<K>* const end = weights_.data() + next.row;
    const std::int32_t* start = starts_.data() + group.start;
    for (; weights != split; ++weights, ++start) {
      detail::prefetch(weights + ahead);
      visit(Row<false>(*this, own, *weights, start));
    }
    for (; weights != end; ++weights, start += 2) {
      detail::prefetch(weights + ahead);
      visit(Row<true>(*this, own, *weights, start));
    }
  }

 private:
  static constexpr std::size_t half_width = width / 2;

  template <class T>
  BondList(const VectorView<T, D>& reference, const detail::OwnBonds& own)
      : Base(reference, checked_order(reference, {.spacing = own.spacing(reference)})) {
    keep_bonds(own.longest(reference), [&](Index i, const auto& keep) {
      for (const auto& bond : own[i])
        keep(bond.neighbour, this->reference(bond.neighbour) - this->reference(i), bond.weight);
    });
  }

  /// Stores the bonds for which `visit(i, keep)` calls `keep(j, r0, w)`; none may be longer than `reach` (m). Particles
  /// without bonds are an error unless they may be `unbonded`.
  template <class Visit>
  void keep_bonds(double reach, Visit&& visit, bool unbonded = false) {
    places_ = detail::Places<K, D>(*this, reach);
    groups_.reserve(this->block_count() + 1);
    groups_.push_back({});
    ShapeTensor<D> fullest;
    std::array<std::vector<Bond>, 2> halves;
    for (std::size_t block = 0; block < this->block_count(); ++block) {
      for (auto& half : halves) half.clear();
      for (std::size_t l = 0; l < width; ++l) {
        const Index i = this->particle(block * width + l);
        if (i == Base::none) break;
        ShapeTensor<D> shape;
        visit(i, [&](Index j, const Vector<double, D>& r0, double w) {
          halves[l / half_width].push_back({first_of(this->slot(j), l), static_cast<std::uint32_t>(l), K(w)});
          shape.add(r0, w);
        });
        this->keep_shape(i, shape.inverse(i, unbonded), shape.asymmetry, shape.A.trace());
        if (shape.weight > fullest.weight) fullest = shape;
      }
      add_rows(halves);
    }
    detail::require_standard_weight(fullest.weight);
    // Where no particle has a bond nothing is summed, whatever the scale.
    if (this->size() > 0)
      this->keep_standard(fullest.weight > 0 ? fullest.weight : 1,
                          fullest.weight > 0 ? fullest.A.trace() / fullest.weight : 1);
    weights_.resize(weights_.size() + ahead, Lanes<K>(K(0)));  // padding for the prefetch
    weights_.shrink_to_fit();
    starts_.shrink_to_fit();
  }

  /// A bond of one lane; its neighbour is slot `first + lane`.
  struct Bond {
    std::int32_t first;
    std::uint32_t lane;
    K w;
  };
  /// The first row of a block, its first split row, and the first entry of its runs in `starts_`.
  struct Group {
    std::uint32_t row = 0, split = 0, start = 0;
  };

  template <class T>
  [[nodiscard]] static std::vector<Index> checked_order(const VectorView<T, D>& reference,
                                                        const BondSettings& settings) {
    detail::validate(settings);
    require_finite(reference, "the reference position");
    return detail::CloudOrder<D>(reference, settings.spacing).order;
  }
  [[nodiscard]] static std::int32_t first_of(std::size_t neighbour, std::size_t lane) {
    return static_cast<std::int32_t>(neighbour) - static_cast<std::int32_t>(lane);
  }

  /// Adds the rows of the next block from the bonds of both halves of its lanes: one row for each run that both halves
  /// have, then one for each pair of runs that only one half has.
  void add_rows(std::array<std::vector<Bond>, 2>& halves) {
    std::array<std::vector<std::size_t>, 2> alone;  // where in `halves` a run begins
    const auto run = [&](std::size_t h, std::size_t k) {
      if (k >= halves[h].size()) return std::numeric_limits<std::int32_t>::max();
      return halves[h][k].first;
    };
    /// Writes the weights of the run at `k` of one half into the row; returns the start of the next run.
    const auto fill = [&](std::size_t h, std::size_t k, Lanes<K>& row) {
      const std::int32_t first = run(h, k);
      for (; run(h, k) == first && k < halves[h].size(); ++k) row.lane[halves[h][k].lane] = halves[h][k].w;
      return k;
    };
    for (auto& half : halves)
      std::sort(half.begin(), half.end(), [](const Bond& a, const Bond& b) { return a.first < b.first; });
    Lanes<K> skipped;
    for (std::array<std::size_t, 2> k{0, 0}; k[0] < halves[0].size() || k[1] < halves[1].size();) {
      const std::int32_t first = run(0, k[0]), second = run(1, k[1]);
      if (first == second) {
        starts_.push_back(first);
        Lanes<K>& row = weights_.emplace_back(K(0));
        for (std::size_t h = 0; h < 2; ++h) k[h] = fill(h, k[h], row);
      } else {
        const std::size_t h = first < second ? 0 : 1;
        alone[h].push_back(k[h]);
        k[h] = fill(h, k[h], skipped);
      }
    }
    groups_.back().split = static_cast<std::uint32_t>(weights_.size());
    for (std::size_t k = 0; k < std::max(alone[0].size(), alone[1].size()); ++k) {
      Lanes<K>& row = weights_.emplace_back(K(0));
      for (std::size_t h = 0; h < 2; ++h) {
        // A half without a run reads the run of the other half.
        const std::size_t of = k < alone[h].size() ? h : 1 - h;
        starts_.push_back(run(of, alone[of][k]));
        if (of == h) fill(h, alone[h][k], row);
      }
    }
    groups_.push_back({static_cast<std::uint32_t>(weights_.size()), 0, static_cast<std::uint32_t>(starts_.size())});
  }

  /// Prefetch distance of weights in rows; without it, the sweeps wait for them.
  static constexpr std::size_t ahead = 12;
  detail::Places<K, D> places_;
  std::vector<Lanes<K>> weights_;     ///< Of each row.
  std::vector<std::int32_t> starts_;  ///< From which slot on the runs of a row read, one or, if it is split, two.
  std::vector<Group> groups_;         ///< Of each block, and one behind the last.
};

}  // namespace hmps::inline HMPS_ABI
