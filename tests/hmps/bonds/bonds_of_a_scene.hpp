// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "../../reference/plain.hpp"
#include "../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/bond_settings.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/view.hpp"

/// Shared by the tests of both models of bonds.
namespace bonds_of_a_scene {

template <class B>
B make(const scenes::Scene<B::dimension>& scene) {
  return B(hmps::vectors(scene.reference), {.spacing = scene.spacing}, scene.bonded);
}

/// The bonds, seen in every way, are those of Eqs. (8) and (12) evaluated one by one.
template <class B>
void equal_the_plain_ones(const B& bonds, const scenes::Scene<B::dimension>& scene) {
  using K = typename B::Scalar;
  constexpr int D = B::dimension;
  constexpr double eps = std::numeric_limits<K>::epsilon();
  // Reference positions of about 0.1 m give r0 to this share of the spacing.
  constexpr double place = 1e-13;
  const std::vector<Eigen::Matrix<double, D, 1>> reference(scene.reference.begin(), scene.reference.end());
  const plain::Body<double, D> body(reference, 1.75 * scene.spacing, scene.bonded);
  ASSERT_EQ(bonds.size(), body.size());
  for (std::size_t i = 0; i < body.size(); ++i) {
    std::map<std::size_t, std::pair<hmps::Vector<K, D>, K>> found;
    bonds.for_each_bond(i, [&](std::size_t j, const hmps::Vector<K, D>& r0, K w) {
      EXPECT_TRUE(found.emplace(j, std::pair(r0, w)).second) << "the bond " << i << ' ' << j << " appears twice";
    });
    ASSERT_EQ(found.size(), body.neighbours(i)) << i;
    body.for_each_bond(i, [&](const auto& bond) {
      const auto own = found.find(bond.j);
      ASSERT_NE(own, found.end()) << i << ' ' << bond.j;
      EXPECT_LE((own->second.first.template cast<double>() - bond.r0).norm(), (eps + place) * 2 * scene.spacing);
      EXPECT_NEAR(static_cast<double>(own->second.second), bond.w, 4 * (eps + place));
    });
    const auto inverse = bonds.shape_inverse(i).template cast<double>().eval();
    // The relative error of w, r0 and the inverse; at weakly supported particles A is less well conditioned.
    EXPECT_LE((inverse - body.shape_inverse(i)).norm(), 50 * (eps + place) * body.shape_inverse(i).norm()) << i;
    EXPECT_NEAR(static_cast<double>(bonds.shape_trace(i)), body.shape_trace(i),
                8 * (eps + place) * body.shape_trace(i));
    EXPECT_EQ(bonds.reference(i), scene.reference[i]);
    EXPECT_EQ(bonds.particle(bonds.slot(i)), i);
  }
}

/// A sweep over rows and lanes meets each bond once, with the neighbour's value, r0 and w; lanes
/// without the bond have weight zero.
template <class B>
void sweep_meets_every_bond_once(const B& bonds) {
  using K = typename B::Scalar;
  constexpr int D = B::dimension;
  typename B::template Slots<1> numbers(bonds.slot_count());
  typename B::template Slots<3> more(bonds.slot_count());
  for (std::size_t slot = 0; slot < bonds.slot_count(); ++slot) {
    numbers(0, slot) = static_cast<K>(slot);
    for (std::size_t c = 0; c < 3; ++c) more(c, slot) = static_cast<K>(3 * slot + c);
  }
  ASSERT_GE(bonds.slot_count(), bonds.size());
  ASSERT_EQ(bonds.slot_count() % B::width, 0u);
  for (std::size_t block = 0; block < bonds.block_count(); ++block) {
    std::vector<std::map<std::size_t, std::pair<hmps::Vector<K, D>, K>>> found(B::width);
    bonds.for_each_row(block, [&](const auto& row) {
      const hmps::Lanes<K> w = row.weight(), place = row.gather(numbers)[0];
      const auto components = row.gather(more);
      for (std::size_t l = 0; l < B::width; ++l) {
        EXPECT_GE(w.lane[l], K(0));
        if (!(w.lane[l] > K(0))) continue;
        for (std::size_t c = 0; c < 3; ++c)
          EXPECT_EQ(hmps::Lanes<K>(components[c]).lane[l], 3 * place.lane[l] + static_cast<K>(c));
        hmps::Vector<K, D> r0;
        for (int c = 0; c < D; ++c) {
          r0[c] = hmps::Lanes<K>(row.offset(c)).lane[l];
          EXPECT_TRUE(row.along(c) || r0[c] == K(0));
        }
        const std::size_t j = bonds.particle(static_cast<std::size_t>(place.lane[l]));
        EXPECT_TRUE(found[l].emplace(j, std::pair(r0, w.lane[l])).second);
      }
    });
    for (std::size_t l = 0; l < B::width; ++l) {
      const hmps::Index i = bonds.particle(block * B::width + l);
      if (i == B::none) {
        EXPECT_TRUE(found[l].empty());
        continue;
      }
      std::size_t count = 0;
      bonds.for_each_bond(i, [&](std::size_t j, const hmps::Vector<K, D>& r0, K w) {
        ++count;
        const auto own = found[l].find(j);
        ASSERT_NE(own, found[l].end());
        EXPECT_EQ(own->second.first, r0);
        EXPECT_EQ(own->second.second, w);
      });
      EXPECT_EQ(count, found[l].size());
    }
  }
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}
inline bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

/// Inputs that both models refuse, with the words of the message.
template <class B>
void refuse_bad_input() {
  constexpr int D = B::dimension;
  using P = scenes::Points<D>;
  constexpr double l0 = scenes::Scene<D>::spacing;
  static_assert(l0 == 1.2e-3);
  const P good = scenes::box<D>(scenes::extent<D>(5, 4, 3));
  const auto text = [](const P& points, hmps::BondSettings settings = {.spacing = 1.2e-3}) {
    return error_of([&] { (void)B(hmps::vectors(points), settings); });
  };
  EXPECT_EQ(text(good), "nothing was thrown");

  for (const double spacing :
       {0.0, -1e-3, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    EXPECT_TRUE(has(text(good, {.spacing = spacing}),
                    "the spacing of the particles is " + hmps::detail::message(spacing) + " m"))
        << text(good, {.spacing = spacing});
  for (const double ratio : {0.0, -1.75, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_TRUE(has(text(good, {.spacing = l0, .radius_ratio = ratio}),
                    "the effective radius is " + hmps::detail::message(ratio)))
        << text(good, {.spacing = l0, .radius_ratio = ratio});

  P points = good;
  points.push_back(points[7]);
  EXPECT_TRUE(has(text(points), "particles 7 and " + std::to_string(good.size()) + " lie at the same place"))
      << text(points);
  points = good;
  points[9][1] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(has(text(points), "particle 9 is nan")) << text(points);

  points = good;
  points.push_back(good.back());
  points.back()[0] += 10 * l0;
  EXPECT_TRUE(has(text(points), "particle " + std::to_string(good.size()) + " has 0 neighbours")) << text(points);
  // Particle 0 and those that follow lie on a line, or in a plane.
  const P line = scenes::box<D>(scenes::extent<D>(6, 1, 1));
  EXPECT_TRUE(has(text(line), "particle 0 has 1 neighbour that")) << text(line);
  if constexpr (D == 3) {
    const P plane = scenes::box<D>(scenes::extent<D>(6, 5, 1));
    EXPECT_TRUE(has(text(plane), "particle 0 has 3 neighbours that do not span the 3D space")) << text(plane);
  }
  // Cutting its bonds isolates a particle.
  const std::string cut = error_of([&] {
    (void)B(hmps::vectors(good), {.spacing = l0}, [](std::size_t i, std::size_t j) { return i != 11 && j != 11; });
  });
  EXPECT_TRUE(has(cut, "particle 11 has 0 neighbours")) << cut;
}

}  // namespace bonds_of_a_scene
