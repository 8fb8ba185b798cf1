// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace swallowing {

/// The organ to which a particle belongs.
enum class Organ : std::int8_t {
  none = -1,
  tongue,
  soft_palate,
  hard_palate,
  epiglottis,
  vallecula,
  larynx,
  pharynx,
  esophagus,
  vertebrae,    ///< the strip behind the posterior wall, region G of the paper
  constrictors  ///< the rigid plates outside the pharyngeal wall, region H
};
inline constexpr int organ_count = 10;

[[nodiscard]] constexpr std::string_view name(Organ organ) {
  constexpr std::array<std::string_view, organ_count> names{"tongue",    "soft palate", "hard palate", "epiglottis",
                                                            "vallecula", "larynx",      "pharynx",     "esophagus",
                                                            "vertebrae", "constrictors"};
  return organ == Organ::none ? "none" : names[static_cast<std::size_t>(organ)];
}

/// Two organs whose surfaces may touch. All other pairs never come close to each other, or are one body.
struct OrganPair {
  Organ first, second;
};
inline constexpr std::array<OrganPair, 14> touching{{
    {Organ::epiglottis, Organ::tongue},
    {Organ::epiglottis, Organ::pharynx},
    {Organ::epiglottis, Organ::larynx},
    {Organ::epiglottis, Organ::vallecula},
    {Organ::tongue, Organ::pharynx},
    {Organ::tongue, Organ::soft_palate},
    {Organ::tongue, Organ::hard_palate},
    {Organ::tongue, Organ::larynx},
    {Organ::tongue, Organ::vallecula},
    {Organ::soft_palate, Organ::pharynx},
    {Organ::larynx, Organ::pharynx},
    {Organ::larynx, Organ::esophagus},
    {Organ::vallecula, Organ::larynx},
    {Organ::constrictors, Organ::pharynx},
}};

}  // namespace swallowing
