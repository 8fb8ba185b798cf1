// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <concepts>
#include <cstddef>
#include <string>
#include <type_traits>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/inline.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {
template <class T>
struct IsScalarView : std::false_type {};
template <class T>
struct IsScalarView<ScalarView<T>> : std::true_type {};
}  // namespace detail

/// One particle, as the argument of callables outside the sweeps: `at(view)` is the parameter of the particle. Thus the
/// same `[&](const auto& at) { return MooneyRivlin{at(c1), at(c2), at(d1)}; }` serves force and energy.
struct OneParticle {
  std::size_t index;

  /// A parameter of the particle. Throws `InputError` if the view ends before it.
  template <class P>
  [[nodiscard]] auto operator()(const ScalarView<P>& parameter) const {
    detail::require(index < parameter.size(), "hmps: the view of parameters holds ", parameter.size(),
                    " particles, but particle ", index, " needs a parameter too; give one for each");
    return static_cast<double>(parameter[index]);
  }
  /// A vector of the particle, such as the direction of its fibres. Throws `InputError` if the view ends before it.
  template <class P, int D>
  [[nodiscard]] Vector<double, D> operator()(const VectorView<P, D>& parameter) const {
    detail::require(index < parameter.size(), "hmps: the view of vectors holds ", parameter.size(),
                    " particles, but particle ", index, " needs a vector too; give one for each");
    return parameter[index].template cast<double>();
  }
  /// A tensor of the particle, such as that of its growth. Throws `InputError` if the view ends before it.
  template <class P, int D>
  [[nodiscard]] Matrix<double, D> operator()(const MatrixView<P, D>& parameter) const {
    detail::require(index < parameter.size(), "hmps: the view of tensors holds ", parameter.size(),
                    " particles, but particle ", index, " needs a tensor too; give one for each");
    return parameter[index].template cast<double>();
  }
  /// A parameter of the particle's body: `table[body[i]]`. Throws `InputError` for a body that is not in the table.
  template <class P, class B>
  [[nodiscard]] auto operator()(const ScalarView<P>& table, const ScalarView<B>& body) const {
    detail::require(index < body.size(), "hmps: the view of bodies holds ", body.size(), " particles, but particle ",
                    index, " needs a body too; give one for each");
    const auto b = static_cast<std::size_t>(body[index]);
    detail::require(b < table.size(), "hmps: particle ", index, " belongs to body ", +body[index],
                    " but the table of parameters has ", table.size(), " bodies; indices start at 0");
    return static_cast<double>(table[b]);
  }
};

/// A quantity such as density, volume or viscosity: one number for all particles, a `ScalarView` with one per particle,
/// or a callable that computes it from parameters, `[&](const auto& at) { return factor * at(density); }`.
template <class Q>
concept PerParticle = std::is_arithmetic_v<Q> || detail::IsScalarView<Q>::value || requires(const Q& quantity) {
  { quantity(OneParticle{}) } -> std::convertible_to<double>;
};

namespace detail {

/// The value of `quantity` for `at`, which is one particle or a block. Handles numbers, views and callables for the
/// whole library.
template <class Q, class At>
[[nodiscard]] HMPS_INLINE decltype(auto) value_at(const Q& quantity, const At& at) {
  if constexpr (IsScalarView<Q>::value)
    return at(quantity);
  else if constexpr (std::invocable<const Q&, const At&>)
    return quantity(at);
  else
    return quantity;
}

/// Throws `InputError` if `quantity`, called `name`, is a view of a size other than `size`.
template <class Q>
void require_quantity(const Q& quantity, std::size_t size, const char* name) {
  if constexpr (IsScalarView<Q>::value) require_size(quantity, size, name);
}

}  // namespace detail

/// The value of `quantity` at particle `i`.
template <PerParticle Q>
[[nodiscard]] auto at_particle(const Q& quantity, std::size_t i) {
  if constexpr (detail::IsScalarView<Q>::value)
    return static_cast<typename Q::Scalar>(quantity[i]);
  else
    return detail::value_at(quantity, OneParticle{i});
}

namespace detail {
/// The unit of volumes in `D` dimensions, for messages.
template <int D>
[[nodiscard]] constexpr const char* unit_of_volume() {
  return D == 3 ? "m3" : "m2";
}
}  // namespace detail

/// Throws `InputError` unless the quantity is positive and finite at each of the `size` particles; the message calls it
/// `name`, in `unit`.
template <PerParticle Q>
void require_positive(const Q& quantity, std::size_t size, const char* name, const char* unit) {
  if constexpr (std::is_arithmetic_v<Q>) {
    detail::require(detail::is_finite(quantity) && quantity > Q(0), "hmps: the ", name, " is ", quantity, " ", unit,
                    "; it must be positive and finite");
  } else {
    detail::require_quantity(quantity, size, name);
    for (std::size_t i = 0; i < size; ++i) {
      const auto value = static_cast<double>(at_particle(quantity, i));
      detail::require(detail::is_finite(value) && value > 0, "hmps: the ", name, " of particle ", i, " is ", value, " ",
                      unit, "; it must be positive and finite");
    }
  }
}

namespace detail {

/// Throws `InputError` unless the quantity is finite and not negative at each of the `size` particles; the message
/// calls it `name`, in `unit`.
template <class Q>
void require_not_negative(const Q& quantity, std::size_t size, const char* name, const char* unit) {
  require_quantity(quantity, size, name);
  for (std::size_t i = 0; i < (std::is_arithmetic_v<Q> ? 1 : size); ++i) {
    const auto value = static_cast<double>(at_particle(quantity, i));
    require(is_finite(value) && value >= 0, "hmps: the ", name, std::is_arithmetic_v<Q> ? "" : " of particle ",
            std::is_arithmetic_v<Q> ? std::string() : std::to_string(i), " is ", value, " ", unit,
            "; it must be finite and not negative");
  }
}

/// The mean of `quantity` over `size` particles.
template <class Q>
[[nodiscard]] double mean_of(const Q& quantity, std::size_t size) {
  if constexpr (std::is_arithmetic_v<Q>) {
    return static_cast<double>(quantity);
  } else {
    double sum = 0;
    for (std::size_t i = 0; i < size; ++i) sum += static_cast<double>(at_particle(quantity, i));
    return sum / static_cast<double>(size);
  }
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
