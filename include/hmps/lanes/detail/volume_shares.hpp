// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/cell_volume.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/per_particle.hpp"
#include "hmps/core/view.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// V / l0^D of each of `size` particles. Throws `InputError` for a view of another size, a volume that is not positive
/// and finite, and volumes that do not fit the spacing `l0` (m).
template <int D, class V>
[[nodiscard]] std::vector<double> volume_shares(const ScalarView<V>& volumes, std::size_t size, double l0) {
  require_size(volumes, size, "volumes");
  require_positive(volumes, size, "volume", unit_of_volume<D>());
  const double cell = std::pow(l0, D);
  std::vector<double> shares(size);
  double sum = 0;
  for (std::size_t i = 0; i < size; ++i) sum += shares[i] = static_cast<double>(volumes[i]) / cell;
  const double mean = size > 0 ? sum / static_cast<double>(size) : 1;
  require_cell_volume<D>(mean * cell, l0, volume_factor_of_spacing, "the mean volume of the particles", "the spacing");
  constexpr double largest = 64;
  for (std::size_t i = 0; i < size; ++i)
    require(shares[i] < largest, "hmps: the volume of particle ", i, " is ", volumes[i], " m", D, ", ", shares[i],
            " times the cube of the spacing of ", l0, " m; give the volume of each single particle");
  return shares;
}

/// V / l0^D of the particles by slot of the bonds; stores nothing if no volumes were given.
template <class K>
class VolumeShares {
 public:
  VolumeShares() = default;
  template <int D>
  VolumeShares(const std::vector<double>& of_particle, const Blocks<K, D>& blocks)
      : shares_(blocks.block_count(), Lanes<K>(K(1))) {
    for (std::size_t i = 0; i < of_particle.size(); ++i) {
      const std::size_t slot = blocks.slot(i);
      shares_[slot / width].lane[slot % width] = static_cast<K>(of_particle[i]);
    }
  }

  [[nodiscard]] double of(std::size_t slot) const {
    return shares_.empty() ? 1.0 : static_cast<double>(shares_[slot / width].lane[slot % width]);
  }
  [[nodiscard]] HMPS_INLINE Lanes<K> lanes(std::size_t block) const {
    return shares_.empty() ? Lanes<K>(K(1)) : shares_[block];
  }
  [[nodiscard]] std::size_t bytes() const { return shares_.size() * sizeof(Lanes<K>); }

 private:
  static constexpr std::size_t width = Lanes<K>::width;
  std::vector<Lanes<K>> shares_;
};

/// V / l0^D of the particles of a block; 1 for bonds without volumes.
template <class B>
[[nodiscard]] HMPS_INLINE Lanes<typename B::Scalar> volume_share_lanes(const B& bonds, std::size_t block) {
  using T = Lanes<typename B::Scalar>;
  if constexpr (requires { T(bonds.volume_share_lanes(block)); })
    return bonds.volume_share_lanes(block);
  else
    return T(typename B::Scalar(1));
}
/// The same for one particle.
template <class B>
[[nodiscard]] double volume_share(const B& bonds, std::size_t i) {
  if constexpr (requires { double(bonds.volume_share(i)); })
    return bonds.volume_share(i);
  else
    return 1;
}

/// Throws `InputError` if `bonds` were given the volumes of their particles and `volume` (m^D), a `PerParticle`, is not
/// proportional to them: an energy would not be that of the force. Rounding is tolerated.
template <class B, class Vol>
void require_volumes_of(const B& bonds, const Vol& volume) {
  if constexpr (requires { bool(bonds.knows_volumes()); }) {
    const std::size_t n = bonds.size();
    if (n == 0 || !bonds.knows_volumes()) return;
    double shares = 0;
    for (std::size_t i = 0; i < n; ++i) shares += bonds.volume_share(i);
    const double cell = mean_of(volume, n) * static_cast<double>(n) / shares;
    for (std::size_t i = 0; i < n; ++i) {
      const double given = static_cast<double>(at_particle(volume, i)), own = cell * bonds.volume_share(i);
      require(std::abs(given - own) <= 1e-3 * own, "hmps: the volume of particle ", i, " is ", given, " m",
              B::dimension, ", but the volumes that its bonds were made with give it ", own, " m", B::dimension,
              "; pass the same volumes, one for each particle");
    }
  }
}

}  // namespace hmps::inline HMPS_ABI::detail
