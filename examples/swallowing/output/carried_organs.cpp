// SPDX-License-Identifier: MIT
#include "output/carried_organs.hpp"

#include <algorithm>
#include <cmath>
#include <hmps/executors/openmp.hpp>
#include <hmps/shapes/isosurface.hpp>

#include "scene/anatomy.hpp"

namespace swallowing {

namespace {

constexpr double cell = 1.2e-3;  // m, also at finer spacings: the drawn organs are the same

/// A box (m) around what is drawn of an organ on the right; nothing if it has no particles there.
[[nodiscard]] std::optional<hmps::Box<double, 3>> bounds_of(const Scene& scene, Organ organ) {
  std::optional<hmps::Box<double, 3>> box;
  for (std::size_t i = 0; i < scene.elastic_count; ++i) {
    const Point& x = scene.reference[i];
    if (scene.organ[i] != organ || x[1] < 0) continue;
    if (!box) box = hmps::Box<double, 3>{x, x};
    box->lower = box->lower.cwiseMin(x);
    box->upper = box->upper.cwiseMax(x);
  }
  if (!box) return box;
  // The outermost particles lie up to half a spacing inside the drawn surface; weakly supported ones are left out.
  box->lower -= Point::Constant(1.5 * scene.spacing);
  box->upper += Point::Constant(1.5 * scene.spacing);
  box->lower[1] = 0;
  return box;
}

}  // namespace

CarriedOrgans::CarriedOrgans(const Scene& scene, int threads) {
  const hmps::OpenMP execute{threads};
  const Anatomy anatomy;
  for (int o = 0; o < organ_count; ++o) {
    const auto organ = static_cast<Organ>(o);
    const auto box = bounds_of(scene, organ);
    if (!box) continue;
    const auto sign = [&](const Point& x) { return anatomy.organ_at(1e3 * x) == organ ? -1.0 : 1.0; };
    const auto mesh = hmps::isosurface(sign, *box, cell, execute);
    const auto belongs = [&](std::size_t i) { return scene.organ[i] == organ; };
    carried_.emplace_back(hmps::vectors(scene.reference), hmps::vectors(mesh.vertices), scene.spacing, belongs,
                          execute);
    const auto first = static_cast<hmps::Index>(organ_.size());
    organ_.insert(organ_.end(), mesh.vertices.size(), organ);
    for (const Triangle& t : mesh.triangles) {
      triangles_.push_back({first + t[0], first + t[1], first + t[2]});
      // The first layer of cells lies half in front of the plane: its triangles cover the cut and bevel its edge.
      cut_.push_back(
          std::all_of(t.begin(), t.end(), [&](hmps::Index v) { return mesh.vertices[v][1] < 0.501 * cell; }));
    }
  }
}

std::vector<std::array<float, 3>> CarriedOrgans::vertices(const std::vector<std::array<float, 3>>& particles) const {
  std::vector<std::array<float, 3>> all, of_organ;
  all.reserve(organ_.size());
  for (const auto& carried : carried_) {
    of_organ.resize(carried.size());
    carried(hmps::vectors(particles), hmps::vectors(of_organ));
    all.insert(all.end(), of_organ.begin(), of_organ.end());
  }
  return all;
}

}  // namespace swallowing
