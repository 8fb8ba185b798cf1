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
#include "hmps/bonds/detail/bond_runs.hpp"
#include "hmps/bonds/detail/cloud_order.hpp"
#include "hmps/bonds/detail/plausible_spacing.hpp"
#include "hmps/bonds/own_bonds.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/detail/places.hpp"
#include "hmps/lanes/detail/volume_shares.hpp"
#include "hmps/search/detail/resolution.hpp"
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
  using Slots = detail::SlotArrays<K, N>;  ///< storage for the numbers that bonds read from neighbours

  /// Bonds all pairs of `reference` (m) within the effective radius for which `bonded(i, j)` holds; the predicate must
  /// be symmetric. Throws `InputError` for particles closer than a thousandth of a spacing, positions that are not
  /// finite, neighbourhoods that do not span space, a spacing that does not fit the cloud (another unit, or far too
  /// large or small), a predicate that is not symmetric (unless particles may be unbonded), and a weight that is
  /// negative or not finite.
  template <class T, class Bonded = EveryBond, class Weight = PaperWeight>
  requires(!detail::IsScalarView<std::remove_cvref_t<Bonded>>::value) explicit BondList(
      const VectorView<T, D>& reference, const BondSettings& settings, Bonded&& bonded = {}, Weight&& weight = {})
      : Base(reference, checked_order(reference, settings)) {
    find_bonds(reference, settings, bonded, weight);
  }
  /// Explains calls with an array in place of a view.
  template <class X>
  requires(!detail::AreWrapped<X>::value) BondList(const X&, const BondSettings&, detail::RequireViews<X> = {});

  /// The same for particles of different `volumes` (m3; in 2D m2), such as those of `fit_particles`. The weight of a
  /// bond of particle i is w V_j / l0^D, so that all sums over bonds are over volumes of material. Forces remain
  /// densities; multiplied by the volume of each particle they sum to zero, and those of terms with an energy derive
  /// from the energy with these volumes. Pass the same volumes to energies, momenta, `Organ::volume` and
  /// `RelaxationSettings::volume`, or none to any of them. This costs nothing in a sweep. Also throws `InputError` for
  /// a volume that is not positive, and for volumes whose mean differs from l0^D by more than a factor of 8, as it does
  /// in another unit.
  template <class T, class V, class Bonded = EveryBond, class Weight = PaperWeight>
  BondList(const VectorView<T, D>& reference, const BondSettings& settings, const ScalarView<V>& volumes,
           Bonded&& bonded = {}, Weight&& weight = {})
      : Base(reference, checked_order(reference, settings)),
        shares_(detail::volume_shares<D>(volumes, reference.size(), settings.spacing), *this) {
    find_bonds(reference, settings, bonded, weight);
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
      : BondList(reference, detail::OwnBonds<K>::make(reference.size(), neighbours, weights)) {}

  /// Calls `visit(j, r0, w)` for each bond of particle `i`: neighbour, reference position relative to `i` (m) and
  /// weight.
  template <class Visit>
  void for_each_bond(std::size_t i, Visit&& visit) const {
    const std::size_t own = this->slot(i), block = own / width, l = own % width;
    const std::int32_t* start = runs_.starts.data() + runs_.groups[block].start;
    for (std::size_t row = runs_.groups[block].row; row < runs_.groups[block + 1].row; ++row) {
      const bool split = row >= runs_.groups[block].split;
      const std::int32_t first = start[split && l >= half_width ? 1 : 0];
      start += split ? 2 : 1;
      const K w = runs_.weights[row].lane[l];
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

  /// Whether the bonds were given the volumes of their particles.
  [[nodiscard]] bool knows_volumes() const { return shares_.bytes() > 0; }
  /// V / l0^D of a particle; 1 if the bonds were given no volumes.
  [[nodiscard]] double volume_share(std::size_t i) const { return shares_.of(this->slot(i)); }
  /// The same for the particles of `block`.
  [[nodiscard]] HMPS_INLINE Lanes<K> volume_share_lanes(std::size_t block) const { return shares_.lanes(block); }

  [[nodiscard]] std::size_t bytes() const { return Base::bytes() + places_.bytes() + shares_.bytes() + runs_.bytes(); }

  /// See `Blocks::last_slot`: the first slot of the last unsplit row.
  [[nodiscard]] HMPS_INLINE std::size_t last_slot(std::size_t block) const {
    const auto& group = runs_.groups[block];
    if (group.split == group.row) return block * width;
    return static_cast<std::size_t>(std::max(runs_.starts[group.start + group.split - group.row - 1], 0));
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
    const auto &group = runs_.groups[block], &next = runs_.groups[block + 1];
    const Lanes<K>* weights = runs_.weights.data() + group.row;
    const Lanes<K>* const split = runs_.weights.data() + group.split;
    const Lanes<K>* const end = runs_.weights.data() + next.row;
    const std::int32_t* start = runs_.starts.data() + group.start;
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
  /// Particles closer than this many spacings are duplicates that differ by rounding.
  static constexpr double closest = 1e-3;

  template <class T, class Bonded, class Weight>
  void find_bonds(const VectorView<T, D>& reference, const BondSettings& settings, Bonded& bonded, Weight& weight) {
    const double radius = settings.spacing * settings.radius_ratio;
    const auto reach = detail::reach_of(reference, radius);  // rounding must not decide about a lattice neighbour
    const FixedRadiusSearch<T, D> search(reference);
    detail::require_plausible_spacing(search, settings, reach);
    const NeighbourList list = find_neighbours(search, reach);
    set_bonds(
        static_cast<double>(reach), settings.spacing,
        [&](Index i, const auto& keep) {
          for (const Index j : list[i]) {
            if (!detail::are_bonded(bonded, std::size_t{i}, std::size_t{j}, settings.unbonded)) continue;
            const Vector<double, D> r0 = this->reference(j) - this->reference(i);
            const double distance = r0.norm();
            detail::require(distance >= closest * settings.spacing, "hmps: particles ", i, " and ", j, " are only ",
                            distance, " m apart, ", distance / settings.spacing,
                            " spacings, as if one body had been filled twice; remove one of them");
            const double w = weight(std::min(distance, radius), radius);
            detail::require_weight(w, distance);
            if (w > 0) keep(j, r0, w * volume_share(j));
          }
        },
        settings.unbonded);
  }

  template <class T>
  BondList(const VectorView<T, D>& reference, const detail::OwnBonds<K>& own)
      : Base(reference, checked_order(reference, {.spacing = own.spacing(reference)})) {
    set_bonds(own.longest(reference), own.spacing(reference), [&](Index i, const auto& keep) {
      for (const auto& bond : own[i])
        keep(bond.neighbour, this->reference(bond.neighbour) - this->reference(i), bond.weight);
    });
  }

  /// Stores the bonds for which `visit(i, keep)` calls `keep(j, r0, w)`; none may be longer than `reach` (m). `spacing`
  /// (m) is that of the particles. Particles without bonds are an error unless they may be `unbonded`. The standard
  /// neighbourhood is the one with the largest sum of w r0^2, to which a neighbour that is too close adds little.
  template <class Visit>
  void set_bonds(double reach, double spacing, Visit&& visit, bool unbonded = false) {
    places_ = detail::Places<K, D>(*this, reach);
    runs_.reserve(this->block_count());
    ShapeTensor<D> fullest;
    detail::DisjointSets joined(this->size());
    std::array<std::vector<typename detail::BondRuns<K>::Bond>, 2> halves;
    for (std::size_t block = 0; block < this->block_count(); ++block) {
      for (auto& half : halves) half.clear();
      for (std::size_t l = 0; l < width; ++l) {
        const Index i = this->particle(block * width + l);
        if (i == Base::none) break;
        ShapeTensor<D> shape;
        visit(i, [&](Index j, const Vector<double, D>& r0, double w) {
          halves[l / half_width].push_back({first_of(this->slot(j), l), static_cast<std::uint32_t>(l), K(w)});
          shape.add(r0, w);
          if (j > i) joined.join(i, j);
        });
        this->set_shape(i, shape.inverse(i, unbonded), shape.asymmetry, shape.A.trace());
        if (shape.A.trace() > fullest.A.trace()) fullest = shape;
      }
      runs_.add(halves);
    }
    detail::require_standard_weight(fullest.weight);
    // If no particle has a bond, nothing is summed and any scale will do.
    if (this->size() > 0)
      this->set_standard(fullest.weight > 0 ? fullest.weight : 1,
                         fullest.weight > 0 ? fullest.A.trace() / fullest.weight : spacing * spacing);
    this->set_pieces(joined, spacing);
    runs_.pad(ahead);
  }

  template <class T>
  [[nodiscard]] static std::vector<Index> checked_order(const VectorView<T, D>& reference,
                                                        const BondSettings& settings) {
    detail::validate(settings);
    require_finite(reference, "the reference position");
    detail::require_resolved(reference, settings.spacing);
    return detail::CloudOrder<D>(reference, settings.spacing).order;
  }
  [[nodiscard]] static std::int32_t first_of(std::size_t neighbour, std::size_t lane) {
    return static_cast<std::int32_t>(neighbour) - static_cast<std::int32_t>(lane);
  }

  /// Prefetch distance of the weights in rows; without prefetching, the sweeps wait for them.
  static constexpr std::size_t ahead = 12;
  detail::VolumeShares<K> shares_;
  detail::Places<K, D> places_;
  detail::BondRuns<K> runs_;
};

}  // namespace hmps::inline HMPS_ABI
