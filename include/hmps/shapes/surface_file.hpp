// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/text_file.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

[[nodiscard]] inline std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// Where a text is read, for messages.
struct TextPlace {
  const std::string& source;
  std::size_t line = 0;
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw InputError(message("hmps: ", source, ", line ", line, ": ", parts...));
  }
};

/// Three finite numbers from the front of `rest`, times `scale`.
template <class S>
[[nodiscard]] Vector<S, 3> take_point(std::string_view& rest, double scale, const TextPlace& place) {
  Vector<S, 3> point;
  for (int c = 0; c < 3; ++c) {
    double number{};
    const std::string_view word = take_word(rest);
    if (word.empty()) place.fail("a vertex has only ", c, " coordinates");
    if (!parse_number(word, number) || !std::isfinite(number)) place.fail("'", word, "' is not a finite number");
    point[c] = static_cast<S>(scale * number);
  }
  return point;
}

template <class S>
void add_triangle(SurfaceMesh<S>& mesh, const std::array<Vector<S, 3>, 3>& corners) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

template <class S>
void parse_binary_stl(std::string_view bytes, double scale, SurfaceMesh<S>& mesh) {
  static_assert(std::endian::native == std::endian::little, "hmps: binary STL is read on little-endian machines only");
  constexpr std::size_t header = 84;
  constexpr std::size_t record = 50;
  std::uint32_t count{};
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<float, 9> numbers{};
    const std::size_t at = header + k * record + 12;
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    std::array<Vector<S, 3>, 3> corners;
    for (std::size_t c = 0; c < 9; ++c) {
      require(std::isfinite(numbers[c]), "hmps: ", mesh.source, ", byte ", at + 4 * c, ": a coordinate of triangle ", k,
              " is ", numbers[c], "; every coordinate must be a finite number");
      corners[c / 3][static_cast<Eigen::Index>(c % 3)] = static_cast<S>(scale * static_cast<double>(numbers[c]));
    }
    add_triangle(mesh, corners);
  }
}

template <class S>
void parse_ascii_stl(std::string_view text, double scale, SurfaceMesh<S>& mesh) {
  TextPlace place{mesh.source};
  std::array<Vector<S, 3>, 3> corners;
  std::size_t corner = 0;
  bool in_facet = false;
  while (!text.empty()) {
    ++place.line;
    std::string_view rest = take_line(text);
    const std::string word = lower_case(take_word(rest));
    if (word == "facet") {
      if (in_facet) place.fail("a facet begins before the last one has ended");
      in_facet = true;
      corner = 0;
    } else if (word == "vertex") {
      if (!in_facet) place.fail("a vertex outside of a facet");
      if (corner == 3) place.fail("a facet has more than three vertices; STL holds triangles only");
      corners[corner++] = take_point<S>(rest, scale, place);
    } else if (word == "endfacet") {
      if (!in_facet || corner != 3) place.fail("a facet ends after ", corner, " vertices; it needs three");
      add_triangle(mesh, corners);
      in_facet = false;
    } else if (!word.empty() && word != "outer" && word != "endloop" && word != "solid" && word != "endsolid") {
      place.fail("'", word, "' is no word of an STL file");
    }
  }
  if (in_facet) place.fail("the file ends within a facet; it is cut off");
}

}  // namespace detail

/// Reads a closed surface from an STL file, ASCII or binary: welded (`weld`) and checked
/// (`require_closed`). Coordinates are multiplied by `scale`: 1e-3 for files in millimetres. Throws
/// `InputError` with the line (ASCII) or the byte (binary) if it cannot be read.
template <class S>
[[nodiscard]] SurfaceMesh<S> read_stl(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  const std::string text = detail::read_text(path);
  SurfaceMesh<S> mesh;
  mesh.source = path;
  std::uint32_t count{};
  if (text.size() >= 84) std::memcpy(&count, text.data() + 80, sizeof count);
  const std::size_t size = 84 + std::size_t{50} * count;
  // Binary files may begin with "solid" too; only their length tells.
  std::string_view front(text);
  const bool ascii =
      detail::lower_case(detail::take_word(front)) == "solid" && (text.size() < 84 || size != text.size());
  if (ascii) {
    detail::parse_ascii_stl(text, scale, mesh);
  } else {
    require(text.size() >= 84, "hmps: ", path, " is no STL file: it has ", text.size(),
            " bytes and does not begin with 'solid'");
    require(size <= text.size(), "hmps: ", path, " ends at byte ", text.size(), " but announces ", count,
            " triangles in ", size, " bytes; it is cut off or no STL file");
    detail::parse_binary_stl(text, scale, mesh);
  }
  mesh = weld(mesh, tolerance);
  require_closed(mesh);
  return mesh;
}

/// Reads a closed surface from a Wavefront OBJ file: its `v` and `f` lines; polygons are cut into
/// fans, and what else the format knows (normals, textures, groups, materials) is passed over.
/// Welded, checked and scaled as in `read_stl`. Throws `InputError` with the line if it cannot be read.
template <class S>
[[nodiscard]] SurfaceMesh<S> read_obj(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  const std::string text = detail::read_text(path);
  SurfaceMesh<S> mesh;
  mesh.source = path;
  detail::TextPlace place{mesh.source};
  std::vector<Index> polygon;
  for (std::string_view left = text; !left.empty();) {
    ++place.line;
    std::string_view rest = detail::take_line(left);
    rest = rest.substr(0, rest.find('#'));
    const std::string_view word = detail::take_word(rest);
    if (word == "v") {
      mesh.vertices.push_back(detail::take_point<S>(rest, scale, place));
    } else if (word == "f") {
      polygon.clear();
      for (std::string_view corner = detail::take_word(rest); !corner.empty(); corner = detail::take_word(rest)) {
        std::int64_t number{};
        if (!detail::parse_number(corner.substr(0, corner.find('/')), number))
          place.fail("'", corner, "' is no corner of a face");
        const auto count = static_cast<std::int64_t>(mesh.vertices.size());
        // Positive from the first vertex, negative back from the last one so far.
        const std::int64_t index = number > 0 ? number - 1 : count + number;
        if (number == 0 || index < 0 || index >= count)
          place.fail("a face names vertex ", number, " but ", count, " vertices stand before it");
        polygon.push_back(static_cast<Index>(index));
      }
      if (polygon.size() < 3) place.fail("a face has ", polygon.size(), " corners; it needs at least three");
      for (std::size_t c = 2; c < polygon.size(); ++c)
        mesh.triangles.push_back({polygon[0], polygon[c - 1], polygon[c]});
    }
  }
  mesh = weld(mesh, tolerance);
  require_closed(mesh);
  return mesh;
}

/// Reads a closed surface by the ending of its name, .stl or .obj.
template <class S>
[[nodiscard]] SurfaceMesh<S> read_surface(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  const std::string name = detail::lower_case(path);
  if (name.ends_with(".stl")) return read_stl<S>(path, scale, tolerance);
  if (name.ends_with(".obj")) return read_obj<S>(path, scale, tolerance);
  throw InputError(message("hmps: ", path, " is neither .stl nor .obj; convert it to one of these"));
}

}  // namespace hmps::inline HMPS_ABI
