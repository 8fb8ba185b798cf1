// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/detail/lattice_cells.hpp"
#include "hmps/bonds/detail/lattice_rows.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/detail/disjoint_sets.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/search/nearest_spacing.hpp"

namespace hmps::inline HMPS_ABI {

/// The axes of the order in which the sweeps over `LatticeBonds` visit particles on a cubic lattice of `spacing` (m),
/// the slowest first. Pass the axes of a whole body as `BondSettings::axes` of its parts. Throws `InputError` for
/// particles off the lattice or at the same site.
template <class T, int D>
[[nodiscard]] std::array<int, 3> lattice_axes(const VectorView<T, D>& reference, double spacing) {
  std::array<int, 3> axes{};
  const detail::LatticeCells<D> cells(reference, spacing);
  std::copy(cells.axis.begin(), cells.axis.end(), axes.begin());
  return axes;
}

/// The bonds of particles on a simple cubic lattice in their reference configuration. All particles share the offsets
/// r0 and weights w0 (\paper{8}). For each offset, a block of particles stores the runs of consecutive neighbours,
/// eight bytes each, or windows from which neighbours are picked, eight bytes plus one per lane each. Particles may
/// deviate from their sites by the rounding of the user's scalar type, up to a thousandth of the spacing; r0 is that of
/// the lattice. Models `Bonds`.
template <class K, int D>
class LatticeBonds : public Blocks<K, D> {
  using Base = Blocks<K, D>;

 public:
  using Base::width;
  template <std::size_t N>
  using Slots = detail::SlotArrays<K, N>;  ///< storage for the numbers that bonds read from neighbours

  /// Bonds all pairs of `reference` (m, in any order, on one lattice) within the effective radius for which `bonded(i,
  /// j)` holds. Throws `InputError` for particles off the lattice, with their apparent spacing, for coincident
  /// particles, for an empty body, and for neighbourhoods that do not span space.
  template <class T, class Bonded = EveryBond, class Weight = PaperWeight>
  explicit LatticeBonds(const VectorView<T, D>& reference, const BondSettings& settings, Bonded&& bonded = {},
                        Weight&& weight = {})
      : LatticeBonds(reference, settings, checked_cells(reference, settings), bonded, weight) {}
  /// Explains calls with an array in place of a view.
  template <class X>
  requires(!detail::AreWrapped<X>::value) LatticeBonds(const X&, const BondSettings&, detail::RequireViews<X> = {});

  /// Calls `visit(j, r0, w)` for each bond of particle `i`: neighbour, reference position relative
  /// to `i` (m) and weight.
  template <class Visit>
  void for_each_bond(std::size_t i, Visit&& visit) const {
    const std::size_t slot = this->slot(i), block = slot / width, l = slot % width;
    for (const auto* row = rows_.begin(block * directions); row != rows_.begin((block + 1) * directions); ++row) {
      if ((row->lanes >> l & 1u) == 0) continue;
      Vector<K, D> r0;
      for (int c = 0; c < D; ++c) r0[c] = offset_[row->offset].r0[c];
      visit(this->particle(rows_.neighbour(block, row, l)), r0, offset_[row->offset].w);
    }
  }

  [[nodiscard]] std::size_t bytes() const { return Base::bytes() + rows_.bytes(); }

  /// See `Blocks::last_slot`: the first slot of the last row.
  [[nodiscard]] HMPS_INLINE std::size_t last_slot(std::size_t block) const {
    const auto *first = rows_.begin(block * directions), *end = rows_.begin((block + 1) * directions);
    return first == end ? block * width : static_cast<std::size_t>(std::max((end - 1)->first, 0));
  }

  /// A row: at most one bond per lane of a block. The neighbour of lane l is slot `first + l`; r0 has nonzero
  /// components along `Axes` only (bit c for component c).
  template <unsigned Axes>
  struct Row {
    const K* r0;
    Lanes<K> w;
    std::ptrdiff_t first;

    template <std::size_t N>
    [[nodiscard]] HMPS_INLINE auto gather(const detail::SlotArrays<K, N>& slots) const {
      return slots.run(first);
    }
    [[nodiscard]] HMPS_INLINE static constexpr bool along(int c) { return (Axes >> c & 1u) != 0; }
    [[nodiscard]] HMPS_INLINE K offset(int c) const { return r0[c]; }
    [[nodiscard]] HMPS_INLINE const Lanes<K>& weight() const { return w; }
  };
  /// The same for a neighbour at slot `first + places[l]` and any r0: one type for all axes, to compile in less time.
  struct WindowRow {
    const K* r0;
    Lanes<K> w;
    std::size_t first;
    detail::WindowPlaces<K> places;

    template <std::size_t N>
    [[nodiscard]] HMPS_INLINE auto gather(const detail::SlotArrays<K, N>& slots) const {
      return slots.window(first, places);
    }
    [[nodiscard]] HMPS_INLINE static constexpr bool along(int) { return true; }
    [[nodiscard]] HMPS_INLINE K offset(int c) const { return r0[c]; }
    [[nodiscard]] HMPS_INLINE const Lanes<K>& weight() const { return w; }
  };

  /// Calls `visit(row)` for each row of bonds of `block`, grouped by axes. In runs, each set of axes has its own type
  /// of row, so that the compiler removes computations with zero components.
  template <class Visit>
  HMPS_INLINE void for_each_row(std::size_t block, Visit&& visit) const {
    for_each_row(block, visit, std::make_integer_sequence<unsigned, directions>{});
  }

 private:
  using Rows = detail::LatticeRows<K, D>;
  static constexpr unsigned directions = Rows::directions;

  template <class Visit, unsigned... Directions>
  HMPS_INLINE void for_each_row(std::size_t block, Visit& visit, std::integer_sequence<unsigned, Directions...>) const {
    if (!rows_.has_windows(block))
      (for_each_run_along<Directions>(block, visit), ...);
    else
      for_each_window(block, visit);
  }
  template <unsigned Direction, class Visit>
  HMPS_INLINE void for_each_run_along(std::size_t block, Visit& visit) const {
    const std::size_t group = block * directions + Direction;
    for (const auto *row = rows_.begin(group), *end = rows_.end(group); row != end; ++row) {
      const Offset& offset = offset_[row->offset];
      visit(Row<Direction + 1>{offset.r0, detail::spread(row->lanes, offset.w), row->first});
    }
  }
  template <class Visit>
  HMPS_INLINE void for_each_window(std::size_t block, Visit& visit) const {
    const auto* places = rows_.places(block);
    const auto *row = rows_.begin(block * directions), *const end = rows_.begin((block + 1) * directions);
    for (; row != end; ++row, ++places) {
      const Offset& offset = offset_[row->offset];
      visit(WindowRow{offset.r0, detail::spread(row->lanes, offset.w), static_cast<std::size_t>(row->first),
                      detail::WindowPlaces<K>(*places)});
    }
  }

  struct Offset {
    K r0[std::size_t{D}];
    K w;
  };

  template <class T>
  [[nodiscard]] static detail::LatticeCells<D> checked_cells(const VectorView<T, D>& reference,
                                                             const BondSettings& settings) {
    detail::validate(settings);
    detail::require(reference.size() > 0,
                    "hmps: there are no particles to bond; check what should have made them (shape, spacing, "
                    "removal of weak ones)");
    require_finite(reference, "the reference position");
    std::array<int, std::size_t{D}> axes{};
    std::copy_n(settings.axes.begin(), D, axes.begin());
    detail::LatticeCells<D> cells(reference, settings.spacing, axes);
    detail::require_resolved(reference, settings.spacing);
    return cells;
  }

  template <class T, class Bonded, class Weight>
  LatticeBonds(const VectorView<T, D>& reference, const BondSettings& settings, const detail::LatticeCells<D>& cells,
               Bonded& bonded, Weight& weight)
      : Base(reference, cells.order) {
    const std::size_t n = this->size();
    std::vector<std::int64_t> keys(n);
    for (std::size_t s = 0; s < n; ++s) keys[s] = cells.key(cells.cell[cells.order[s]]);

    std::vector<typename Rows::Placed> placed;
    std::vector<ShapeTensor<D>> shapes(n);
    ShapeTensor<D> inside;
    detail::DisjointSets joined(n);
    detail::require(settings.radius_ratio >= 1 && settings.radius_ratio < 16, "hmps: the effective radius is ",
                    settings.radius_ratio, " spacings; on a lattice it must be at least 1 and below 16");
    for (const detail::LatticeCell<D>& cell : sorted_around(cells, settings.radius_ratio)) {
      Vector<double, D> r0;
      for (int c = 0; c < D; ++c) r0[c] = settings.spacing * cell[static_cast<std::size_t>(c)];
      const double radius = settings.spacing * settings.radius_ratio;
      const double w = weight(std::min(r0.norm(), radius), radius);
      detail::require_weight(w, r0.norm());
      if (!(w > 0)) continue;
      inside.add(r0, w);
      Offset& offset = offset_.emplace_back();
      for (int c = 0; c < D; ++c) offset.r0[c] = static_cast<K>(r0[c]);
      offset.w = static_cast<K>(w);
      const std::int64_t step = cells.key(cell);
      // Slots are sorted by key, so that neighbours at one offset are found in order.
      for (std::size_t s = 0, t = 0; s < n; ++s) {
        while (t < n && keys[t] < keys[s] + step) ++t;
        if (t == n) break;
        if (keys[t] != keys[s] + step ||
            !detail::are_bonded(bonded, this->particle(s), this->particle(t), settings.unbonded))
          continue;
        shapes[this->particle(s)].add(r0, w);
        if (t > s) joined.join(this->particle(s), this->particle(t));
        const std::size_t group = s / width * directions + axes_of(cell) - 1;
        const auto first =
            static_cast<std::int32_t>(static_cast<std::ptrdiff_t>(t) - static_cast<std::ptrdiff_t>(s % width));
        const auto k = static_cast<std::uint16_t>(offset_.size() - 1);
        if (placed.empty() || placed.back().group != group || placed.back().run.first != first ||
            placed.back().run.offset != k)
          placed.push_back({group, {first, 0, k}});
        placed.back().run.lanes = static_cast<std::uint16_t>(placed.back().run.lanes | 1u << s % width);
      }
    }
    if (placed.empty() && n > 1) {  // otherwise the particle without neighbours is reported
      const std::string hint = detail::spacing_hint(reference, settings.spacing);
      if (!hint.empty()) throw InputError("hmps: no two particles are close enough to be bonded" + hint);
    }
    rows_ = Rows(placed, this->block_count());
    for (std::size_t i = 0; i < n; ++i)
      this->set_shape(i, shapes[i].inverse(i, settings.unbonded), shapes[i].asymmetry, shapes[i].A.trace());
    this->share_shapes();
    this->set_pieces(joined, settings.spacing);
    detail::require_standard_weight(inside.weight);
    this->set_standard(inside.weight, inside.A.trace() / inside.weight);
  }

  /// The cells within `radius_ratio`, sorted by axes, then by slot, so that the sweeps read memory in one direction.
  [[nodiscard]] static std::vector<detail::LatticeCell<D>> sorted_around(const detail::LatticeCells<D>& cells,
                                                                         double radius_ratio) {
    constexpr std::int64_t step = std::int64_t{1} << 50;  // more than twice any key, and less than a seventh of 2^63
    auto around = detail::cells_within<D>(radius_ratio);
    // As numbers, which are sorted elsewhere too: sorting cells would cost every program compile time.
    std::vector<std::int64_t> places;
    for (const auto& cell : around) places.push_back(axes_of(cell) * step + cells.key(cell));
    std::sort(places.begin(), places.end());
    for (std::size_t k = 0; k < around.size(); ++k) around[k] = cells.cell_of((places[k] + step / 2) % step - step / 2);
    return around;
  }
  /// The axes along which `cell` differs from the origin.
  [[nodiscard]] static unsigned axes_of(const detail::LatticeCell<D>& cell) {
    unsigned axes = 0;
    for (int c = 0; c < D; ++c)
      if (cell[static_cast<std::size_t>(c)] != 0) axes |= 1u << c;
    return axes;
  }

  std::vector<Offset> offset_;
  Rows rows_;
};

}  // namespace hmps::inline HMPS_ABI
