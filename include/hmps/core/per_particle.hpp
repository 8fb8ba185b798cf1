// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/finite.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
template <class T>
struct IsScalarView : std::false_type {};
template <class T>
struct IsScalarView<ScalarView<T>> : std::true_type {};
}  // namespace detail

/// A quantity, such as density or volume, that is one number for all particles or a `ScalarView` with one per particle.
template <class Q>
concept PerParticle = std::is_arithmetic_v<Q> || detail::IsScalarView<Q>::value;

/// The value of `quantity` at particle `i`.
template <PerParticle Q>
[[nodiscard]] auto at_particle(const Q& quantity, std::size_t i) {
  if constexpr (std::is_arithmetic_v<Q>) {
    (void)i;
    return quantity;
  } else {
    return static_cast<typename Q::Scalar>(quantity[i]);
  }
}

/// Throws `InputError` unless the quantity is positive and finite at each of the `size` particles; the message calls it
/// `name`, in `unit`.
template <PerParticle Q>
void require_positive(const Q& quantity, std::size_t size, const char* name, const char* unit) {
  if constexpr (std::is_arithmetic_v<Q>) {
    require(detail::is_finite(quantity) && quantity > Q(0), "hmps: the ", name, " is ", quantity, " ", unit,
            "; it must be positive and finite");
  } else {
    require_size(quantity, size, name);
    for (std::size_t i = 0; i < size; ++i) {
      const double value = static_cast<double>(quantity[i]);
      require(detail::is_finite(value) && value > 0, "hmps: the ", name, " of particle ", i, " is ", value, " ", unit,
              "; it must be positive and finite");
    }
  }
}

}  // namespace hmps::inline HMPS_ABI
