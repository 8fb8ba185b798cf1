// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <tuple>
#include <vector>

#include "hmps/bonds/bonds.hpp"
#include "hmps/core/abi.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/core/math.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/diagnostics/detail/recorded.hpp"
#include "hmps/force/force_energy.hpp"
#include "hmps/lanes/detail/staging.hpp"
#include "hmps/laws/law.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/mean_dilatation.hpp"

/// Energies of a body in J (in two dimensions per metre of thickness), summed in double and in an order that does not
/// depend on the executor. `volume` is the volume of a particle in the reference configuration, l0^D on a lattice.
/// Without viscosity, contact and forced displacements, the scheme conserves kinetic + strain + artificial energy.
/// `InternalForce::energy` returns the energies of all its terms. All of them throw `InputError` for views of the wrong
/// size, for volumes, densities and moduli that are not positive (of each particle too, if the law is a callable), and
/// for volumes other than those that the bonds were made with, if they were given any.
namespace hmps::inline HMPS_ABI {

/// Kinetic energy, sum of m |v|^2 / 2 with m = density * volume.
///
/// @param v        velocities in m/s
/// @param density  in kg/m3, a number or a `ScalarView`
/// @param volume   in m^D, a number or a `ScalarView`
template <class T, int D, PerParticle Rho, PerParticle Vol, Executor E = Serial>
[[nodiscard]] double kinetic_energy(const VectorView<T, D>& v, const Rho& density, const Vol& volume,
                                    const E& execute = {}) {
  require_view(v, "velocities");
  require_positive(density, v.size(), "density", "kg/m3");
  require_positive(volume, v.size(), "volume", detail::unit_of_volume<D>());
  return reduce(
      v.size(), 0.0,
      [&](std::size_t i) {
        const double mass = static_cast<double>(at_particle(density, i)) * static_cast<double>(at_particle(volume, i));
        return 0.5 * mass * v[i].template cast<double>().squaredNorm();
      },
      std::plus<>{}, execute);
}

/// Elastic strain energy, sum of V W(F) (\paper{6}, and \paper{15} for the Mooney-Rivlin law).
///
/// @param F         deformation gradients, \paper{11}
/// @param material  a law with an energy, or a callable of `OneParticle` that returns the law of each particle
/// @param volume    in m^D, a number or a `ScalarView`
template <class T, int D, class Material, PerParticle Vol, Executor E = Serial>
[[nodiscard]] double strain_energy(const MatrixView<T, D>& F, const Material& material, const Vol& volume,
                                   const E& execute = {}) {
  detail::require_recorded(F);
  detail::require_material(material, F.size());
  require_positive(volume, F.size(), "volume", detail::unit_of_volume<D>());
  return reduce(
      F.size(), 0.0,
      [&](std::size_t i) {
        const Matrix<double, D> gradient = F[i].template cast<double>();
        return static_cast<double>(at_particle(volume, i)) *
               energy_density(detail::value_at(material, OneParticle{i}), gradient);
      },
      std::plus<>{}, execute);
}

namespace detail {
/// sum_j |r_ij - F_i r0_ij|^2 w_ij in m2, \paper{9}, for the particles of one block, computed from the displacements u:
/// the residual of a bond is u_j - u_i - (F_i - 1) r0_ij.
template <Bonds B, class T, class K = typename B::Scalar, int D = B::dimension>
[[nodiscard]] HMPS_INLINE Lanes<K> misfit_lanes(const B& bonds, std::size_t block,
                                                const typename B::template Slots<std::size_t{D}>& displacement,
                                                const MatrixView<T, D>& F) {
  const std::size_t slot = block * B::width;
  Vector<Lanes<K>, D> u;
  Matrix<Lanes<K>, D> strain;
  for (int d = 0; d < D; ++d) u[d] = displacement.lanes(static_cast<std::size_t>(d), slot);
  for (int k = 0; k < D * D; ++k) {
    strain(k % D, k / D) = Lanes<K>(0);
    for (std::size_t l = 0; l < B::width; ++l)
      if (const Index i = bonds.particle(slot + l); i != B::none)
        strain(k % D, k / D).lane[l] =
            static_cast<K>(static_cast<double>(F(i, k)) - static_cast<double>(k % D == k / D));
  }
  Lanes<K> sum(0);
  bonds.for_each_row(block, [&](const auto& bond) HMPS_INLINE_LAMBDA {
    const auto neighbour = bond.gather(displacement);
    Lanes<K> squares(0);
    for (int row = 0; row < D; ++row) {
      Lanes<K> misfit = neighbour[static_cast<std::size_t>(row)] - u[row];
      for (int col = 0; col < D; ++col)
        if (bond.along(col)) misfit = misfit - strain(row, col) * bond.offset(col);
      squares += misfit * misfit;
    }
    sum += bond.weight() * squares;
  });
  return sum;
}
}  // namespace detail

/// Energy of Kondo's stabiliser, from which \paper{19} derives: the sum of V C_i / 2 sum_j |r_ij - F_i r0_ij|^2 w_ij
/// with C_i from \paper{20}. The residuals are taken in the scalar type of the bonds, as in the force. Compared with
/// the strain energy, it shows how much of the motion the deformation gradients do not resolve.
///
/// @param bonds    `BondList` or `LatticeBonds` of the body
/// @param x        positions in m
/// @param F        deformation gradients at these positions
/// @param modulus  E_hat in Pa: a number, a `ScalarView`, or a callable of `OneParticle`
/// @param volume   in m^D, a number or a `ScalarView`
template <class B, class X, class T, int D, class Modulus, PerParticle Vol, Executor E = Serial>
[[nodiscard]] double artificial_energy(const B& bonds, const VectorView<X, D>& x, const MatrixView<T, D>& F,
                                       const Modulus& modulus, const Vol& volume, const E& execute = {}) {
  require_size(x, bonds.size(), "positions");
  require_size(F, bonds.size(), "deformation gradients");
  detail::require_recorded(F);
  require_positive(volume, bonds.size(), "volume", detail::unit_of_volume<D>());
  detail::require_volumes_of(bonds, volume);
  detail::require_not_negative(modulus, bonds.size(), "modulus of the stabiliser", "Pa");
  using K = typename B::Scalar;
  typename B::template Slots<std::size_t{D}> displacement(bonds.slot_count());
  const auto common = detail::common_displacement(bonds, x);
  detail::guarded(execute)(bonds.block_count(), [&](std::size_t block) {
    detail::stage_displacement(bonds, block, x, common, displacement);
  });
  std::vector<double> error(bonds.size());
  detail::guarded(execute)(bonds.block_count(), [&](std::size_t block) {
    const Lanes<K> squares = detail::misfit_lanes(bonds, block, displacement, F);
    detail::deliver(bonds, block, View<double, 1>({error.data()}, error.size(), sizeof(double)),
                    [&](int) { return squares; });
  });
  return reduce(
      bonds.size(), 0.0,
      [&](std::size_t i) {
        const double stiffness = artificial_coefficient(static_cast<double>(at_particle(modulus, i)), D,
                                                        1.0 / static_cast<double>(bonds.shape_trace(i)));
        return static_cast<double>(at_particle(volume, i)) * stiffness * 0.5 * error[i];
      },
      std::plus<>{}, execute);
}

/// Energy of `mean_dilatation`, sum of V K theta_i^2 / 2; of `mean_dilatation<2>`, `mean_dilatation_energy<2>`. That of
/// tissue that grows is in `InternalForce::energy`.
///
/// @param bonds   `BondList` or `LatticeBonds` of the body
/// @param F       deformation gradients, \paper{11}
/// @param bulk    K in Pa: a number, a `ScalarView`, or a callable of `OneParticle`
/// @param volume  in m^D, a number or a `ScalarView`
template <int Means = 1, class B, class T, int D, class Bulk, PerParticle Vol, Executor E = Serial>
[[nodiscard]] double mean_dilatation_energy(const B& bonds, const MatrixView<T, D>& F, const Bulk& bulk,
                                            const Vol& volume, const E& execute = {}) {
  static_assert(Means == 1 || Means == 2, "hmps: the mean of the dilatation is taken once or twice");
  require_size(F, bonds.size(), "deformation gradients");
  detail::require_recorded(F);
  require_positive(volume, bonds.size(), "volume", detail::unit_of_volume<D>());
  detail::require_volumes_of(bonds, volume);
  const auto scales = detail::neighbourhood_scales(bonds);
  detail::require_not_negative(bulk, bonds.size(), "bulk modulus of mean_dilatation_energy", "Pa");
  const auto theta = detail::mean_dilatations(bonds, std::tuple<>{}, F, scales, Means, execute);
  return reduce(
      bonds.size(), 0.0,
      [&](std::size_t i) {
        return static_cast<double>(at_particle(volume, i)) * static_cast<double>(at_particle(bulk, i)) * 0.5 *
               theta[i] * theta[i];
      },
      std::plus<>{}, execute);
}

}  // namespace hmps::inline HMPS_ABI
