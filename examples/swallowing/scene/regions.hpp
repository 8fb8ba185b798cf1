// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <hmps/core/error.hpp>
#include <string>
#include <vector>

#include "../../common/error.hpp"
#include "scene/anatomy.hpp"
#include "scene/cases.hpp"

namespace swallowing {

/// A control region: the particles whose motion is prescribed (sections 3.2 to 3.6 of the paper).
struct Region {
  enum Kind {
    fixed,  ///< does not move: the vertebrae (G), the hard palate, the roof of the pharynx
    moved,  ///< `number` as in data/regions.csv
    door    ///< one row of plates of region H, at `height`
  };
  std::string name;
  Kind kind = fixed;
  int number = 0;
  double side = 0;                  ///< -1 or 1 for one of a pair, the sign of y
  double height = 0;                ///< mm
  Point placement = Point::Zero();  ///< m, its displacement in the first half second: E, F and H
};

/// Middle and half width of a control region of the tongue, as angles about its centre in degrees.
struct TongueRegion {
  double angle, half;
};
inline constexpr std::array<TongueRegion, 8> tongue_regions{
    {{-54, 8}, {1, 13}, {50, 10}, {74, 4}, {90, 4}, {106, 4}, {122, 4}, {138, 4}}};

/// Length in mm of the base of the leaf that region E holds, from its lower end.
inline constexpr double base_of_leaf = 5;
/// Whether the middle of the leaf, which region F moves, contains the `arc` in mm from its lower end.
[[nodiscard]] inline bool in_middle_of_leaf(double arc) {
  return arc > 0.45 * Epiglottis::length && arc < 0.62 * Epiglottis::length;
}

/// Width in mm of the part of the tongue's side, from its rim inwards, that region A holds: one and a half times the
/// coarsest spacing, so that a column of any lattice lies in it.
inline constexpr double rim_width = 3.6;

/// The control regions of the deforming body, in a fixed order; F, which model Y lacks, is the last.
[[nodiscard]] inline std::vector<Region> body_regions(Model model) {
  std::vector<Region> regions{{"fixed", Region::fixed}};
  for (int k = 0; k < 8; ++k) regions.push_back({examples::message("B", k), Region::moved, k});
  regions.push_back({"A", Region::moved, 10});
  regions.push_back({"S1", Region::moved, 20});
  regions.push_back({"S2", Region::moved, 21});
  regions.push_back({"C", Region::moved, 30});
  regions.push_back({"D left", Region::moved, 31, -1});
  regions.push_back({"D right", Region::moved, 31, 1});
  regions.push_back({"E", Region::moved, 40});
  regions.push_back({"G", Region::fixed});
  if (model == Model::X) regions.push_back({"F", Region::moved, 41});
  return regions;
}

/// The index in `body_regions` of the region to which a particle of `organ` at `x` (mm) belongs, -1 for none.
[[nodiscard]] inline int region_at(const Anatomy& anatomy, Organ organ, const Point& x, Model model) {
  constexpr int fixed = 0, B = 1, A = 9, S1 = 10, S2 = 11, C = 12, D = 13, E = 15, G = 16, F = 17;
  const double y = std::abs(x[1]);
  switch (organ) {
    case Organ::vertebrae:
      return G;
    case Organ::hard_palate:
      return fixed;
    case Organ::pharynx:
      return x[2] > 91 ? fixed : -1;
    case Organ::tongue: {
      const auto [angle, radius, row] = anatomy.tongue.polar(x);
      const double depth = row[1] - radius;
      // At 2.4 mm a column of the lattice stands at 6 mm: rounding, which differs between the two sides and between
      // compilers, must not decide whether it belongs.
      if (y < 6 + 1e-6 && depth < 4.8)
        for (std::size_t k = 0; k < tongue_regions.size(); ++k)
          if (std::abs(angle - tongue_regions[k].angle) < tongue_regions[k].half) return B + static_cast<int>(k);
      if (angle > 62 && y > Tongue::rim(row) - rim_width) return A;
      return -1;
    }
    case Organ::soft_palate: {
      const double arc = anatomy.soft_palate.arc(x);
      if (y < 5 && std::abs(arc - 14) < 3) return S1;
      if (y < 5 && std::abs(arc - 26) < 3) return S2;
      return -1;
    }
    case Organ::larynx: {
      if (x[2] > -23 && x[2] < -7 && anatomy.larynx.outside(x) < 0) return C;
      if (std::abs(x[0] - 6.5) < 3 && std::abs(y - 6) < 3 && x[2] > 1 && x[2] < 9) return x[1] < 0 ? D : D + 1;
      return -1;
    }
    case Organ::epiglottis: {
      const double arc = anatomy.epiglottis.arc(x);
      if (arc < base_of_leaf) return E;
      if (model == Model::X && y < 4 && in_middle_of_leaf(arc)) return F;
      return -1;
    }
    default:
      return -1;
  }
}

}  // namespace swallowing
