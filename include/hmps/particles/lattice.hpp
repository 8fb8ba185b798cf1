// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/shapes/implicit.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// The sites of a simple cubic lattice in a box: `first[c] <= index < first[c] + count[c]`. Coordinates are computed in
/// double for every scalar type, so that the position of a site does not depend on the box.
template <int D>
struct LatticeSites {
  double spacing = 0;
  Vector<double, D> origin;
  Vector<std::int64_t, D> first;
  Vector<std::int64_t, D> count;

  [[nodiscard]] double coordinate(int axis, std::int64_t k) const {
    return origin[axis] + spacing * static_cast<double>(first[axis] + k);
  }
};

/// The largest number of sites to sample: 2^33, about ten minutes. More indicates that spacing and box are in different
/// units.
inline constexpr double most_sites = 8589934592.0;

/// The largest coordinate in m, in magnitude, that a lattice is computed from.
template <class S, int D>
[[nodiscard]] double largest_coordinate(const Box<S, D>& box, const Vector<S, D>& origin) {
  return static_cast<double>(
      std::max({box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff(), origin.cwiseAbs().maxCoeff()}));
}

/// Bound in m, with a margin, for how far rounding to `S` can shift a site relative to a face of `box`: corners, origin
/// and spacing are each off by at most half a unit in the last place.
template <class S, int D>
[[nodiscard]] double coordinate_rounding(const Box<S, D>& box, const Vector<S, D>& origin) {
  return 8 * static_cast<double>(std::numeric_limits<S>::epsilon()) * largest_coordinate<S, D>(box, origin);
}

/// The distance in m from the surface within which a site counts as lying on it.
template <class S, int D>
[[nodiscard]] double surface_tolerance(const Box<S, D>& box, double spacing, const Vector<S, D>& origin) {
  return std::max(1e-9 * spacing, coordinate_rounding<S, D>(box, origin));
}

/// The shift in m by which sites on the surface are moved to decide on which side they count; `reach` is the
/// `surface_tolerance` in m. It exceeds the rounding and differs in each direction, so that sites on faces such as x =
/// y fall on one side.
template <class S, int D>
[[nodiscard]] Vector<S, D> tie_shift(S reach) {
  constexpr S share[3] = {S(8), S(6.5), S(5.25)};
  Vector<S, D> shift;
  for (int c = 0; c < D; ++c) shift[c] = share[c] * reach;
  return shift;
}

/// Decides whether lattice sites lie inside a shape, with a rule for sites on its surface.
template <class F, class S, int D>
class InsideShape {
 public:
  static_assert(RequireDistance<F, Vector<S, D>>::value);
  InsideShape(const F& shape, const Box<S, D>& box, S spacing, const Vector<S, D>& origin)
      : shape_(shape),
        on_surface_(static_cast<S>(surface_tolerance<S, D>(box, static_cast<double>(spacing), origin))),
        tie_shift_(tie_shift<S, D>(on_surface_)) {}
  [[nodiscard]] bool operator()(const Vector<S, D>& x) const {
    const S distance = value(x);
    if (std::abs(distance) > on_surface_) return distance < S(0);
    return value(Vector<S, D>(x + tie_shift_)) < S(0);
  }

 private:
  [[nodiscard]] S value(const Vector<S, D>& x) const {
    const S distance = static_cast<S>(shape_(x));
    if (is_nan(distance))
      throw_input_error({"hmps: the shape is NaN at (", x,
                         "); it must have a value in the whole box: is a size negative or NaN, or a direction zero?"});
    return distance;
  }
  const F& shape_;
  S on_surface_;            ///< m
  Vector<S, D> tie_shift_;  ///< m
};

template <class S, int D>
[[nodiscard]] LatticeSites<D> lattice_sites(const Box<S, D>& box, S spacing, const Vector<S, D>& origin) {
  require(detail::is_finite(spacing) && spacing > S(0), "hmps: the lattice spacing is ", spacing,
          "; give a positive number of metres");
  require(detail::all_finite(origin), "hmps: the lattice origin is (", origin, "); coordinates must be finite");
  require(detail::all_finite(box.lower) && detail::all_finite(box.upper) && none_above<S, D>(box.lower, box.upper),
          "hmps: the box to fill reaches from (", box.lower, ") to (", box.upper,
          "); give finite corners in metres, the lower one first");
  LatticeSites<D> sites;
  sites.spacing = static_cast<double>(spacing);
  sites.origin = origin.template cast<double>();
  // A box that ends on a site should contain it, whichever way its coordinates were rounded.
  const double slack = std::clamp(coordinate_rounding<S, D>(box, origin) / sites.spacing, 1e-5, 8 * resolved_share);
  double product = 1;
  for (int c = 0; c < D; ++c) {
    const double low = std::ceil((static_cast<double>(box.lower[c]) - sites.origin[c]) / sites.spacing - slack);
    const double high = std::floor((static_cast<double>(box.upper[c]) - sites.origin[c]) / sites.spacing + slack);
    product *= std::max(high - low + 1, 0.0);
    require(
        is_finite(low) && is_finite(high) && std::max(std::abs(low), std::abs(high)) < 9e15 && product <= most_sites,
        "hmps: the box holds about ", product, " lattice sites of spacing ", spacing,
        " m or more; give box and spacing in metres, or a larger spacing");
    sites.first[c] = static_cast<std::int64_t>(low);
    sites.count[c] = static_cast<std::int64_t>(std::max(high - low + 1, 0.0));
  }
  require_resolution<S>(largest_coordinate<S, D>(box, origin), sites.spacing, resolved_share,
                        "the box to fill or the origin of its lattice lies");
  return sites;
}

/// Joins the points of all slabs; refuses more than `Index` can address.
template <class S, int D, Executor E>
[[nodiscard]] std::vector<Vector<S, D>> joined(std::vector<std::vector<Vector<S, D>>>& slabs, const E& execute) {
  std::vector<std::size_t> start(slabs.size() + 1, 0);
  for (std::size_t k = 0; k < slabs.size(); ++k) start[k + 1] = start[k] + slabs[k].size();
  require(start.back() < std::numeric_limits<Index>::max(), "hmps: the shape holds ", start.back(),
          " particles, more than a 32-bit index can address; give a larger spacing");
  std::vector<Vector<S, D>> points(start.back());
  guarded(execute)(slabs.size(), [&](std::size_t k) {
    std::copy(slabs[k].begin(), slabs[k].end(), points.begin() + static_cast<std::ptrdiff_t>(start[k]));
    std::vector<Vector<S, D>>().swap(slabs[k]);
  });
  return points;
}

}  // namespace detail

/// Fills a shape with particles on a simple cubic (2D: square) lattice, as in section 3.1 of the paper: returns the
/// sites origin + spacing (i, j, k), i, j, k integers, that lie in `box` and inside `shape` (shape(x) < 0). The last
/// coordinate runs fastest, so that rows along z are contiguous. Every site of the box is sampled once. Slabs of
/// constant x run through `execute`; the result does not depend on it.
///
/// Sites on the surface, up to rounding, count as inside on its lower sides: where the distance is below 1e-9 spacings,
/// or a few units in the last place of the coordinates, the shape is evaluated slightly further along x, y and z. A box
/// of n spacings therefore holds n sites per direction whatever the origin, also in float where that resolves the
/// spacing, and adjacent shapes have no gap. But a ball centred on a site, with a radius of a whole number of spacings,
/// is then not symmetric, and its centre of mass lies beside that of the shape: put its centre between sites, or choose
/// another radius. A shape that only tells inside from outside, without a distance, decides for itself where its
/// surface belongs.
///
/// `spacing` in metres; faces of the box need not lie on sites. Throws `InputError` for a spacing that is not positive,
/// a box that is empty or not finite, more than 2^33 sites, 2^32 or more points, a shape that returns NaN, with the
/// position, and where rounding to `S` exceeds a hundredth of the spacing, as in float at 100 m with 1 mm.
template <class F, class S, int D, Executor E = Serial>
requires Shape<F, S, D>
[[nodiscard]] std::vector<Vector<S, D>> fill_lattice(
    const F& shape, const Box<S, D>& box, std::type_identity_t<S> spacing,
    const std::type_identity_t<Vector<S, D>>& origin = Vector<S, D>::Zero(), const E& execute = {}) {
  static_assert(D == 2 || D == 3, "hmps: lattices have 2 or 3 dimensions");
  const auto sites = detail::lattice_sites<S, D>(box, spacing, origin);
  const detail::InsideShape<F, S, D> inside(shape, box, spacing, origin);
  std::vector<std::vector<Vector<S, D>>> slabs(static_cast<std::size_t>(sites.count[0]));
  detail::guarded(execute)(slabs.size(), [&](std::size_t slab) {
    std::vector<Vector<S, D>> found;
    Vector<S, D> x;
    x[0] = static_cast<S>(sites.coordinate(0, static_cast<std::int64_t>(slab)));
    const auto row = [&] {
      for (std::int64_t k = 0; k < sites.count[D - 1]; ++k) {
        x[D - 1] = static_cast<S>(sites.coordinate(D - 1, k));
        if (inside(x)) found.push_back(x);
      }
    };
    if constexpr (D == 3) {
      for (std::int64_t j = 0; j < sites.count[1]; ++j) {
        x[1] = static_cast<S>(sites.coordinate(1, j));
        row();
      }
    } else {
      row();
    }
    slabs[slab] = std::move(found);
  });
  return detail::joined<S, D>(slabs, execute);
}

/// The same for a box: `fill_lattice(box, l0)`.
template <class S, int D, Executor E = Serial>
[[nodiscard]] std::vector<Vector<S, D>> fill_lattice(
    const Box<S, D>& box, std::type_identity_t<S> spacing,
    const std::type_identity_t<Vector<S, D>>& origin = Vector<S, D>::Zero(), const E& execute = {}) {
  return fill_lattice(box, box, spacing, origin, execute);
}

}  // namespace hmps::inline HMPS_ABI
