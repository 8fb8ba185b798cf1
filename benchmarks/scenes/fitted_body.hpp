// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <hmps/hmps.hpp>
#include <vector>

/// Bodies of fitted particles, and the force that holds them together.
namespace scenes {

using Fit = hmps::FittedParticles<double, 3>;

/// The particles of several fits, in their order.
[[nodiscard]] inline Fit joined(const std::vector<Fit>& pieces) {
  Fit all;
  for (const Fit& piece : pieces) all.append(piece);
  return all;
}

/// The particles whose position fulfils `keep`.
template <class Keep>
[[nodiscard]] Fit part_of(const Fit& whole, Keep&& keep) {
  Fit part;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (!keep(whole.positions[i])) continue;
    part.positions.push_back(whole.positions[i]);
    part.volumes.push_back(whole.volumes[i]);
    part.layers.push_back(whole.layers[i]);
    part.layer_spacings.push_back(whole.layer_spacings[i]);
  }
  return part;
}

/// Particles fitted to a box (m). The grid with which `fit_particles` samples it is turned by the inverse of `turn`
/// against the box, about its centre.
[[nodiscard]] inline Fit fit_turned(const hmps::Box<double, 3>& box, const hmps::Matrix<double, 3>& turn,
                                    double spacing) {
  using Point = hmps::Vector<double, 3>;
  const Point centre = (box.lower + box.upper) / 2, half = (box.upper - box.lower) / 2;
  const Point reach = turn.cwiseAbs() * half + Point::Constant(0.1 * spacing);
  const auto turned = [&](const Point& x) { return box(centre + turn.transpose() * x); };
  Fit fit = hmps::fit_particles(turned, hmps::Box<double, 3>{-reach, reach}, spacing);
  for (Point& place : fit.positions) place = centre + turn.transpose() * place;
  return fit;
}

/// A turn for `fit_turned` by which the samples lie along no edge of the box. Where they do, a bar as wide as high
/// counts as a wall or as bulk by chance (docs/fitted.md, Limits), and so has one E_hat or another.
[[nodiscard]] inline hmps::Matrix<double, 3> oblique() {
  return Eigen::AngleAxisd(0.3, hmps::Vector<double, 3>(1, 2, 3).normalized()).toRotationMatrix();
}

/// A bar in 0 <= x <= `size`[0], and likewise in y and z, whose face at x = 0 is clamped by `held` particles, which
/// come first.
struct FittedBar {
  Fit fit;
  std::size_t held = 0;
};

/// Fits a bar. A body begins to deform at the particles that hold it, so the clamped face passes through the middle of
/// the outermost of these: the two pieces, which are fitted separately, meet half a spacing beyond the face. The held
/// piece is fitted longer than it is wide, so that its layers are those of the bar, and then cut off where nothing that
/// moves is affected any more.
[[nodiscard]] inline FittedBar fit_bar(const hmps::Vector<double, 3>& size, double spacing, bool clamped) {
  using Point = hmps::Vector<double, 3>;
  const auto fit = [&](double from, double to) {
    const hmps::Box<double, 3> box{Point(from, 0, 0), Point(to, size[1], size[2])};
    return fit_turned(box, oblique(), spacing);
  };
  if (!clamped) return {fit(0, size[0])};
  const double face = spacing / 2, depth = spacing * (std::ceil(size.tail<2>().maxCoeff() / spacing) + 1);
  const Fit held = part_of(fit(face - depth, face), [&](const Point& x) { return x[0] > -2.5 * spacing; });
  return {joined({held, fit(face, size[0])}), held.size()};
}

[[nodiscard]] inline hmps::MooneyRivlin<> with_bulk(const hmps::MooneyRivlin<>& law, double bulk) {
  return {law.c1, law.c2, bulk / 2};
}
[[nodiscard]] inline hmps::SaintVenantKirchhoff<> with_bulk(const hmps::SaintVenantKirchhoff<>& law, double bulk) {
  return hmps::SaintVenantKirchhoff<>::from_moduli(bulk, law.shear_modulus());
}

/// The stabiliser of fitted particles of the material `law`.
template <class Law>
[[nodiscard]] hmps::ThinWallStabiliser<double> stabiliser_of(const Fit& fit, double spacing, const Law& law) {
  return hmps::thin_wall_stabiliser(fit.layers, fit.layer_spacings, spacing, law.bulk_modulus(), law.shear_modulus());
}

/// Elasticity by `law`, stabilised as `chosen` says, and `others`. The force reads the moduli in `chosen`, which must
/// outlive it.
template <class B, class Law, class... Others>
[[nodiscard]] auto thin_wall_force(const B& bonds, const Law& law, const hmps::ThinWallStabiliser<double>& chosen,
                                   const Others&... others) {
  return hmps::internal_force(
      bonds, hmps::elastic(with_bulk(law, chosen.bulk.law)), hmps::mean_dilatation<2>(chosen.bulk.mean),
      hmps::artificial([modulus = hmps::scalars(chosen.moduli)](const auto& of) { return of(modulus); }), others...);
}

}  // namespace scenes
