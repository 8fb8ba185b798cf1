// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/detail/nearest_on_triangle.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

/// A bounding-volume tree over the triangles of a surface, for winding numbers and distances in time logarithmic in the
/// number of triangles. The winding number (Jacobson et al. 2013) is 1 inside a closed surface, 0 outside, and changes
/// gradually across the holes of an open one. A group of triangles further from the point than `accuracy` radii of the
/// group is replaced by a dipole and its first two moments (Barill et al. 2018). Stores a copy of the triangles in `S`.
/// Thread-safe.
template <std::same_as<double> S>
class BasicTriangleTree {
  using V = Vector<S, 3>;

 public:
  /// @param accuracy  above 1; at infinity nothing is approximated
  /// Throws `InputError` for a surface without triangles, vertices that are not finite, indices out of range.
  template <class T>
  explicit BasicTriangleTree(const SurfaceMesh<T>& mesh, double accuracy = 2) : accuracy_(static_cast<S>(accuracy)) {
    detail::require(!detail::is_nan(accuracy) && accuracy > 1, "hmps: the accuracy of a tree of triangles is ",
                    accuracy, "; give a number above 1 (2 is the default)");
    detail::require_triangles(mesh);
    for (const auto& t : mesh.triangles)
      triangles_.push_back({mesh.vertices[t[0]].template cast<S>(), mesh.vertices[t[1]].template cast<S>(),
                            mesh.vertices[t[2]].template cast<S>()});
    order_.resize(triangles_.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    build(0, order_.size());
    Corners sorted;
    sorted.reserve(triangles_.size());
    for (const std::size_t k : order_) sorted.push_back(triangles_[k]);
    triangles_ = std::move(sorted);
  }

  /// The winding number of the surface around `x` (m): the sum of solid angles over 4 pi. Discontinuous on the surface.
  [[nodiscard]] S winding_number(const V& x) const {
    S angle = 0;
    visit([&](const Node& node) {
      const V to = node.centre - x;
      const S squared = to.squaredNorm();
      if (squared > accuracy_ * accuracy_ * node.squared_radius) {
        angle += node.far_angle(to, squared);
        return false;
      }
      if (node.right == 0)
        for (std::size_t k = node.begin; k < node.end; ++k)
          angle += detail::solid_angle<double>(triangles_[k][0] - x, triangles_[k][1] - x, triangles_[k][2] - x);
      return true;
    });
    return angle / (4 * std::numbers::pi_v<S>);
  }

  /// The distance in m from `x` (m) to the nearest triangle, exact up to rounding.
  [[nodiscard]] S distance(const V& x) const { return std::sqrt(search(x).squared); }

  /// The point of the surface that is nearest to `x` (m).
  struct Nearest {
    S distance;                      ///< in m
    std::size_t triangle;            ///< of the mesh
    detail::TrianglePoint<S> point;  ///< on it
  };
  [[nodiscard]] Nearest nearest(const V& x) const {
    const Found found = search(x);
    return {std::sqrt(found.squared), order_[found.at], detail::nearest_on_triangle(triangles_[found.at], x)};
  }

  [[nodiscard]] std::size_t size() const { return triangles_.size(); }

 private:
  struct Found {
    S squared;  // distance in m2
    std::size_t at;
  };
  [[nodiscard]] Found search(const V& x) const {
    Found least{std::numeric_limits<S>::infinity(), 0};
    // Visits the nearer child first and tests the other one again later.
    std::array<std::pair<S, std::size_t>, depth> waiting;
    std::size_t count = 0;
    waiting[count++] = {nodes_[0].squared_distance(x), 0};
    while (count > 0) {
      const auto [bound, at] = waiting[--count];
      if (bound >= least.squared) continue;
      const Node& node = nodes_[at];
      if (node.right == 0) {
        for (std::size_t k = node.begin; k < node.end; ++k)
          if (const S d = (detail::nearest_on_triangle(triangles_[k], x).place - x).squaredNorm(); d < least.squared)
            least = {d, k};
        continue;
      }
      std::pair left(nodes_[at + 1].squared_distance(x), at + 1);
      std::pair right(nodes_[node.right].squared_distance(x), node.right);
      if (left < right) std::swap(left, right);
      waiting[count++] = left;
      waiting[count++] = right;
    }
    return least;
  }

  using Corners = std::vector<std::array<V, 3>>;
  /// Halving 2^32 triangles gives 32 levels, each of which leaves one node on the stack.
  static constexpr std::size_t depth = 72;
  static constexpr std::size_t leaf = 4;

  /// The group of triangles of a node. Its solid angle at a distance is computed from its moments about the centre: the
  /// surface integral of area vector . g(centre - x + d) with g(r) = r / |r|^3, expanded to second order in d.
  struct Node {
    V lower, upper;          ///< box of the triangles in m
    std::size_t begin, end;  ///< the triangles
    std::size_t right = 0;   ///< second child; the first one follows the node; 0 for a leaf
    V centre;                ///< mean of the triangles' centres weighted by area in m
    V area;                  ///< sum of the triangles' area vectors in m2
    Matrix<S, 3> moment;     ///< sum of area vector (x) (centre of the triangle - centre) in m3
    S squared_radius;        ///< of the triangles' corners about the centre in m2

    std::array<S, 10> cubic;  ///< sum of n_i d_j d_k in m4: xxx, yyy, zzz, xxy, xxz, xyy, yyz, xzz, yzz, xyz
    V traces;                 ///< sum of n (d . d) + 2 d (n . d) in m4

    /// The solid angle seen from a point; `r` is the vector in m from the point to the centre.
    [[nodiscard]] S far_angle(const V& r, S squared) const {
      const S x = r[0], y = r[1], z = r[2];
      const auto& c = cubic;
      const S third = x * (x * (c[0] * x + c[3] * y + c[4] * z) + y * (c[5] * y + c[9] * z) + c[7] * z * z) +
                      y * (y * (c[1] * y + c[6] * z) + c[8] * z * z) + c[2] * z * z * z;
      const S cubed = squared * std::sqrt(squared);
      return (r.dot(area) + moment.trace() - 3 * r.dot(moment * r) / squared +
              (S(7.5) * third / squared - S(1.5) * r.dot(traces)) / squared) /
             cubed;
    }
    [[nodiscard]] S squared_distance(const V& x) const {
      return (lower - x).cwiseMax(x - upper).cwiseMax(S(0)).squaredNorm();
    }
  };

  /// Calls `enter(node)` from the root on, and descends where it returns true.
  template <class Enter>
  void visit(Enter&& enter) const {
    std::array<std::size_t, depth> waiting;
    std::size_t count = 0;
    waiting[count++] = 0;
    while (count > 0) {
      const std::size_t at = waiting[--count];
      const Node& node = nodes_[at];
      if (!enter(node) || node.right == 0) continue;
      waiting[count++] = node.right;
      waiting[count++] = at + 1;
    }
  }

  [[nodiscard]] static V centre_of(const std::array<V, 3>& t) { return (t[0] + t[1] + t[2]) / 3; }

  /// A node without children for the triangles `order_[begin, end)`.
  [[nodiscard]] Node summed(std::size_t begin, std::size_t end) const {
    Node node{};
    node.begin = begin;
    node.end = end;
    node.lower = node.upper = triangles_[order_[begin]][0];
    V weighted = V::Zero();
    S total = 0;
    node.area.setZero();
    for (std::size_t k = begin; k < end; ++k) {
      const auto& t = triangles_[order_[k]];
      for (const V& corner : t) {
        node.lower = node.lower.cwiseMin(corner);
        node.upper = node.upper.cwiseMax(corner);
      }
      const V area = area_vector(t[0], t[1], t[2]);
      node.area += area;
      weighted += area.norm() * centre_of(t);
      total += area.norm();
    }
    node.centre = total > 0 ? V(weighted / total) : V((node.lower + node.upper) / 2);
    node.moment.setZero();
    node.traces.setZero();
    std::array<Matrix<S, 3>, 3> second{Matrix<S, 3>::Zero(), Matrix<S, 3>::Zero(), Matrix<S, 3>::Zero()};
    node.squared_radius = 0;
    for (std::size_t k = begin; k < end; ++k) {
      const auto& t = triangles_[order_[k]];
      const V area = area_vector(t[0], t[1], t[2]);
      const V sum = 3 * (centre_of(t) - node.centre);
      node.moment += area * sum.transpose() / 3;
      // The mean of d d^T over a triangle, from its corners.
      Matrix<S, 3> mean = sum * sum.transpose() / 12;
      for (const V& corner : t) mean += (corner - node.centre) * (corner - node.centre).transpose() / 12;
      node.traces += area * mean.trace() + 2 * mean * area;
      for (std::size_t i = 0; i < 3; ++i) second[i] += area[static_cast<Eigen::Index>(i)] * mean;
      for (const V& corner : t)
        node.squared_radius = std::max(node.squared_radius, (corner - node.centre).squaredNorm());
    }
    const auto& [X, Y, Z] = second;
    node.cubic = {X(0, 0),
                  Y(1, 1),
                  Z(2, 2),
                  Y(0, 0) + 2 * X(0, 1),
                  Z(0, 0) + 2 * X(0, 2),
                  X(1, 1) + 2 * Y(0, 1),
                  Z(1, 1) + 2 * Y(1, 2),
                  X(2, 2) + 2 * Z(0, 2),
                  Y(2, 2) + 2 * Z(1, 2),
                  2 * (X(1, 2) + Y(0, 2) + Z(0, 1))};
    return node;
  }

  void build(std::size_t begin, std::size_t end) {
    const auto first = order_.begin() + static_cast<std::ptrdiff_t>(begin);
    const auto last = order_.begin() + static_cast<std::ptrdiff_t>(end);
    // The split must not depend on the standard library, since sums depend on it.
    std::sort(first, last);
    const std::size_t at = nodes_.size();
    nodes_.push_back(summed(begin, end));
    if (end - begin <= leaf) return;
    Eigen::Index axis = 0;
    (nodes_[at].upper - nodes_[at].lower).maxCoeff(&axis);
    const std::size_t middle = (begin + end) / 2;
    std::nth_element(
        first, order_.begin() + static_cast<std::ptrdiff_t>(middle), last, [&](std::size_t a, std::size_t b) {
          return std::pair(centre_of(triangles_[a])[axis], a) < std::pair(centre_of(triangles_[b])[axis], b);
        });
    build(begin, middle);
    nodes_[at].right = nodes_.size();
    build(middle, end);
  }

  S accuracy_;
  Corners triangles_;
  std::vector<std::size_t> order_;  // the triangles of the mesh
  std::vector<Node> nodes_;
};

/// In double only. It is a template so that programs that do not use a tree do not compile one.
using TriangleTree = BasicTriangleTree<double>;

}  // namespace hmps::inline HMPS_ABI
