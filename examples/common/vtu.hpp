// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <hmps/core/view.hpp>
#include <hmps/output/pvd_text.hpp>
#include <hmps/output/vtk_field.hpp>
#include <hmps/output/vtu_file.hpp>
#include "csv_writer.hpp"
#include "files.hpp"

namespace examples {

/// A field of the library, made from vectors of values.
struct Field : hmps::VtkField {
  /// Values of `T`, the type that VTK calls `type`.
  template <class T>
  static Field of(std::string name, int components, const char* type, const std::vector<T>& values) {
    Field field{{std::move(name), components, type, std::string(values.size() * sizeof(T), '\0')}};
    if (!values.empty()) std::memcpy(field.bytes.data(), values.data(), field.bytes.size());
    return field;
  }
};

/// A field of integers, such as the organ of each particle.
template <class Range>
[[nodiscard]] Field whole_numbers(std::string name, const Range& range) {
  std::vector<std::int32_t> values;
  for (const auto& value : range) values.push_back(static_cast<std::int32_t>(value));
  return Field::of(std::move(name), 1, "Int32", values);
}

/// A field in single precision, which is enough for display, from a view of any scalar.
template <class T, int N>
[[nodiscard]] Field numbers(std::string name, const hmps::View<T, N>& view) {
  std::vector<float> values;
  values.reserve(view.size() * N);
  for (std::size_t i = 0; i < view.size(); ++i)
    for (int c = 0; c < N; ++c) values.push_back(static_cast<float>(view(i, c)));
  return Field::of(std::move(name), N, "Float32", values);
}

/// A cloud of particles, or a surface if there are triangles, as the bytes of a VTK file, see `hmps::vtu_text`.
[[nodiscard]] inline std::string vtu(const Field& positions, std::span<const Field> fields, double time,
                                     std::span<const std::array<hmps::Index, 3>> triangles = {}) {
  return hmps::vtu_text(positions, std::vector<hmps::VtkField>(fields.begin(), fields.end()),
                        {.time = time, .triangles = triangles});
}

/// The text of a ParaView collection (.pvd) that lists `frames`: time in s, file name.
[[nodiscard]] inline std::string pvd(std::span<const std::pair<double, std::string>> frames) {
  return hmps::pvd_text(frames);
}

}  // namespace examples
