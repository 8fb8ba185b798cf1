// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <vector>

#include "hmps/bonds/bond_settings.hpp"
#include "hmps/bonds/shape_tensor.hpp"
#include "hmps/bonds/weight.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/search/fixed_radius.hpp"

namespace hmps {

/// The bonds of any cloud of particles in its reference configuration: r0, w0 (\paper{8}) and A^-1
/// (\paper{12}), a list for each particle. `K` is the scalar type in which forces are evaluated,
/// whatever that of the user's state. Satisfies the `Bonds` concept, as `LatticeBonds` does, which
/// takes a tenth of the memory where particles lie on a lattice.
template <class K, int D>
class BondList : public Blocks<K, D> {
  using Base = Blocks<K, D>;

 public:
  using Base::width;
  template <std::size_t N>
  using Slots = SlotRecords<K, N>;  ///< In which the sweeps keep what bonds read of neighbours.

  /// Bonds all pairs of `reference` (m) no further apart than the effective radius for which
  /// `bonded(i, j)` holds, which must not depend on the order of i and j. Throws `InputError` for
  /// coincident particles, positions that are not finite and neighbourhoods that do not span space.
  template <class T, class Bonded = EveryBond, class Weight = PaperWeight>
  explicit BondList(const VectorView<T, D>& reference, const BondSettings& settings, Bonded&& bonded = {},
                    Weight&& weight = {})
      : Base(reference, natural_order(reference.size())) {
    detail::validate(settings);
    const double radius = settings.spacing * settings.radius_ratio;
    using S = typename VectorView<T, D>::Scalar;
    // Rounding in the user's scalar must not decide whether a lattice neighbour is one.
    const auto reach = static_cast<S>(radius * (1 + 16 * static_cast<double>(std::numeric_limits<S>::epsilon())));
    NeighbourList list = find_neighbours(reference, reach);
    first_row_.push_back(0);
    ShapeTensor<D> fullest;
    for (std::size_t block = 0; block < this->block_count(); ++block) {
      const std::size_t start = rows_.size();
      for (std::size_t l = 0; l < width; ++l) {
        const std::size_t i = block * width + l;
        if (i >= this->size()) break;
        ShapeTensor<D> shape;
        std::size_t row = start;
        for (Index j : list[i]) {
          if (!bonded(i, static_cast<std::size_t>(j))) continue;
          const Vector<double, D> r0 = this->reference(j) - this->reference(i);
          const double w = weight(std::min(r0.norm(), radius), radius);
          if (!(w > 0)) continue;
          if (row == rows_.size()) rows_.push_back(Row(block * width));
          for (int c = 0; c < D; ++c) rows_[row].r0[c][l] = static_cast<K>(r0[c]);
          rows_[row].w[l] = static_cast<K>(w);
          rows_[row].neighbour[l] = j;
          ++row;
          shape.add(r0, w);
        }
        this->keep_shape(i, shape.inverse(i), shape.asymmetry, shape.A.trace());
        if (shape.weight > fullest.weight) fullest = shape;
      }
      first_row_.push_back(rows_.size());
    }
    if (this->size() > 0) this->keep_standard(fullest.weight, fullest.A.trace() / fullest.weight);
  }

  /// Calls `visit(j, r0, w)` for each bond of particle `i`: neighbour, reference position relative
  /// to `i` (m) and weight.
  template <class Visit>
  void for_each_bond(std::size_t i, Visit&& visit) const {
    const std::size_t l = i % width;
    for (std::size_t row = first_row_[i / width]; row < first_row_[i / width + 1]; ++row) {
      const Row& bond = rows_[row];
      if (!(bond.w[l] > 0)) continue;
      Vector<K, D> r0;
      for (int c = 0; c < D; ++c) r0[c] = bond.r0[c][l];
      visit(bond.neighbour[l], r0, bond.w[l]);
    }
  }

  [[nodiscard]] std::size_t bytes() const {
    return Base::bytes() + rows_.size() * sizeof(Row) + first_row_.size() * sizeof(std::size_t);
  }

  /// One bond of every lane of a block, as the sweeps see it.
  struct Row {
    alignas(64) K r0[D][width]{};
    alignas(64) K w[width]{};
    Index neighbour[width];

    /// No bond in any lane yet: weight zero towards the particle itself.
    explicit Row(std::size_t first_slot) {
      for (std::size_t l = 0; l < width; ++l) neighbour[l] = static_cast<Index>(first_slot + l);
    }
    template <std::size_t N>
    [[nodiscard]] HMPS_INLINE std::array<Lanes<K>, N> gather(const SlotRecords<K, N>& slots) const {
      return slots.gather(neighbour);
    }
    static constexpr bool skips = false;
    [[nodiscard]] HMPS_INLINE static constexpr bool along(int) { return true; }
    [[nodiscard]] HMPS_INLINE Lanes<K> offset(int c) const { return load(r0[c]); }
    [[nodiscard]] HMPS_INLINE Lanes<K> weight() const { return load(w); }
    HMPS_INLINE void prefetch() const {
      for (std::size_t k = 0; k < sizeof(Row); k += detail::lanes_bytes)
        detail::prefetch(reinterpret_cast<const char*>(this) + k);
    }
  };

  /// Calls `visit(row)` for each row of bonds of `block`.
  template <class Visit>
  HMPS_INLINE void for_each_row(std::size_t block, Visit&& visit) const {
    for (std::size_t row = first_row_[block]; row < first_row_[block + 1]; ++row) {
      rows_[std::min(row + ahead, rows_.size() - 1)].prefetch();
      visit(rows_[row]);
    }
  }

 private:
  [[nodiscard]] static std::vector<Index> natural_order(std::size_t size) {
    std::vector<Index> order(size);
    std::iota(order.begin(), order.end(), Index{0});
    return order;
  }

  /// How many rows before it is visited a row is asked for: without that, half of the time is spent waiting for them.
  static constexpr std::size_t ahead = 6;
  std::vector<Row> rows_;
  std::vector<std::size_t> first_row_;
};

}  // namespace hmps
