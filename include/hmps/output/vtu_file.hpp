// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/core/view.hpp"
#include "hmps/output/detail/xml_text.hpp"
#include "hmps/output/file_replacement.hpp"
#include "hmps/output/position_field.hpp"
#include "hmps/output/vtk_field.hpp"

namespace hmps::inline HMPS_ABI {

/// Names of the values 0, 1, 2, ... of an integer field, such as organs. The file contains them as a list of words that
/// is named after the field, for example "organ names".
struct VtkNames {
  std::string field;               ///< the field whose values are named
  std::vector<std::string> names;  ///< the names of the values 0, 1, 2, ...
};

/// The contents of a VTU file besides positions and fields.
struct VtuSettings {
  std::optional<double> time = {};  ///< s, as ParaView shows it; 0 if not set. `VtuSeries` sets it
  /// Triangles between the points, such as those of a surface; without triangles, each point is a cell of its own.
  std::span<const std::array<Index, 3>> triangles = {};
  std::vector<VtkNames> names = {};
};

namespace detail {

/// The byte order of this machine, as VTK calls it.
inline constexpr const char* byte_order = std::endian::native == std::endian::little ? "LittleEndian" : "BigEndian";

/// Words as VTK stores them: the numbers of their bytes, with a zero after each word. Readers expect UTF-8 here too.
[[nodiscard]] inline std::string vtk_words(const VtkNames& names) {
  std::string text = "<Array type=\"String\" Name=\"" + xml(names.field) + " names\" NumberOfTuples=\"" +
                     std::to_string(names.names.size()) + "\" format=\"ascii\">\n";
  for (const std::string& name : names.names) {
    for (const char c : xml_characters(name)) text += std::to_string(static_cast<unsigned char>(c)) + ' ';
    text += "0\n";
  }
  return text + "</Array>\n";
}

/// The arrays of a VTK file: their descriptions, and their bytes one after another.
struct VtkArrays {
  std::string head, data;
  void add(const VtkField& field) {
    head += "<DataArray type=\"" + field.type + "\" Name=\"" + xml(field.name) + "\" NumberOfComponents=\"" +
            std::to_string(field.components) + "\" format=\"appended\" offset=\"" + std::to_string(data.size()) +
            "\"/>\n";
    const std::uint64_t length = field.bytes.size();
    data.append(reinterpret_cast<const char*>(&length), sizeof(length));
    data += field.bytes;
  }
};

/// Adds the cells: the triangles, or one for each of `size` points.
inline void add_cells(VtkArrays& arrays, std::size_t size, std::span<const std::array<Index, 3>> triangles) {
  std::vector<std::int32_t> connectivity, offsets;
  const std::size_t count = triangles.empty() ? size : triangles.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (triangles.empty()) connectivity.push_back(static_cast<std::int32_t>(k));
    for (std::size_t c = 0; c < 3 && !triangles.empty(); ++c) {
      require(triangles[k][c] < size, "hmps: triangle ", k, " of a VTU file names point ", triangles[k][c],
              " but there are only ", size, "; give the points that the triangles belong to");
      connectivity.push_back(static_cast<std::int32_t>(triangles[k][c]));
    }
    offsets.push_back(static_cast<std::int32_t>(connectivity.size()));
  }
  arrays.add(as_field("connectivity", 1, connectivity));
  arrays.add(as_field("offsets", 1, offsets));
  // VTK's cell types: 1 is a vertex, 5 a triangle.
  arrays.add(as_field("types", 1, std::vector<std::uint8_t>(count, triangles.empty() ? 1 : 5)));
}

inline void require_fields(std::size_t size, std::span<const VtkField> fields) {
  for (std::size_t k = 0; k < fields.size(); ++k) {
    const VtkField& field = fields[k];
    require(!field.name.empty(), "hmps: field ", k, " of a VTU file has no name; ParaView needs one");
    require(std::none_of(fields.begin(), fields.begin() + static_cast<std::ptrdiff_t>(k),
                         [&](const VtkField& other) { return xml(other.name) == xml(field.name); }),
            "hmps: two fields of a VTU file are called ", xml(field.name), "; give each its own name");
    require((field.components == 1 || field.components == 3 || field.components == 9) &&
                (field.type == "Float32" || field.type == "Float64" || field.type == "Int32" || field.type == "UInt8"),
            "hmps: the field ", field.name, " of a VTU file has ", field.components, " components of the type '",
            field.type, "'; use vtk_field to make it");
    require(field.bytes.size() == size * field.width() * static_cast<std::size_t>(field.components), "hmps: the field ",
            field.name, " of a VTU file has ", field.size(), " particles but there are ", size,
            " positions; give both for the same particles");
  }
}

/// Throws `InputError` unless `names` belong to an integer field among `fields` and name each of its values.
inline void require_names(const VtkNames& names, std::span<const VtkField> fields) {
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const VtkField& field) {
    return field.name == names.field && field.type == "Int32";
  });
  require(found != fields.end(), "hmps: a VTU file has names for the values of ", names.field,
          ", which is not an integer field in it; name a field that is written too");
  for (std::size_t i = 0; i < found->bytes.size() / sizeof(std::int32_t); ++i) {
    std::int32_t value = 0;
    std::memcpy(&value, found->bytes.data() + i * sizeof(value), sizeof(value));
    require(value >= 0 && value < static_cast<std::int64_t>(names.names.size()), "hmps: number ", i, " of the field ",
            names.field, " of a VTU file is ", value, ", but there are ", names.names.size(),
            " names, for the values from 0 on; give a name for each value, and no negative values");
  }
}
}  // namespace detail

/// Points with fields as the bytes of a VTK file (.vtu, unstructured grid, version 1.0, appended raw data), which
/// ParaView, VTK and meshio read. `positions` are in m, with three components. Throws `InputError` for fields of
/// another size, without a name or with equal names, for triangles that name points that do not exist, for names that
/// belong to no integer field, do not name all of its values or are given twice, and for a time that is not finite.
[[nodiscard]] inline std::string vtu_text(const VtkField& positions, std::span<const VtkField> fields,
                                          const VtuSettings& settings = {}) {
  const std::size_t size = positions.size();
  const std::size_t cells = settings.triangles.empty() ? size : settings.triangles.size();
  detail::require(positions.components == 3, "hmps: the positions of a VTU file have ", positions.components,
                  " components; give three");
  detail::require(std::max(size, 3 * settings.triangles.size()) <= std::numeric_limits<std::int32_t>::max(),
                  "hmps: a VTU file of ", size, " points and ", settings.triangles.size(),
                  " triangles needs indices of more than 32 bits; write it in parts");
  const double time = settings.time.value_or(0);
  detail::require(detail::is_finite(time), "hmps: the time of a VTU file is ", time, " s; give a finite number");
  detail::require_fields(size, fields);
  detail::VtkArrays arrays;
  // Not one sum: there g++ 12 warns of bounds that it gets wrong.
  arrays.head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"";
  arrays.head += detail::byte_order;
  arrays.head +=
      "\" header_type=\"UInt64\">\n<UnstructuredGrid>\n<FieldData>\n"
      "<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">";
  arrays.head += detail::shortest(time);
  arrays.head += "</DataArray>\n";
  for (const VtkNames& names : settings.names) {
    detail::require_names(names, fields);
    const auto is_same = [&](const VtkNames& other) { return other.field == names.field; };
    detail::require(std::count_if(settings.names.begin(), settings.names.end(), is_same) == 1, "hmps: the values of ",
                    names.field, " are named twice in a VTU file, and ParaView shows only one of the lists; join them");
    arrays.head += detail::vtk_words(names);
  }
  arrays.head += "</FieldData>\n<Piece NumberOfPoints=\"" + std::to_string(size) + "\" NumberOfCells=\"" +
                 std::to_string(cells) + "\">\n<Points>\n";
  arrays.add(positions);
  arrays.head += "</Points>\n<Cells>\n";
  detail::add_cells(arrays, size, settings.triangles);
  arrays.head += "</Cells>\n<PointData>\n";
  for (const VtkField& field : fields) arrays.add(field);
  arrays.head += "</PointData>\n</Piece>\n</UnstructuredGrid>\n<AppendedData encoding=\"raw\">\n_";
  return arrays.head + arrays.data + "\n</AppendedData>\n</VTKFile>\n";
}

/// Writes particles, or a surface if the settings have triangles, to the VTK file `path` (.vtu):
///
///     write_vtu("body.vtu", x, {{vtk_field("velocity", v), vtk_field("organ", scalars(organ))}},
///               {.time = t, .names = {{"organ", {"tongue", "palate"}}}});
///
/// Positions `x` are in m; in two dimensions z is zero. They are written in single precision, or in double where single
/// precision does not resolve 1e-4 of the spacing; see `position_field`. Of a name, bytes that are not UTF-8 become
/// question marks. The file is replaced as a whole: whoever reads it while it is
/// written finds the old one. Throws `InputError` as `vtu_text` does, for a position that is not finite, for a name
/// that does not end in .vtu, and, with the name and the reason, if the file cannot be written.
template <class T, int D>
void write_vtu(const std::filesystem::path& path, const VectorView<T, D>& x, const std::vector<VtkField>& fields = {},
               const VtuSettings& settings = {}) {
  detail::require(path.extension() == ".vtu", "hmps: ", path.string(),
                  " should be a VTK file of the kind .vtu; give it that ending, by which ParaView recognises it");
  require_finite(x, "the position");
  replace_file(path, vtu_text(position_field("position", x), fields, settings));
}

}  // namespace hmps::inline HMPS_ABI
