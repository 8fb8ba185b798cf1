// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <hmps/particles/lattice.hpp>
#include <hmps/particles/support.hpp>
#include <hmps/particles/thicken.hpp>
#include <hmps/search/fixed_radius.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "scene/fitted_organs.hpp"
#include "scene/scene.hpp"

namespace swallowing {

namespace detail {

/// The particles of the body with their bonds, while the scene is being built.
struct Body {
  std::vector<Point> points;  ///< m
  std::vector<Organ> organ;
  std::vector<char> depth;             ///< 0: beside air, 1: next to such a particle, 2: others
  std::vector<int> layers;             ///< through the wall at each particle, 0 in bulk; empty on a lattice
  std::vector<double> layer_spacings;  ///< distance of the layers in m; empty on a lattice
  std::vector<std::vector<std::pair<std::size_t, Point>>> bonds;  ///< neighbours and r0
  std::vector<std::array<hmps::Index, 2>> cut;                    ///< sorted pairs between which there is air
  std::size_t removed = 0;

  /// Bonds particle i to the particles for which `near(i, visit)` calls visit(j, r0), unless there is air between them.
  /// Pairs for which `one(i, j)` holds are bonded without this test.
  template <class Near, class One>
  void bond(const Anatomy& anatomy, const Near& near, const One& one) {
    bonds.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i)
      near(i, [&](std::size_t j, const Point& r0) {
        if (j < i) return;  // Air is tested once per pair, so that both ends get the same result.
        if (!one(i, j) && air_between(anatomy, 1e3 * points[i], 1e3 * points[j]))
          cut.push_back(ordered(i, j));
        else
          bonds[i].emplace_back(j, r0), bonds[j].emplace_back(i, Point(-r0));
      });
    std::sort(cut.begin(), cut.end());
  }

  /// Removes weakly supported particles until there are none, and loose pieces.
  void keep_supported(double spacing) {
    const auto bonded = [this](std::size_t i, std::size_t j) {
      return !std::binary_search(cut.begin(), cut.end(), ordered(i, j));
    };
    std::vector<char> kept(points.size(), 0);
    for (const hmps::Index i :
         hmps::supported_particles(hmps::vectors(points), {.spacing = spacing}, hmps::KeepNone{}, bonded))
      kept[i] = 1;
    keep(kept);
  }

 private:
  void keep(const std::vector<char>& kept) {
    std::vector<std::size_t> place(points.size());
    std::size_t count = 0;
    for (std::size_t i = 0; i < points.size(); ++i) place[i] = kept[i] ? count++ : points.size();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!kept[i]) continue;
      std::vector<std::pair<std::size_t, Point>> rest;
      for (const auto& [j, r0] : bonds[i])
        if (kept[j]) rest.emplace_back(place[j], r0);
      bonds[place[i]] = std::move(rest);
    }
    bonds.resize(count);
    const auto shorten = [&](auto& values) {
      if (values.empty()) return;
      for (std::size_t i = 0; i < kept.size(); ++i)
        if (kept[i]) values[place[i]] = values[i];
      values.resize(count);
    };
    shorten(points), shorten(organ), shorten(depth), shorten(layers), shorten(layer_spacings);
    std::vector<std::array<hmps::Index, 2>> rest;
    for (const auto& [i, j] : cut)
      if (kept[i] && kept[j]) rest.push_back({static_cast<hmps::Index>(place[i]), static_cast<hmps::Index>(place[j])});
    cut = std::move(rest);
  }
};

/// `Body::depth` of particles on a lattice, where a particle inside the body has six face neighbours.
[[nodiscard]] inline std::vector<char> lattice_depths(const Body& body, double spacing) {
  std::vector<char> depth(body.points.size(), 2);
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    int faces = 0;
    for (const auto& [j, r0] : body.bonds[i]) faces += r0.norm() < 1.1 * spacing;
    if (faces < 6) depth[i] = 0;
  }
  for (std::size_t i = 0; i < body.points.size(); ++i)
    if (depth[i] == 2)
      for (const auto& [j, r0] : body.bonds[i])
        if (depth[j] == 0 && r0.norm() < 1.1 * spacing) depth[i] = 1;
  return depth;
}

/// The lattice sites in the organs. On a coarse lattice the thin edges of the epiglottis have too few neighbours: they
/// are filled up, and weakly supported particles elsewhere are removed.
[[nodiscard]] inline Body lattice_body(const Anatomy& anatomy, double spacing, double shift) {
  // Along y, columns of particles lie on both sides of the midsagittal plane and none lies in it, so left and right
  // mirror each other. Along x, a plane of particles lies along the posterior wall, which is then not a staircase.
  // There is no such surface for z, which follows x. At 1.8 mm the fold depends on this position: see
  // docs/swallowing.md.
  const double plane = 1e-3 * Pharynx::posterior_wall + (0.5 + shift) * spacing;
  const auto inside = [&](const Point& x) { return anatomy.organ_at(1e3 * x) == Organ::none ? 1.0 : -1.0; };
  Body body;
  body.points = hmps::fill_lattice(inside, bounds_of_organs(), spacing, Point(plane, spacing / 2, plane));
  const std::size_t drawn = body.points.size();
  const auto fill_up = [&](const Point& x) {
    return anatomy.epiglottis(1e3 * x) < 0.5e3 * spacing && anatomy.epiglottis.ahead(1e3 * x) < 0.3;
  };
  for (const Point& x : hmps::thicken(hmps::vectors(body.points), {.spacing = spacing}, fill_up))
    body.points.push_back(x);
  for (std::size_t i = 0; i < body.points.size(); ++i)
    body.organ.push_back(i < drawn ? anatomy.organ_at(1e3 * body.points[i]) : Organ::epiglottis);

  const LatticeGraph graph(body.points, spacing);
  body.bond(
      anatomy, [&](std::size_t i, const auto& visit) { graph.around(i, visit); },
      [&](std::size_t i, std::size_t j) { return std::max(i, j) >= drawn && body.organ[i] == body.organ[j]; });
  body.keep_supported(spacing);
  body.removed = drawn - std::min(drawn, body.points.size());
  body.depth = lattice_depths(body, spacing);
  return body;
}

/// The organs of fitted particles. The surface to which they are fitted cuts corners between organs, so that some
/// particles lie in no organ: they get that of the nearest particle.
[[nodiscard]] inline std::vector<Organ> organs_of(const Anatomy& anatomy, const std::vector<Point>& points) {
  std::vector<Organ> drawn;
  for (const Point& x : points) drawn.push_back(anatomy.organ_at(1e3 * x));
  std::vector<Organ> organ = drawn;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (drawn[i] != Organ::none) continue;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < points.size(); ++j) {
      const double squared = (points[j] - points[i]).squaredNorm();
      if (drawn[j] == Organ::none || squared >= least) continue;
      least = squared;
      organ[i] = drawn[j];
    }
  }
  return organ;
}

/// The fitted particles, except weakly supported ones.
[[nodiscard]] inline Body fitted_body(const Anatomy& anatomy, const FittedOrgans& fitted, double spacing) {
  Body body;
  body.points = fitted.particles.positions;
  body.layers = fitted.particles.layers;
  body.layer_spacings = fitted.particles.layer_spacings;
  body.organ = organs_of(anatomy, body.points);
  for (const double depth : fitted.depth) body.depth.push_back(static_cast<char>(std::clamp(depth, 0.0, 2.0)));
  const hmps::FixedRadiusSearch search(hmps::vectors(body.points));
  std::vector<hmps::Index> nearby;
  body.bond(
      anatomy,
      [&](std::size_t i, const auto& visit) {
        search(body.points[i], hmps::paper_radius_ratio * spacing, nearby);
        for (const hmps::Index j : nearby)
          if (j != i) visit(j, Point(body.points[j] - body.points[i]));
      },
      [](std::size_t, std::size_t) { return false; });
  body.keep_supported(spacing);
  body.removed = fitted.particles.size() - body.points.size();
  return body;
}

}  // namespace detail
}  // namespace swallowing
