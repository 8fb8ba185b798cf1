// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/output/vtk_field.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The spacing in m of the lattice that holds `count` points in a box of the edges `extent` (m), of which some may be
/// zero but not all; `count` of at least two.
template <int D>
[[nodiscard]] double lattice_spacing(const Vector<double, D>& extent, double count) {
  double low = extent.maxCoeff() / count, high = 4 * extent.maxCoeff();  // more than `count` points, and fewer than two
  for (int halving = 0; halving < 60; ++halving) {
    const double middle = low + (high - low) / 2;
    ((extent.array() / middle + 1).prod() > count ? low : high) = middle;
  }
  return high;
}

/// An estimate in m of the spacing of points, in time linear in their number; infinite where all points coincide. A
/// list of particles mostly goes from neighbour to neighbour, which counts where several bodies are apart; the box
/// counts where it does not.
template <class T, int D>
[[nodiscard]] double typical_spacing(const VectorView<T, D>& x) {
  std::vector<double> ways;
  if (x.size() == 0) return std::numeric_limits<double>::infinity();
  Vector<double, D> low = x[0].template cast<double>(), high = low;
  for (std::size_t i = 1; i < x.size(); ++i) {
    const Vector<double, D> place = x[i].template cast<double>();
    const double way = (place - x[i - 1].template cast<double>()).cwiseAbs().maxCoeff();
    if (way > 0) ways.push_back(way);
    low = low.cwiseMin(place);
    high = high.cwiseMax(place);
  }
  if (ways.empty()) return std::numeric_limits<double>::infinity();
  const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
  std::nth_element(ways.begin(), middle, ways.end());
  return std::min(*middle, lattice_spacing<D>(high - low, static_cast<double>(x.size())));
}

/// Whether single precision shifts some of the points `x` (m) by more than 1e-4 of their spacing.
template <class T, int D>
[[nodiscard]] bool needs_double(const VectorView<T, D>& x) {
  double largest = 0;
  for (std::size_t i = 0; i < x.size(); ++i)
    for (int c = 0; c < D; ++c) largest = std::max(largest, std::abs(static_cast<double>(x(i, c))));
  using Single = std::numeric_limits<float>;
  constexpr auto most = static_cast<double>(Single::max()), rounding = static_cast<double>(Single::epsilon()),
                 finest = static_cast<double>(Single::denorm_min());
  return largest > most || std::max(largest * rounding, finest) / 2 > 1e-4 * typical_spacing(x);
}

}  // namespace detail

/// Positions (m), or the vertices of a surface, as a field called `name` for `vtu_text`: in single precision, unless
/// `x` is in double and rounding would shift a point by more than about 1e-4 of the typical spacing, as it does with
/// 0.02 mm at 1 m from the origin. Throws `InputError` for a view of null. All positions must be finite.
template <class T, int D>
[[nodiscard]] VtkField position_field(std::string name, const VectorView<T, D>& x) {
  require_view(x, name.c_str());
  if constexpr (!std::is_same_v<std::remove_const_t<T>, float>)
    if (detail::needs_double(x)) return vtk_field<double>(std::move(name), x);
  return vtk_field(std::move(name), x);
}

}  // namespace hmps::inline HMPS_ABI
