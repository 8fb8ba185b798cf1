// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <hmps/core/view.hpp>
#include "csv_writer.hpp"
#include "files.hpp"

namespace examples {

/// One number or vector per particle of a frame, with its name in ParaView.
struct Field {
  std::string name;
  int components = 1;
  std::string type = "Float32";  ///< of VTK: Float32, Float64, Int32, UInt8
  std::string bytes;             ///< the values, particle after particle

  /// Values of `T`, the type that VTK calls `type`.
  template <class T>
  static Field of(std::string name, int components, const char* type, const std::vector<T>& values) {
    Field field{std::move(name), components, type, std::string(values.size() * sizeof(T), '\0')};
    if (!values.empty()) std::memcpy(field.bytes.data(), values.data(), field.bytes.size());
    return field;
  }
};

/// A field of whole numbers, such as the organ of each particle.
template <class Range>
[[nodiscard]] Field whole_numbers(std::string name, const Range& range) {
  std::vector<std::int32_t> values;
  for (const auto& value : range) values.push_back(static_cast<std::int32_t>(value));
  return Field::of(std::move(name), 1, "Int32", values);
}

/// A field of single precision, which is enough to look at, from a view of any scalar.
template <class T, int N>
[[nodiscard]] Field numbers(std::string name, const hmps::View<T, N>& view) {
  std::vector<float> values;
  values.reserve(view.size() * N);
  for (std::size_t i = 0; i < view.size(); ++i)
    for (int c = 0; c < N; ++c) values.push_back(static_cast<float>(view(i, c)));
  return Field::of(std::move(name), N, "Float32", values);
}

/// A cloud of particles as the text of a VTK file (.vtu, unstructured grid of vertices). `positions`
/// is in m and has three components; the fields follow as point data in appended raw form.
/// Throws `InputError` if a field has another number of particles than `positions`.
[[nodiscard]] inline std::string vtu(const Field& positions, std::span<const Field> fields, double time) {
  static_assert(std::endian::native == std::endian::little, "the frames are written in little-endian order");
  const std::size_t size = positions.bytes.size() / (positions.type == "Float64" ? 24 : 12);
  std::string head, data;
  const auto array = [&](const Field& field) {
    head += "<DataArray type=\"" + field.type + "\" Name=\"" + field.name + "\" NumberOfComponents=\"" +
            std::to_string(field.components) + "\" format=\"appended\" offset=\"" + std::to_string(data.size()) +
            "\"/>\n";
    const auto length = static_cast<std::uint64_t>(field.bytes.size());
    data.append(reinterpret_cast<const char*>(&length), sizeof(length));
    data += field.bytes;
  };
  std::vector<std::int32_t> connectivity(size), offsets(size);
  for (std::size_t i = 0; i < size; ++i) {
    connectivity[i] = static_cast<std::int32_t>(i);
    offsets[i] = static_cast<std::int32_t>(i + 1);
  }
  head +=
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">" +
      to_text(time) + "</DataArray>\n</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(size) +
      "\" NumberOfCells=\"" + std::to_string(size) + "\">\n<Points>\n";
  array(positions);
  head += "</Points>\n<Cells>\n";
  array(Field::of("connectivity", 1, "Int32", connectivity));
  array(Field::of("offsets", 1, "Int32", offsets));
  array(Field::of("types", 1, "UInt8", std::vector<std::uint8_t>(size, 1)));  // 1: VTK_VERTEX
  head += "</Cells>\n<PointData>\n";
  for (const Field& field : fields) {
    const std::size_t width = field.type == "Float64" ? 8 : field.type == "UInt8" ? 1 : 4;
    hmps::require(field.bytes.size() == size * width * static_cast<std::size_t>(field.components), "the field ",
                  field.name, " of a frame has ",
                  field.bytes.size() / (width * static_cast<std::size_t>(field.components)),
                  " particles, its positions have ", size);
    array(field);
  }
  head += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return head + data + "\n</AppendedData>\n</VTKFile>\n";
}

/// The text of a ParaView collection (.pvd) that lists `frames`: time in s, file name.
[[nodiscard]] inline std::string pvd(std::span<const std::pair<double, std::string>> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : frames)
    text += "<DataSet timestep=\"" + to_text(time) + "\" group=\"\" part=\"0\" file=\"" + file + "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace examples
