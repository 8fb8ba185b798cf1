// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/lanes/blocks.hpp"
#include "hmps/lanes/detail/registers.hpp"
#include "hmps/lanes/detail/slots.hpp"
#include "hmps/lanes/lanes.hpp"

namespace hmps::inline HMPS_ABI::detail {

/// Reference positions from which the sweeps compute r0 of a bond. The result is antisymmetric in the two ends and
/// correct to the rounding of `K`, however large the body. In double, the positions themselves are stored. In float,
/// each position is rounded to an integer multiple of 2^-30 of the bond radius (rounded up to a power of two), and the
/// lowest 32 bits of that integer are stored: differences shorter than that radius are exact.
template <class K, int D>
class Places {
  static constexpr bool fixed = std::is_same_v<K, float>;

 public:
  Places() = default;
  /// Stores the reference positions of `blocks` for bonds up to `radius` (m).
  Places(const Blocks<K, D>& blocks, double radius) {
    if constexpr (fixed) {
      const double unit = std::ldexp(1.0, std::ilogb(radius) - 29);
      unit_ = static_cast<K>(unit);
      positions_ = SlotArrays<K, std::size_t{D}>(blocks.slot_count());
      for (int c = 0; c < D; ++c)
        for (std::size_t s = 0; s < blocks.slot_count(); ++s) {
          const double place = std::remainder(std::nearbyint(blocks.reference_slots(c)[s] / unit), 0x1p32);
          const auto bits = static_cast<std::uint32_t>(static_cast<std::int64_t>(place));
          std::memcpy(&positions_(static_cast<std::size_t>(c), s), &bits, sizeof(bits));
        }
    }
  }

  /// Component `c` of the positions, from slot 0, with the same margin as `SlotArrays`.
  [[nodiscard]] HMPS_INLINE const K* slots(const Blocks<K, D>& blocks, int c) const {
    if constexpr (fixed)
      return &positions_(static_cast<std::size_t>(c), 0);
    else
      return blocks.reference_slots(c);
  }
  /// One component of r0 (m), from the stored positions of the neighbour and of the particle itself.
  [[nodiscard]] HMPS_INLINE K offset(K neighbour, K own) const {
    if constexpr (fixed) {
      std::uint32_t a, b;
      std::memcpy(&a, &neighbour, sizeof(a));
      std::memcpy(&b, &own, sizeof(b));
      return static_cast<K>(static_cast<std::int32_t>(a - b)) * unit_;
    } else {
      return neighbour - own;
    }
  }
  [[nodiscard]] HMPS_INLINE Lanes<K> offset(const Lanes<K>& neighbour, const Lanes<K>& own) const {
    if constexpr (fixed) {
      Lanes<K> r0;
#if defined(__GNUC__) || defined(__clang__)
      using Vector = typename Register<K>::Vector;
      using Signed = typename Register<K>::Mask;
      typedef std::uint32_t Unsigned __attribute__((vector_size(sizeof(Signed))));
#pragma GCC unroll 4
      for (int l = 0; l < Lanes<K>::width; l += Register<K>::width) {
        Unsigned a, b;
        __builtin_memcpy(&a, neighbour.lane + l, sizeof(a));
        __builtin_memcpy(&b, own.lane + l, sizeof(b));
        const Vector x = __builtin_convertvector(reinterpret_cast<Signed>(a - b), Vector) * unit_;
        __builtin_memcpy(r0.lane + l, &x, sizeof(x));
      }
#else
      for (int l = 0; l < Lanes<K>::width; ++l) r0.lane[l] = offset(neighbour.lane[l], own.lane[l]);
#endif
      return r0;
    } else {
      return neighbour - own;
    }
  }

  [[nodiscard]] std::size_t bytes() const { return positions_.bytes(); }

 private:
  SlotArrays<K, std::size_t{fixed ? D : 0}> positions_;
  K unit_ = 0;
};

}  // namespace hmps::inline HMPS_ABI::detail
