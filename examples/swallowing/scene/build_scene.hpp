// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

#include "../../common/error.hpp"
#include "scene/body.hpp"
#include "scene/scene.hpp"

namespace swallowing {

namespace detail {

/// Distance in mm along the body from the joint of two organs, within which they have no contact.
inline constexpr double attachment = 5.0;

/// Marks the particles of organs `a` and `b` within `attachment` along the body of where the two are joined.
[[nodiscard]] inline std::vector<char> near_joint(const Body& body, Organ a, Organ b) {
  const auto& points = body.points;
  const auto& organ = body.organ;
  std::vector<double> distance(points.size(), 1);
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  const auto reach = [&](std::size_t i, double d) {
    if (d < distance[i] && d < 1e-3 * attachment) distance[i] = d, queue.emplace(d, i);
  };
  for (std::size_t i = 0; i < points.size(); ++i)
    if (organ[i] == a || organ[i] == b)
      for (const auto& [j, r0] : body.bonds[i])
        if (organ[j] == (organ[i] == a ? b : a)) reach(i, r0.norm() / 2);
  while (!queue.empty()) {
    const auto [d, i] = queue.top();
    queue.pop();
    if (d > distance[i]) continue;
    for (const auto& [j, r0] : body.bonds[i]) reach(j, d + r0.norm());
  }
  std::vector<char> near(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) near[i] = distance[i] < 1;
  return near;
}

/// The displacement (m) of regions E and F along the leaf in the first half second, by which the leaf ends where it is
/// drawn: its drawn end lies between two planes of the lattice, and an error of up to a spacing would decide how hard
/// it rubs on the posterior wall.
[[nodiscard]] inline Point leaf_placement(const Body& body, double spacing) {
  const double angle = Epiglottis::angle(0.8 * Epiglottis::length);
  const Point along(std::cos(angle), 0, std::sin(angle));
  double reach = -2 * spacing;
  for (std::size_t i = 0; i < body.points.size(); ++i)
    if (body.organ[i] == Organ::epiglottis && std::abs(body.points[i][1]) < 4e-3)
      reach = std::max(reach, along.dot(body.points[i] - 1e-3 * Epiglottis::midline(Epiglottis::length)) + spacing / 2);
  return -reach * along;
}

/// The surface correction for the outermost particles of the organs between which the epiglottis folds. It places them
/// at the drawn surface, from which they lie up to half a spacing away if the surface cuts the lattice. Particles a
/// spacing or more away remain in place: they belong to joints and ends.
[[nodiscard]] inline hmps::SurfaceCorrection<double, 3> surface_correction(const Scene& scene, const Body& body,
                                                                           const Anatomy& anatomy) {
  const double l0 = scene.spacing;
  const auto surface = [&](const Point& x) { return 1e-3 * anatomy.surface(1e3 * x); };
  std::vector<hmps::Index> skin;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const Organ organ = body.organ[i];
    if (body.depth[i] > 0 || (organ != Organ::epiglottis && organ != Organ::pharynx && organ != Organ::tongue))
      continue;
    const auto offset = hmps::SurfaceCorrection<double, 3>::offset_of(body.points[i], surface, l0);
    if (offset && offset->norm() < l0) skin.push_back(static_cast<hmps::Index>(i));
  }
  return {hmps::vectors(scene.reference), skin, surface, l0};
}

/// Fills `scene.contacts` for the pairs in `touching`, without the particles of region H.
inline void declare_contacts(Scene& scene, const Body& body) {
  const auto& depth = body.depth;
  for (const OrganPair& pair : touching) {
    ContactPair contact{pair.first, pair.second, {}, {}, {}, {}};
    const auto near = near_joint(body, pair.first, pair.second);
    for (std::size_t i = 0; i < body.points.size(); ++i) {
      if (depth[i] > 1 || near[i] || (body.organ[i] != pair.first && body.organ[i] != pair.second)) continue;
      const bool first = body.organ[i] == pair.first;
      (first ? contact.first_masters : contact.second_masters).push_back(static_cast<hmps::Index>(i));
      if (depth[i] == 0) (first ? contact.first_slaves : contact.second_slaves).push_back(static_cast<hmps::Index>(i));
    }
    scene.contacts.push_back(std::move(contact));
  }
}

/// Appends the plates of region H and their contact with the wall to `scene`. Nothing is bonded to them, so they need
/// no lattice: rows of particles a spacing apart follow the wall at a distance from its drawn inner surface that does
/// not depend on the spacing. The wall's own particles lie up to half a spacing outside the drawn wall, which at 2.4 mm
/// is within the plates. Therefore the plates start half a spacing further out, clear of the wall, and reach their
/// place in the first half second.
inline void add_constrictors(Scene& scene, const Anatomy& anatomy, const Constrictors& constrictors) {
  const double l0 = 1e3 * scene.spacing;
  // Two layers of particles carry all of a metaball wall.
  const int layers = std::max(2, static_cast<int>(std::lround(Anatomy::plate / l0)));
  auto contact = std::find_if(scene.contacts.begin(), scene.contacts.end(),
                              [](const ContactPair& c) { return c.first == Organ::constrictors; });
  const auto add = [&](const Point& x, std::size_t region) {
    const auto index = static_cast<hmps::Index>(scene.reference.size());
    contact->first_slaves.push_back(index);
    contact->first_masters.push_back(index);
    scene.reference.emplace_back(1e-3 * x);
    scene.organ.push_back(Organ::constrictors);
    scene.region.push_back(static_cast<int>(region));
  };
  constexpr double outwards = 57.5 * std::numbers::pi / 180;  // middle of the plates' arc, from the posterior axis
  int row = 0;
  for (double z = constrictors.bottom() + l0 / 2; z < constrictors.top(); z += l0, ++row) {
    const Point clear = l0 / 2 * Point(std::cos(outwards), std::sin(outwards), 0);
    for (const int side : {-1, 1})
      scene.regions.push_back({examples::message("H", row, side < 0 ? " left" : " right"), Region::door, row,
                               double(side), z, -1e-3 * Point(clear[0], side * clear[1], 0)});
    const std::size_t right = scene.regions.size() - 1;
    const auto [_, widest, back, half_width, front] = anatomy.pharynx.profile(z);
    for (int layer = 0; layer < layers; ++layer) {
      const double distance = wall + Anatomy::plate_gap + (layer + 0.5) * l0;
      // Along the ellipse of the channel from its side to the back, in tenths of a degree.
      double walked = l0;
      Point last = Point::Zero();
      for (int step = 0; step <= 900; ++step) {
        const double s = (90 - 0.1 * step) * std::numbers::pi / 180;
        const double a = back - widest, c = std::cos(s), d = std::sin(s);
        const Point normal = Point(c / a, d / half_width, 0).normalized();
        const Point x = Point(widest + a * c, half_width * d, z) + distance * normal;
        if (step > 0) walked += (x - last).norm();
        last = x;
        if (std::atan2(x[1], x[0] - widest) * 180 / std::numbers::pi < Anatomy::plate_from) break;
        if (walked < l0) continue;
        walked -= l0;
        const Point start = x + clear;
        add(start, right);
        add(Point(start[0], -start[1], start[2]), right - 1);
      }
    }
  }
}

}  // namespace detail

/// Throws `hmps::InputError` if a control region of the scene has no particles: it would prescribe nothing, and the run
/// would be that of another model.
inline void require_particles(const Scene& scene, Model model) {
  const auto particles = scene.particles_of_regions();
  for (std::size_t r = 0; r < particles.size(); ++r)
    examples::require(!particles[r].empty(), "control region ", scene.regions[r].name, " of model ",
                      model == Model::X ? "X" : "Y", " has no particle at a spacing of ", 1e3 * scene.spacing,
                      " mm, so that nothing of it would move; widen it in scene/regions.hpp, or give a finer --spacing",
                      scene.layers.empty() ? " or another --lattice-shift" : "");
}

/// Builds the scene of a case. Throws `hmps::InputError` for a spacing at which the organs fall apart or a control
/// region has no particles.
[[nodiscard]] inline Scene make_scene(const SceneSettings& settings) {
  const double l0 = settings.spacing;
  examples::require(l0 >= 0.5e-3 && l0 <= 2.45e-3, "the spacing of the swallow is ", l0,
                    " m; give 0.5e-3 to 2.4e-3, since the sheets of 4.8 mm need two particles");
  const Anatomy anatomy;
  const detail::Body body = settings.fitted ? detail::fitted_body(anatomy, *settings.fitted, l0)
                                            : detail::lattice_body(anatomy, l0, settings.lattice_shift);

  Scene scene;
  scene.spacing = l0;
  scene.elastic_count = body.points.size();
  scene.removed = body.removed;
  scene.regions = body_regions(settings.model);
  scene.organ = body.organ;
  scene.cut = body.cut;
  scene.layers = body.layers;
  scene.layer_spacings = body.layer_spacings;
  for (std::size_t i = 0; i < body.points.size(); ++i) {
    const Point x = 1e3 * body.points[i];
    scene.reference.emplace_back(body.points[i]);
    scene.region.push_back(region_at(anatomy, body.organ[i], x, settings.model));
    if (body.organ[i] != Organ::epiglottis || std::abs(x[1]) > 2.5) continue;
    const double arc = anatomy.epiglottis.arc(x);
    const auto index = static_cast<hmps::Index>(i);
    if (arc < base_of_leaf) scene.base.push_back(index);
    if (in_middle_of_leaf(arc)) scene.centre.push_back(index);
    if (arc > Epiglottis::length - 3) scene.tip.push_back(index);
  }
  detail::declare_contacts(scene, body);
  // Fitted particles lie along the drawn surfaces, and the leaf ends where it is drawn.
  if (!settings.fitted) {
    if (settings.drawn_surfaces) scene.skin = detail::surface_correction(scene, body, anatomy);
    const Point placement = detail::leaf_placement(body, l0);
    for (Region& region : scene.regions)
      if (region.name == "E" || region.name == "F") region.placement = placement;
  }
  if (settings.constrictors) detail::add_constrictors(scene, anatomy, read_constrictors(settings.data));
  std::erase_if(scene.contacts, [](const ContactPair& c) { return c.first_slaves.empty() || c.second_slaves.empty(); });
  require_particles(scene, settings.model);
  return scene;
}

}  // namespace swallowing
