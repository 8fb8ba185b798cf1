// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/particle_set.hpp"
#include "hmps/core/view.hpp"

namespace hmps::inline HMPS_ABI {

/// A named field of a VTK file: one number, vector or tensor per particle. Holds a copy of the numbers; `vtk_field`
/// makes it.
struct VtkField {
  std::string name;              ///< as ParaView shows it
  int components = 1;            ///< 1, 3 or 9
  std::string type = "Float32";  ///< VTK's name: Float32, Float64, Int32 or UInt8
  std::string bytes;             ///< the numbers, particle after particle, in the byte order of this machine

  /// Number of bytes per number.
  [[nodiscard]] std::size_t width() const { return type == "Float64" ? 8 : type == "UInt8" ? 1 : 4; }
  /// The number of particles.
  [[nodiscard]] std::size_t size() const {
    return components > 0 ? bytes.size() / (width() * static_cast<std::size_t>(components)) : 0;
  }
};

namespace detail {

template <class T>
constexpr const char* vtk_type = std::is_same_v<T, float>          ? "Float32"
                                 : std::is_same_v<T, double>       ? "Float64"
                                 : std::is_same_v<T, std::int32_t> ? "Int32"
                                                                   : "UInt8";

template <class T>
[[nodiscard]] VtkField as_field(std::string name, int components, const std::vector<T>& values) {
  static_assert(std::is_same_v<T, float> || std::is_same_v<T, double> || std::is_same_v<T, std::int32_t> ||
                    std::is_same_v<T, std::uint8_t>,
                "hmps: VTK files hold float, double, std::int32_t or std::uint8_t");
  VtkField field{std::move(name), components, vtk_type<T>, std::string(values.size() * sizeof(T), '\0')};
  if (!values.empty()) std::memcpy(field.bytes.data(), values.data(), field.bytes.size());
  return field;
}

/// A field of `components` numbers per particle; `at(i, c)` returns number c of particle i. Throws `InputError` for a
/// finite number that would be infinite as a `T`.
template <class T, class At>
[[nodiscard]] VtkField collect(std::string name, std::size_t size, int components, const At& at) {
  std::vector<T> values;
  values.reserve(size * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < size; ++i)
    for (int c = 0; c < components; ++c) {
      const auto value = at(i, c);
      if constexpr (std::is_floating_point_v<T> && sizeof(value) > sizeof(T))
        require(!is_finite(value) || is_finite(static_cast<T>(value)), "hmps: the field ", name, " is ", value,
                " at particle ", i, ", which does not fit single precision; use vtk_field<double>");
      values.push_back(static_cast<T>(value));
    }
  return as_field(std::move(name), components, values);
}

}  // namespace detail

/// A number per particle as a field called `name`: `vtk_field("J", scalars(j))`. Floating-point numbers are written as
/// `Real`; single precision is enough for display, `vtk_field<double>(...)` keeps all digits. Integers, such as the
/// organ of each particle, are written in 32 bits. NaN and infinity are written as they are, so that a run that has
/// become unstable can be displayed. Throws `InputError` for a number that does not fit, and for a view of null.
template <class Real = float, class T>
[[nodiscard]] VtkField vtk_field(std::string name, const ScalarView<T>& view) {
  require_view(view, name.c_str());
  if constexpr (std::is_integral_v<std::remove_const_t<T>>) {
    for (std::size_t i = 0; i < view.size(); ++i)
      detail::require(
          std::in_range<std::int32_t>(static_cast<std::int64_t>(view[i])) && std::in_range<std::int64_t>(+view[i]),
          "hmps: the field ", name, " is ", +view[i], " at particle ", i,
          ", which does not fit 32 bits; give it as a floating-point number");
    return detail::collect<std::int32_t>(std::move(name), view.size(), 1, [&](std::size_t i, int) { return view[i]; });
  } else {
    return detail::collect<Real>(std::move(name), view.size(), 1, [&](std::size_t i, int) { return view[i]; });
  }
}

/// A set of particles as a field called `name`, 1 for those in it and 0 for the others: `vtk_field("held", base)`.
[[nodiscard]] inline VtkField vtk_field(std::string name, const ParticleSet& set) {
  return detail::collect<std::uint8_t>(std::move(name), set.scene_size(), 1,
                                       [&](std::size_t i, int) { return set(i); });
}

/// A vector per particle as a field called `name`: `vtk_field("velocity", vectors(v))`. In two dimensions the third
/// component is zero.
template <class Real = float, class T, int D>
[[nodiscard]] VtkField vtk_field(std::string name, const VectorView<T, D>& view) {
  require_view(view, name.c_str());
  return detail::collect<Real>(std::move(name), view.size(), 3,
                               [&](std::size_t i, int c) { return c < D ? view(i, c) : T(0); });
}

/// A tensor per particle as a field of nine numbers called `name`, row by row, as ParaView's Tensor Glyph and
/// calculator expect them: `vtk_field("Cauchy stress", matrices(sigma))`. A tensor in the plane has four, which
/// ParaView shows but does not take for a tensor: its component across the plane is not among them, and a determinant,
/// a trace or a von Mises stress that assumed one would be wrong. For nine, see `plane_strain` and `cauchy_stresses`.
template <class Real = float, class T, int D>
[[nodiscard]] VtkField vtk_field(std::string name, const MatrixView<T, D>& view) {
  require_view(view, name.c_str());
  return detail::collect<Real>(std::move(name), view.size(), D * D,
                               [&](std::size_t i, int c) { return view(i, c / D + D * (c % D)); });
}

}  // namespace hmps::inline HMPS_ABI
