// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

template <class P>
concept TupleOfTwo = requires {
  std::tuple_size<P>::value;
}
&&std::tuple_size<P>::value == 2;
template <class P>
concept IndexPair = TupleOfTwo<P> && requires(const P& pair) {
  { std::get<0>(pair) } -> std::convertible_to<std::size_t>;
  { std::get<1>(pair) } -> std::convertible_to<std::size_t>;
};
template <class N>
using ElementOf = std::remove_cvref_t<decltype(std::declval<const N&>()[std::size_t{0}])>;

/// Pairs of particles, each bond once.
template <class N>
concept BondPairs = requires(const N& pairs) {
  { pairs.size() } -> std::convertible_to<std::size_t>;
  requires IndexPair<ElementOf<N>>;
};
/// A list of neighbours for each particle, each bond from both ends.
template <class N>
concept NeighbourLists = !BondPairs<N> && requires(const N& lists) {
  { lists.size() } -> std::convertible_to<std::size_t>;
  { lists[std::size_t{0}].size() } -> std::convertible_to<std::size_t>;
  { lists[std::size_t{0}][0] } -> std::convertible_to<std::size_t>;
};

}  // namespace detail

/// Specifies which particles are bonded, for `BondList`: a range of pairs of indices (`std::pair` or `std::array`),
/// with each bond once; or a list of neighbours per particle, such as `std::vector<std::vector<Index>>` or
/// `NeighbourList`, with each bond in the lists of both ends.
template <class N>
concept BondNeighbours = detail::BondPairs<N> || detail::NeighbourLists<N>;

namespace detail {

/// User-defined bonds after all checks, from both ends, sorted by particle and neighbour regardless of the given order.
template <class K>
class OwnBonds {
 public:
  struct Bond {
    Index neighbour;
    double weight;
  };

  /// For `size` particles. `weights` is one weight for all bonds, or one number per bond in the shape of `neighbours`,
  /// or a callable `w(i, j)`, which must be symmetric. Weights must lie between 1e-30 and 1e30, and not vanish in the
  /// scalar type `K`. The force does not depend on their common factor.
  template <BondNeighbours N, class W>
  static OwnBonds make(std::size_t size, const N& neighbours, const W& weights) {
    OwnBonds own(size);
    if constexpr (BondPairs<N>) {
      if constexpr (is_given<W>)
        require(weights.size() == neighbours.size(), "hmps: there are ", neighbours.size(), " bonds but ",
                weights.size(), " weights; give one for each");
      for (std::size_t k = 0; k < neighbours.size(); ++k) {
        const auto i = own.checked(std::get<0>(neighbours[k]), k), j = own.checked(std::get<1>(neighbours[k]), k);
        const double w = own.weight(weights, i, j, [&] {
          if constexpr (is_given<W>)
            return weights[k];
          else
            return 0.0;
        });
        own.add(i, j, w);
        own.add(j, i, w);
      }
      own.settle();
    } else {
      require(neighbours.size() == size, "hmps: there are ", neighbours.size(), " lists of neighbours but ", size,
              " particles; give one for each, empty or not");
      for (std::size_t i = 0; i < size; ++i) own.add_list(i, neighbours[i], weights);
      own.settle();
      own.require_both_ends();
    }
    return own;
  }

  [[nodiscard]] const std::vector<Bond>& operator[](std::size_t i) const { return bonds_[i]; }
  /// The longest bond (m), 1 if there is none. Throws `InputError` for two bonded particles at the same place.
  template <class T, int D>
  [[nodiscard]] double longest(const VectorView<T, D>& reference) const {
    double square = 0;
    for_each_length(reference, [&](std::size_t, double s) { square = std::max(square, s); });
    return square > 0 ? std::sqrt(square) : 1;
  }
  /// The mean over all particles of the length of their shortest bond (m), used as the spacing for their order. 1 if
  /// there is no bond.
  template <class T, int D>
  [[nodiscard]] double spacing(const VectorView<T, D>& reference) const {
    require_finite(reference, "the reference position");
    std::vector<double> shortest(bonds_.size(), std::numeric_limits<double>::max());
    for_each_length(reference, [&](std::size_t i, double s) { shortest[i] = std::min(shortest[i], s); });
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < shortest.size(); ++i)
      if (!bonds_[i].empty()) {
        sum += std::sqrt(shortest[i]);
        ++count;
      }
    return count > 0 ? sum / count : 1;
  }

 private:
  /// Whether `weights` has one number per bond.
  template <class W>
  static constexpr bool is_given = !std::is_arithmetic_v<W> && !std::invocable<const W&, std::size_t, std::size_t>;

  explicit OwnBonds(std::size_t size) : bonds_(size) {}

  template <class I>
  [[nodiscard]] std::size_t checked(const I& i, std::size_t bond) const {
    const auto index = static_cast<std::size_t>(i);
    require(index < bonds_.size(), "hmps: bond ", bond, " names particle ", i, " but there are only ", bonds_.size(),
            "; indices start at 0");
    return index;
  }

  template <class W, class Given>
  [[nodiscard]] static double weight(const W& weights, std::size_t i, std::size_t j, Given&& given) {
    const double w = [&] {
      if constexpr (std::is_arithmetic_v<W>)
        return static_cast<double>(weights);
      else if constexpr (!is_given<W>)
        return static_cast<double>(weights(i, j));
      else
        return static_cast<double>(given());
    }();
    if constexpr (!std::is_arithmetic_v<W> && !is_given<W>) {
      const double back = static_cast<double>(weights(j, i));
      require(back == w || !is_finite(w), "hmps: the bond of particles ", i, " and ", j, " has the weight ", w,
              " as w(", i, ", ", j, ") and ", back, " as w(", j, ", ", i, "); both must be the same");
    }
    require(
        is_finite(w) && is_finite(static_cast<K>(w)) && static_cast<K>(w) > K(0),
        "hmps: the weight of the bond of particles ", i, " and ", j, " is ", w,
        "; it must be positive and finite in the scalar type of the bonds. Leave out bonds that should carry nothing");
    // Outside these limits, products of weights overflow or vanish in the inverse of A.
    require(w >= 1e-30 && w <= 1e30, "hmps: the weight of the bond of particles ", i, " and ", j, " is ", w,
            "; give weights between 1e-30 and 1e30 (a common factor of all weights changes nothing)");
    return w;
  }

  template <class L, class W>
  void add_list(std::size_t i, const L& list, const W& weights) {
    if constexpr (is_given<W>)
      require(weights.size() == bonds_.size() && weights[i].size() == list.size(), "hmps: particle ", i, " has ",
              list.size(), " neighbours but another number of weights; give each particle a weight per neighbour");
    for (std::size_t k = 0; k < list.size(); ++k) {
      const auto j = static_cast<std::size_t>(list[k]);
      require(j < bonds_.size(), "hmps: particle ", i, " has the neighbour ", list[k], " but there are only ",
              bonds_.size(), " particles; indices start at 0");
      const double w = weight(weights, i, j, [&] {
        if constexpr (is_given<W>)
          return weights[i][k];
        else
          return 0.0;
      });
      add(i, j, w);
    }
  }

  void add(std::size_t i, std::size_t j, double w) {
    require(i != j, "hmps: particle ", i, " is bonded to itself; leave that bond out");
    bonds_[i].push_back({static_cast<Index>(j), w});
  }

  /// Sorts the bonds and rejects repeated ones.
  void settle() {
    for (std::size_t i = 0; i < bonds_.size(); ++i) {
      auto& own = bonds_[i];
      std::sort(own.begin(), own.end(), [](const Bond& a, const Bond& b) { return a.neighbour < b.neighbour; });
      for (std::size_t k = 1; k < own.size(); ++k)
        require(own[k - 1].neighbour != own[k].neighbour, "hmps: the bond of particles ", i, " and ", own[k].neighbour,
                " is given twice; name each once", " (in lists of neighbours, once in the list of each end)");
    }
  }

  void require_both_ends() const {
    for (std::size_t i = 0; i < bonds_.size(); ++i)
      for (const Bond& bond : bonds_[i]) {
        const auto& other = bonds_[bond.neighbour];
        const auto back = std::lower_bound(other.begin(), other.end(), static_cast<Index>(i),
                                           [](const Bond& b, Index index) { return b.neighbour < index; });
        require(back != other.end() && back->neighbour == i, "hmps: particle ", i, " has the neighbour ",
                bond.neighbour, " but not the other way round; name each bond in the lists of both ends");
        require(back->weight == bond.weight, "hmps: the bond of particles ", i, " and ", bond.neighbour,
                " has the weight ", bond.weight, " from one end and ", back->weight,
                " from the other; both must be the same");
      }
  }

  template <class T, int D, class Visit>
  void for_each_length(const VectorView<T, D>& reference, Visit&& visit) const {
    for (std::size_t i = 0; i < bonds_.size(); ++i)
      for (const Bond& bond : bonds_[i]) {
        const double square =
            (reference[bond.neighbour].template cast<double>() - reference[i].template cast<double>()).squaredNorm();
        require(square > 0, "hmps: the bonded particles ", i, " and ", bond.neighbour,
                " lie at the same place; remove one of them");
        visit(i, square);
      }
  }

  std::vector<std::vector<Bond>> bonds_;
};

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
