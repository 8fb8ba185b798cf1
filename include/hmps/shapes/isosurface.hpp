// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/types.hpp"
#include "hmps/search/detail/resolution.hpp"
#include "hmps/shapes/implicit.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// Makes the zero surface of a shape, from one layer of cubes to the next. Each cube is divided into six tetrahedra
/// around its diagonal (Kuhn 1960). In a tetrahedron, the set of corners that lie inside determines the triangles.
template <class F, class S>
class IsosurfaceMaker {
 public:
  using Point = Vector<S, 3>;
  static_assert(RequireDistance<F, Point>::value);

  IsosurfaceMaker(const F& shape, const Box<S, 3>& box, S cell) : shape_(shape), box_(box), cell_(cell) {
    require(all_finite(box.lower) && all_finite(box.upper) && (box.lower.array() < box.upper.array()).all(),
            "hmps: the box of an isosurface reaches from (", box.lower, ") to (", box.upper,
            "); give an upper corner above the lower one");
    require(is_finite(cell) && cell > 0, "hmps: the cells of an isosurface are ", cell,
            " m wide; give a positive width");
    for (int c = 0; c < 3; ++c) {
      const double cells = std::ceil(static_cast<double>((box.upper[c] - box.lower[c]) / cell)) + 1;
      require(cells < most_cells, "hmps: ", cells, " cells of ", cell,
              " m along an axis of an isosurface are too many; give wider cells, or a box in metres");
      nodes_[static_cast<std::size_t>(c)] = static_cast<std::size_t>(cells) + 1;
    }
    require_resolution<S>(static_cast<double>(box.lower.cwiseAbs().cwiseMax(box.upper.cwiseAbs()).maxCoeff()),
                          static_cast<double>(cell), resolved_share, "a corner of the box of an isosurface lies");
    const std::size_t plane = nodes_[0] * nodes_[1];
    below_.resize(plane), above_.resize(plane);
    for (Edges* edges : {&lower_, &upper_}) edges->assign(edge_kinds * plane, no_index);
  }

  template <class E>
  [[nodiscard]] SurfaceMesh<S> operator()(const E& execute) {
    evaluate(0, above_, execute);
    for (std::size_t k = 0; k + 1 < nodes_[2]; ++k) {
      std::swap(below_, above_);
      evaluate(k + 1, above_, execute);
      for (std::size_t j = 0; j + 1 < nodes_[1]; ++j)
        for (std::size_t i = 0; i + 1 < nodes_[0]; ++i) cut_cube({i, j, k});
      place_vertices(execute);
      std::swap(lower_, upper_);
      upper_.assign(upper_.size(), no_index);
    }
    require(!mesh_.triangles.empty(), "hmps: the shape has no surface in the box from (", box_.lower, ") to (",
            box_.upper, ") that cells of ", cell_,
            " m resolve; give a shape that is negative inside, a box around it in metres, or smaller cells");
    mesh_.source = "the isosurface";
    return std::move(mesh_);
  }

 private:
  using Node = std::array<std::size_t, 3>;
  using Edges = std::vector<Index>;
  static constexpr std::size_t edge_kinds = 7;  // the axes, and the diagonals of faces and of the cube
  static constexpr double most_cells = 5000;    // along an axis: a plane of them takes 1.6 GB

  /// The outermost nodes lie half a cell or more outside the box, so that its faces close the surface.
  [[nodiscard]] Point place(const Node& node) const {
    Point x;
    for (int c = 0; c < 3; ++c)
      x[c] = box_.lower[c] + (static_cast<S>(node[static_cast<std::size_t>(c)]) - S(0.5)) * cell_;
    return x;
  }
  /// Throws `InputError` where the shape is NaN.
  [[nodiscard]] S value(const Point& x) const {
    const S d = static_cast<S>(shape_(x));
    if (is_nan(d)) throw_input_error({"hmps: the shape is NaN at (", x, "); it must have a value in the whole box"});
    return std::max(d, box_(x));
  }
  [[nodiscard]] std::size_t in_plane(const Node& node) const { return node[1] * nodes_[0] + node[0]; }

  template <class E>
  void evaluate(std::size_t k, std::vector<S>& plane, const E& execute) {
    guarded(execute)(nodes_[1], [&](std::size_t j) {
      for (std::size_t i = 0; i < nodes_[0]; ++i) plane[j * nodes_[0] + i] = value(place({i, j, k}));
    });
  }

  void cut_cube(const Node& corner) {
    const auto at = [&](std::size_t bits) {
      const Node node{corner[0] + (bits & 1), corner[1] + (bits >> 1 & 1), corner[2] + (bits >> 2)};
      return (bits >> 2 ? above_ : below_)[in_plane(node)];
    };
    std::size_t inside = 0;
    for (std::size_t bits = 0; bits < 8; ++bits) inside |= static_cast<std::size_t>(at(bits) < 0) << bits;
    if (inside == 0 || inside == 0xff) return;
    // From corner 0 along the axes in every order to corner 7; every second order makes a left-handed tetrahedron.
    constexpr std::array<std::array<std::size_t, 4>, 6> tetrahedra{
        {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
    for (const auto& corners : tetrahedra) cut_tetrahedron(corner, corners, inside);
  }

  void cut_tetrahedron(const Node& cube, std::array<std::size_t, 4> corners, std::size_t inside) {
    // Moves the corners inside to the front by swaps of neighbours, each of which turns the tetrahedron inside out.
    bool reversed = false;
    int count = 0;
    for (const std::size_t c : corners) count += static_cast<int>(inside >> c & 1);
    for (std::size_t pass = 0; pass < 3; ++pass)
      for (std::size_t k = 0; k < 3; ++k)
        if ((inside >> corners[k] & 1) < (inside >> corners[k + 1] & 1)) {
          std::swap(corners[k], corners[k + 1]);
          reversed = !reversed;
        }
    const auto [a, b, c, d] = corners;
    const auto edge = [&](std::size_t from, std::size_t to) { return vertex(cube, from, to); };
    const auto add = [&](Index first, Index second, Index third) {
      if (reversed) std::swap(second, third);
      mesh_.triangles.push_back({first, second, third});
    };
    if (count == 1) add(edge(a, b), edge(a, c), edge(a, d));
    if (count == 2) {
      add(edge(a, c), edge(a, d), edge(b, d));
      add(edge(a, c), edge(b, d), edge(b, c));
    }
    if (count == 3) add(edge(a, d), edge(b, d), edge(c, d));
  }

  /// The vertex on the edge between two corners of a cube. One corner must have all bits of the other.
  [[nodiscard]] Index vertex(const Node& cube, std::size_t one, std::size_t other) {
    const std::size_t from = one & other, kind = (one | other) - from;
    const Node node{cube[0] + (from & 1), cube[1] + (from >> 1 & 1), cube[2] + (from >> 2)};
    Index& known = (from >> 2 ? upper_ : lower_)[edge_kinds * in_plane(node) + kind - 1];
    if (known == no_index) {
      require(mesh_.vertices.size() + cut_.size() < no_index, "hmps: the isosurface has more vertices than a 32-bit ",
              "index can address; give wider cells");
      known = static_cast<Index>(mesh_.vertices.size() + cut_.size());
      const Node end{node[0] + (kind & 1), node[1] + (kind >> 1 & 1), node[2] + (kind >> 2)};
      cut_.emplace_back(place(node), place(end));
    }
    return known;
  }

  /// Places the vertices of a layer of cubes where the shape is zero, by bisection.
  template <class E>
  void place_vertices(const E& execute) {
    constexpr int halvings = 12;
    const std::size_t first = mesh_.vertices.size();
    mesh_.vertices.resize(first + cut_.size());
    guarded(execute)(cut_.size(), [&](std::size_t k) {
      auto [inside, outside] = cut_[k];
      if (!(value(inside) < 0)) std::swap(inside, outside);
      for (int halving = 0; halving < halvings; ++halving) {
        const Point middle = (inside + outside) / 2;
        (value(middle) < 0 ? inside : outside) = middle;
      }
      mesh_.vertices[first + k] = (inside + outside) / 2;
    });
    cut_.clear();
  }

  const F& shape_;
  Box<S, 3> box_;
  S cell_;
  Node nodes_{};
  std::vector<S> below_, above_;  // the values in the planes of nodes
  Edges lower_, upper_;           // the vertices on the edges that start there
  std::vector<std::pair<Point, Point>> cut_;
  SurfaceMesh<S> mesh_;
};

}  // namespace detail

/// The closed surface of the part of a shape that lies in a box, by marching tetrahedra (Doi and Koide 1991).
///
/// Only the sign of the shape counts, so that the surface turns any implicit function, united shapes, and shapes whose
/// distance is expensive into a distance:
///
///     const MeshDistance<double> body(isosurface(shape, box, l0 / 4));
///     const auto fitted = fit_particles(body, body.box(), l0);
///
/// Vertices lie on the surface of the shape to a four-thousandth of a cell. Between them the isosurface is flat:
/// right-angled edges are bevelled by 0.17 cells on average and 0.6 at most, corners by 0.7 at most, and a ball of
/// radius R is cut short by 0.08 cell^2 / R on average and 0.4 at most. Parts thinner than a cell may be missed. A
/// patch that ends at such an edge loses area, and a pressure on it as much of its force: the bore of a tube, 10 mm in
/// radius and 12 mm long, 4, 3 and 1.4 % with cells of 1.25, 0.63 and 0.31 mm.
///
/// The result is deterministic and does not depend on the executor.
///
/// @param shape  negative inside; called from several threads if `execute` has them
/// @param box    in m; its faces cut the shape, and close the surface there
/// @param cell   width of the cells in m
/// Throws `InputError` for a box without volume, a width that is not positive or that rounding to `S` does not resolve
/// to a hundredth, more than 5000 cells along an axis, a shape that is NaN (with the position), and a shape without
/// surface in the box.
template <class F, class S, Executor E = Serial>
requires Shape<F, S, 3>
[[nodiscard]] SurfaceMesh<S> isosurface(const F& shape, const Box<S, 3>& box, std::type_identity_t<S> cell,
                                        const E& execute = {}) {
  return detail::IsosurfaceMaker<F, S>(shape, box, cell)(execute);
}

}  // namespace hmps::inline HMPS_ABI
