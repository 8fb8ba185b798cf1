// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/wall_layers.hpp"
#include "hmps/core/error.hpp"

namespace hmps::inline HMPS_ABI {

/// What `fit_particles` passes to its progress hook after each iteration.
struct FitProgress {
  int iteration;   ///< counted from 1
  int iterations;  ///< in total
  double move;     ///< the longest move of a particle in this iteration in m
};

/// Settings of `fit_particles`.
struct FitSettings {
  int least_layers = 2;  ///< least number of layers across a wall, from 1 to 8; thicker walls get more
  double thinnest_spacing =
      detail::closest_layers;  ///< least distance of layers in spacings, from 0.05; thinner walls get no particles
  double longest_edge = 4;     ///< how far, in spacings, such walls may reach beyond the outermost particles
  int iterations = 200;        ///< of the repulsion, at least 1
  /// Particles with less than this share of the support in a full lattice are left out; 0 leaves out none.
  double least_support = 0.05;
  /// Called after each iteration of the repulsion; may throw to stop the fit. Empty: not called.
  std::function<void(const FitProgress&)> progress = {};
};

namespace detail {

inline void validate(const FitSettings& s) {
  require(s.least_layers >= 1 && s.least_layers <= most_layers, "hmps: the least number of layers to fit is ",
          s.least_layers, "; give a number from 1 to ", most_layers, " (a wall needs 2 to bend)");
  require(is_finite(s.thinnest_spacing) && s.thinnest_spacing >= 0.05 && s.thinnest_spacing <= 1,
          "hmps: the thinnest spacing of layers to fit is ", s.thinnest_spacing,
          " spacings; give a share from 0.05 to 1 (0.6 is the default), not metres");
  require(is_finite(s.longest_edge) && s.longest_edge > 0 && s.longest_edge <= 100,
          "hmps: the longest edge without particles is ", s.longest_edge,
          " spacings; give a positive number up to 100");
  require(is_finite(s.least_support) && s.least_support >= 0 && s.least_support <= 0.5,
          "hmps: the least support of a particle to fit is ", s.least_support,
          "; give a share of the support in a full lattice, from 0 to 0.5 (0.05 is the default)");
  require(s.iterations >= 1, "hmps: the number of iterations to fit particles is ", s.iterations,
          "; make at least one");
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
