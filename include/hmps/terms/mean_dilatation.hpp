// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <type_traits>
#include <utility>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/detail/volume_shares.hpp"
#include "hmps/lanes/lane_math.hpp"
#include "hmps/terms/term.hpp"

namespace hmps::inline HMPS_ABI {

/// In place of the growth of a `MeanDilatation` whose tissue does not grow.
struct NoGrowth {};

/// Resists volume changes of neighbourhoods instead of single particles, so that thin, nearly incompressible bodies
/// bend correctly (mean dilatation; for finite elements: Nagtegaal, Parks and Rice 1974).
///
/// A particle and its bonded neighbours have the mean dilatation
///
///     theta_i = d_i sum_k d_k (J_k - 1),    J = det F,  k = i and its neighbours
///
/// and the body has the energy V sum_i U(theta_i), here with U = K theta^2 / 2. Its gradient is the force of a pressure
/// averaged in the same way,
///
///     M_i += p_i cof(F_i) A_i^-1,           p_i = d_i sum_k d_k U'(theta_k)
///
/// (see `Coupling`), so that momentum, angular momentum and energy are conserved as by \paper{13}. The factors d
/// satisfy d_i sum_k d_k = 1 everywhere, also at surfaces (Sinkhorn 1967): averaging preserves uniform dilatation and
/// uniform pressure. Where bonds know the volumes V of their particles, each d_k in these sums is V_k / l0^D times as
/// large.
///
/// The law of the particles keeps a bulk modulus of its own, which resists changes of J from particle to particle. For
/// deformations larger than a neighbourhood the two moduli add up. `split_bulk_modulus` divides a given modulus.
///
/// With two `means`, the mean is taken twice: theta_i = d_i sum_k d_k theta'_k, where theta' is the mean above, and the
/// pressure likewise. In walls of two layers that lie on no lattice, the means of the two sides differ by a fifth of
/// the change that bending causes, so that nearly incompressible walls still lock; taken twice, they differ by a
/// thirtieth (see `thin_wall_stabiliser`).
///
/// Tissue that grows to G = det F_g times its volume, F_g the growth tensor of its law, resists only the rest of the
/// change: with `growth` G
///
///     theta_i = d_i sum_k d_k (J_k - G_k),    energy V sum_i G_i U(theta_i / G_i),    p_i = d_i sum_k d_k U'(theta_k /
///     G_k)
///
/// and M as above. The penalty is on J / G - 1 where neighbours grow alike, K is the bulk modulus of the grown tissue,
/// and where neighbours grow by different amounts, a uniform pressure is preserved as without growth. G = J everywhere
/// is free of stress. Without `growth`, G = 1 costs nothing.
template <class Bulk, int Means = 1, class Growth = NoGrowth>
struct MeanDilatation {
  static_assert(Means == 1 || Means == 2, "hmps: the mean of the dilatation is taken once or twice");
  static constexpr int means = Means;
  static constexpr bool grows = !std::is_same_v<Growth, NoGrowth>;
  Bulk bulk;
  Growth growth = {};

  /// G of a particle or a block of them.
  template <class At>
  requires(grows) [[nodiscard]] HMPS_INLINE auto grown(const At& particles) const {
    return detail::value_at(growth, particles);
  }

  /// U'(theta) in Pa.
  template <class K, int D>
  [[nodiscard]] HMPS_INLINE Lanes<K> pressure(const BlockOfParticles<K, D>& particles,
                                              const Lanes<K>& mean_dilatation) const {
    const Lanes<K> own = detail::value_at(bulk, particles);
    if constexpr (grows)
      return own * mean_dilatation / Lanes<K>(grown(particles));
    else
      return own * mean_dilatation;
  }

  /// G U(theta / G) in J/m3 of the reference volume.
  template <class Particle>
  [[nodiscard]] double energy(const Particle& particle) const {
    return 0.5 * pressure(particle) * particle.mean_dilatation();
  }

  /// U'(theta / G) in Pa.
  template <class Particle>
  [[nodiscard]] double pressure(const Particle& particle) const {
    const double own = static_cast<double>(detail::value_at(bulk, particle)) * particle.mean_dilatation();
    if constexpr (grows)
      return own / static_cast<double>(grown(particle));
    else
      return own;
  }

  /// Throws `InputError` if the bulk modulus or the growth is a view of the wrong size.
  void check(std::size_t size) const {
    detail::require_quantity(bulk, size, "bulk moduli of mean_dilatation");
    detail::require_quantity(growth, size, "ratios of growth of mean_dilatation");
  }
  /// Throws `InputError` for a bulk modulus that is negative and a growth that is not positive, or not finite.
  template <class K, int D>
  requires(!std::is_arithmetic_v<Bulk> ||
           (grows &&
            !std::is_arithmetic_v<Growth>)) void check_parameters(const BlockOfParticles<K, D>& particles) const {
    detail::require_values<K, D>(particles, Lanes<K>(detail::value_at(bulk, particles)),
                                 "bulk modulus of mean_dilatation", "Pa");
    if constexpr (grows)
      detail::require_values<K, D>(particles, Lanes<K>(grown(particles)), "growth of mean_dilatation", "times", true);
  }
};

/// A bulk modulus in Pa, divided between the law of the particles and `mean_dilatation`.
template <class P>
struct SplitBulkModulus {
  P law, mean;
};

/// Gives the law twice `shear_modulus` (Pa), i.e. Poisson's ratio 0.29, and the rest of `bulk_modulus` (Pa) to the mean
/// dilatation. With more in the law, sheets of two particles are too stiff; with less, those of three and more are too
/// soft; docs/theory.md has the table. Throws `InputError` for moduli that are not positive, and for a bulk modulus
/// below 2/3 of the shear modulus, with which Poisson's ratio would be negative, as when the two are interchanged. Laws
/// accept ratios from -1/2 on, but with a negative one nothing locks and there is nothing to divide.
template <class P>
[[nodiscard]] SplitBulkModulus<P> split_bulk_modulus(P bulk_modulus, P shear_modulus) {
  static_assert(detail::RequireReal<P>::value);
  detail::require(detail::is_finite(bulk_modulus) && bulk_modulus > 0, "hmps: the bulk modulus to be split is ",
                  bulk_modulus, " Pa; it must be positive");
  detail::require(detail::is_finite(shear_modulus) && shear_modulus > 0,
                  "hmps: the shear modulus given with the bulk modulus to be split is ", shear_modulus,
                  " Pa; it must be positive");
  // Rounding may turn a Poisson's ratio of zero into a negative one.
  detail::require(P(3) * bulk_modulus >= P(2) * shear_modulus * (P(1) - P(16) * std::numeric_limits<P>::epsilon()),
                  "hmps: the bulk modulus to be split is ", bulk_modulus, " Pa beside a shear modulus of ",
                  shear_modulus, " Pa, so that Poisson's ratio is negative; give the bulk modulus first");
  const P law = std::min(bulk_modulus, 2 * shear_modulus);
  return {law, bulk_modulus - law};
}

/// The mean dilatation as a term of `internal_force`, with the bulk modulus `bulk` in Pa: a number, a view or a
/// callable. Throws `InputError` for a number that is negative or not finite. `internal_force` does the same for
/// views and callables, with the values that they have when it is made. `mean_dilatation<2>(bulk)` takes the mean
/// twice, which costs two more sweeps with one number per bond. All terms of the mean dilatation in a force must take
/// it equally often.
template <int Means = 1, class Bulk>
[[nodiscard]] MeanDilatation<Bulk, Means> mean_dilatation(Bulk bulk) {
  if constexpr (std::is_arithmetic_v<Bulk>)
    detail::require(detail::is_finite(bulk) && bulk >= 0, "hmps: the bulk modulus of mean_dilatation is ", bulk,
                    " Pa; it must not be negative");
  return {std::move(bulk)};
}
/// The same for tissue that grows. `growth` is the ratio G of the volumes after and before growth, 1 without growth: a
/// number, a view or a callable, for growth tensors F_g per particle
///
///     mean_dilatation(bulk, [&](const auto& at) { return determinant(at(matrices(growth))); })
///
/// Views are read at each evaluation, so that growth may proceed. Throws `InputError` for a growth that is not positive
/// or not finite, as for bulk moduli. A force with such a term may hold no other term of the mean dilatation.
template <int Means = 1, class Bulk, class Growth>
[[nodiscard]] MeanDilatation<Bulk, Means, Growth> mean_dilatation(Bulk bulk, Growth growth) {
  if constexpr (std::is_arithmetic_v<Growth>)
    detail::require(detail::is_finite(growth) && growth > 0, "hmps: the growth of mean_dilatation is ", growth,
                    " times the volume; it must be positive, 1 without growth");
  return {mean_dilatation<Means>(std::move(bulk)).bulk, std::move(growth)};
}

namespace detail {

/// The sum of `values` over each particle of `block` and its bonded neighbours.
template <class B, class K = typename B::Scalar>
[[nodiscard]] HMPS_INLINE Lanes<K> sum_over_neighbourhood(const B& bonds, std::size_t block,
                                                          const typename B::template Slots<1>& values) {
  using T = Lanes<K>;
  T sum = values.lanes(0, block * B::width);
  bonds.for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
    sum += select(bond.weight() > K(0), bond.gather(values)[0], T(0));
  });
  return sum;
}

/// The d of `MeanDilatation` for every slot of `bonds`: d_i sum_k v_k d_k = 1, where v = V / l0^D.
template <class B, class K = typename B::Scalar>
[[nodiscard]] typename B::template Slots<1> neighbourhood_scales(const B& bonds) {
  using T = Lanes<K>;
  // An iteration reduces the error to about two thirds, in boxes, sheets, bars and clouds: 25 iterations for float, 70
  // for double.
  constexpr int most_iterations = 100;
  typename B::template Slots<1> scales(bonds.slot_count()), carried(scales), next(scales);  // d, v d, d
  for (std::size_t slot = 0; slot < bonds.slot_count(); ++slot) scales(0, slot) = K(1);
  K error = 0;
  for (int iteration = 0; iteration < most_iterations; ++iteration) {
    error = 0;
    for (std::size_t block = 0; block < bonds.block_count(); ++block) {
      const std::size_t slot = block * B::width;
      carried.store(0, slot, volume_share_lanes(bonds, block) * scales.lanes(0, slot));
    }
    for (std::size_t block = 0; block < bonds.block_count(); ++block) {
      const std::size_t slot = block * B::width;
      const T own = scales.lanes(0, slot), sum = sum_over_neighbourhood(bonds, block, carried), mean = own * sum;
      next.store(0, slot, sqrt(own / sum));
      for (int l = 0; l < T::width; ++l) error = std::max(error, std::abs(mean.lane[l] - K(1)));
    }
    if (error < 16 * std::numeric_limits<K>::epsilon()) break;
    std::swap(scales, next);
  }
  constexpr K most = K(1e-4);  // well above rounding, and far below other errors of the method
  require(error < most, "hmps: after ", most_iterations,
          " iterations the shares of a mean dilatation sum to 1 only within ", error,
          "; find_weak names particles with few bonds: leave them out, or bond them to more neighbours");
  return scales;
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
