// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nanoflann.hpp>
#include <span>
#include <type_traits>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// The neighbours of every particle in one array: those of particle `i`, sorted by index, are `neighbour[offset[i]]` up
/// to `neighbour[offset[i + 1] - 1]`. Particle `i` is not among its own neighbours.
struct NeighbourList {
  std::vector<std::size_t> offset{0};
  std::vector<Index> neighbour;

  /// The number of particles; 0 after a move.
  [[nodiscard]] std::size_t size() const { return offset.empty() ? 0 : offset.size() - 1; }
  /// The neighbours of particle `i`. Throws `InputError` for a particle that does not exist.
  [[nodiscard]] std::span<const Index> operator[](std::size_t i) const {
    detail::require_index(i, size(), "particle", "the list of neighbours has");
    return {neighbour.data() + offset[i], offset[i + 1] - offset[i]};
  }
};

namespace detail {

/// Adapts a view of positions to nanoflann's dataset concept.
template <class T, int D>
struct PointSet {
  using Scalar = typename VectorView<T, D>::Scalar;
  VectorView<T, D> points;

  [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
  [[nodiscard]] Scalar kdtree_get_pt(std::size_t i, std::size_t component) const {
    return points(i, static_cast<int>(component));
  }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

/// Collects the indices within a closed ball. nanoflann's own result sets use an open ball and store distances that are
/// not needed here.
template <class S>
class WithinRadius {
 public:
  // Versions of nanoflann after 1.4 require these, and `sort`.
  using DistanceType = S;
  using IndexType = Index;
  WithinRadius(S squared_radius, std::vector<Index>& found) : squared_radius_(squared_radius), found_(found) {}
  [[nodiscard]] bool addPoint(S squared_distance, Index index) {
    if (squared_distance <= squared_radius_) found_.push_back(index);
    return true;
  }
  /// Slightly more than the squared radius: nanoflann skips points at exactly this distance, and whole branches by
  /// bounds that carry rounding errors.
  [[nodiscard]] S worstDist() const {
    return squared_radius_ * (1 + 16 * std::numeric_limits<S>::epsilon()) + std::numeric_limits<S>::min();
  }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] bool empty() const { return found_.empty(); }
  [[nodiscard]] std::size_t size() const { return found_.size(); }
  void sort() {}  ///< `FixedRadiusSearch` sorts by index instead

 private:
  S squared_radius_;
  std::vector<Index>& found_;
};

/// Counts the points within a closed ball without storing them.
template <class S>
class CountWithin {
 public:
  using DistanceType = S;
  using IndexType = Index;
  explicit CountWithin(S squared_radius) : within_(squared_radius, none_), squared_radius_(squared_radius) {}
  [[nodiscard]] bool addPoint(S squared_distance, Index) {
    count_ += squared_distance <= squared_radius_ ? 1 : 0;
    return true;
  }
  [[nodiscard]] S worstDist() const { return within_.worstDist(); }
  [[nodiscard]] bool full() const { return true; }
  [[nodiscard]] bool empty() const { return count_ == 0; }
  [[nodiscard]] std::size_t size() const { return count_; }
  void sort() {}

 private:
  std::vector<Index> none_;
  WithinRadius<S> within_;
  S squared_radius_;
  std::size_t count_ = 0;
};

}  // namespace detail

/// Fixed-radius search in a k-d tree (nanoflann) over the user's positions. The positions must outlive the search and
/// must not change while it is in use.
template <class T, int D>
class FixedRadiusSearch {
  using Points = detail::PointSet<T, D>;
  using Scalar = typename Points::Scalar;
  // The memory of nanoflann is not aligned for long double.
  static_assert(std::is_same_v<Scalar, float> || std::is_same_v<Scalar, double>,
                "hmps: positions are views of float or double");
  using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<Scalar, Points>, Points, D, Index>;

 public:
  /// Builds the tree over `points` (m). Throws `InputError` for a position that is not finite.
  explicit FixedRadiusSearch(const VectorView<T, D>& points) : points_{points}, tree_(D, checked(points_)) {}
  FixedRadiusSearch(const FixedRadiusSearch&) = delete;
  FixedRadiusSearch& operator=(const FixedRadiusSearch&) = delete;

  /// Writes to `found` the particles within `radius` (m, closed ball) of `centre`, sorted by index. Thread-safe.
  /// Throws `InputError` for a radius that is negative or NaN, and a centre that is not finite.
  void operator()(const Vector<Scalar, D>& centre, Scalar radius, std::vector<Index>& found) const {
    require_ball(centre, radius);
    found.clear();
    if (points_.points.size() == 0) return;
    detail::WithinRadius<Scalar> within(radius * radius, found);
    tree_.findNeighbors(within, centre.data(), {});
    std::sort(found.begin(), found.end());
  }

  /// The number of particles within `radius` (m) of `centre`. Allocates no memory.
  [[nodiscard]] std::size_t count(const Vector<Scalar, D>& centre, Scalar radius) const {
    require_ball(centre, radius);
    detail::CountWithin<Scalar> within(radius * radius);
    if (points_.points.size() > 0) tree_.findNeighbors(within, centre.data(), {});
    return within.size();
  }

  /// Distance (m) from `particle` to its nearest neighbour; infinite if there is none. Throws `InputError` for a
  /// particle that does not exist.
  [[nodiscard]] Scalar nearest(std::size_t particle) const {
    detail::require_index(particle, points_.points.size(), "particle", "the search has");
    if (points_.points.size() < 2) return std::numeric_limits<Scalar>::infinity();
    Index index[2];
    Scalar squared[2];
    nanoflann::KNNResultSet<Scalar, Index> two(2);  // one of them is the particle itself
    two.init(index, squared);
    tree_.findNeighbors(two, points_.points[particle].eval().data(), {});
    return std::sqrt(squared[1]);
  }

  [[nodiscard]] const VectorView<T, D>& points() const { return points_.points; }

 private:
  static void require_ball(const Vector<Scalar, D>& centre, Scalar radius) {
    detail::require(!detail::is_nan(radius) && radius >= 0, "hmps: the search radius is ", radius,
                    " m; it must not be negative");
    detail::require(detail::all_finite(centre), "hmps: a search is centred at (", centre,
                    "); coordinates must be finite");
  }
  static const Points& checked(const Points& set) {
    require_finite(set.points, "the position");
    return set;
  }
  Points points_;
  Tree tree_;
};

namespace detail {
/// Throws `InputError` for a `radius` (m) so large that lists of neighbours would fill the memory, as it may be in
/// another unit: with at least 4000 neighbours per particle, as many as within ten spacings, and at least 1e8 in all.
template <class Search, class S>
void require_listable(const Search& search, S radius) {
  constexpr std::size_t most_samples = 64;
  const std::size_t n = search.points().size(), samples = std::min(n, most_samples);
  double sum = 0;
  for (std::size_t k = 0; k < samples; ++k)
    sum += static_cast<double>(search.count(search.points()[k * n / samples], radius)) - 1;
  const double mean = samples > 0 ? sum / static_cast<double>(samples) : 0;
  require(mean < 4000 || mean * static_cast<double>(n) < 1e8, "hmps: within the search radius of ", radius,
          " m, a particle has ", mean, " neighbours on average, and all ", n, " particles have ",
          mean * static_cast<double>(n), "; give a radius of a few spacings, in the unit of the positions");
}
}  // namespace detail

/// Finds all neighbours within `radius` (m, closed ball) of every particle of `search`. The lists are symmetric: each
/// distance is measured once, from the lower index. Throws `InputError` if the radius is not positive or so large that
/// the lists would fill the memory, and if particles coincide.
template <class T, int D, Executor E = Serial>
[[nodiscard]] NeighbourList find_neighbours(const FixedRadiusSearch<T, D>& search,
                                            typename VectorView<T, D>::Scalar radius, const E& execute = {}) {
  detail::require(detail::is_finite(radius) && radius > 0, "hmps: the search radius is ", radius,
                  "; it must be a positive number of metres");
  const VectorView<T, D>& points = search.points();
  const std::size_t n = points.size();
  detail::require_listable(search, radius);
  std::vector<std::vector<Index>> above(n);
  detail::guarded(execute)(n, [&](std::size_t i) {
    std::vector<Index>& found = above[i];
    search(points[i], radius, found);
    std::erase_if(found, [i](Index j) { return j <= i; });
    for (Index j : found)
      detail::require((points[j] - points[i]).squaredNorm() > 0, "hmps: particles ", i, " and ", j,
                      " lie at the same place; remove one of them");
  });
  NeighbourList list;
  list.offset.assign(n + 1, 0);
  for (std::size_t i = 0; i < n; ++i) {
    list.offset[i + 1] += above[i].size();
    for (Index j : above[i]) ++list.offset[j + 1];
  }
  for (std::size_t i = 0; i < n; ++i) list.offset[i + 1] += list.offset[i];
  list.neighbour.resize(list.offset[n]);
  // Visiting the lower index in ascending order keeps every list sorted: lower indices come first.
  std::vector<std::size_t> next(list.offset.begin(), list.offset.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    for (Index j : above[i]) list.neighbour[next[j]++] = static_cast<Index>(i);
  for (std::size_t i = 0; i < n; ++i)
    for (Index j : above[i]) list.neighbour[next[i]++] = j;
  return list;
}

/// The same for every particle of `points`. Also throws `InputError` if a position is not finite.
template <class T, int D, Executor E = Serial>
[[nodiscard]] NeighbourList find_neighbours(const VectorView<T, D>& points, typename VectorView<T, D>::Scalar radius,
                                            const E& execute = {}) {
  return find_neighbours(FixedRadiusSearch<T, D>(points), radius, execute);
}

}  // namespace hmps::inline HMPS_ABI
