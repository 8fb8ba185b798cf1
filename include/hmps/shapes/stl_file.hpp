// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <bit>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/surface_text.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

inline constexpr std::size_t stl_header = 84;
inline constexpr std::size_t stl_record = 50;

/// Whether an STL file is ASCII. Binary files may begin with "solid" too; they are recognised by the length that their
/// header announces, or by a zero byte in the name or the count (of less than 2^24 triangles), which no text contains.
[[nodiscard]] inline bool is_ascii_stl(std::string_view bytes) {
  if (bytes.size() >= stl_header) {
    std::uint32_t count{};
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    if (bytes.size() == stl_header + stl_record * count) return false;
  }
  if (bytes.substr(0, stl_header).find('\0') != std::string_view::npos) return false;
  if (bytes.starts_with("\xEF\xBB\xBF")) bytes.remove_prefix(3);
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return false;
  const std::string_view word = bytes.substr(first, 5);
  return lower_case(word) == "solid" &&
         (first + 5 == bytes.size() || std::isspace(static_cast<unsigned char>(bytes[first + 5])));
}

/// The number of triangles in the binary STL file `bytes`. Throws `InputError` if it does not match the header.
[[nodiscard]] inline std::size_t count_binary_stl(std::string_view bytes, const std::string& source) {
  require(bytes.size() >= stl_header, "hmps: ", source, " is not an STL file: it has ", bytes.size(),
          " bytes and does not begin with 'solid'");
  std::uint32_t count{};
  std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::size_t size = stl_header + stl_record * count;
  require(size <= bytes.size(), "hmps: ", source, " ends at byte ", bytes.size(), " but announces ", count,
          " triangles in ", size, " bytes; it is cut off or not an STL file");
  // Some programs append a few bytes or pad with zeros; a whole extra triangle is an error.
  const std::string_view rest = bytes.substr(size);
  require(rest.size() < stl_record || rest.find_first_not_of('\0') == std::string_view::npos, "hmps: ", source,
          " announces ", count, " triangles, which end at byte ", size, ", but ", rest.size(),
          " bytes follow, enough for ", rest.size() / stl_record,
          " more; the count or the file is damaged: write the file again");
  return count;
}

template <class S>
void parse_binary_stl(std::string_view bytes, double scale, SurfaceMesh<S>& mesh) {
  static_assert(std::endian::native == std::endian::little, "hmps: binary STL is read on little-endian machines only");
  const std::size_t count = count_binary_stl(bytes, mesh.source);
  for (std::size_t k = 0; k < count; ++k) {
    std::array<float, 9> numbers{};
    const std::size_t at = stl_header + k * stl_record + 12;
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    std::array<Vector<S, 3>, 3> corners;
    for (std::size_t c = 0; c < 9; ++c) {
      require(is_finite(numbers[c]), "hmps: ", mesh.source, ", byte ", at + 4 * c, ": a coordinate of triangle ", k,
              " is ", numbers[c], "; every coordinate must be a finite number");
      corners[c / 3][static_cast<Eigen::Index>(c % 3)] = static_cast<S>(scale * static_cast<double>(numbers[c]));
    }
    add_triangle(mesh, corners);
  }
}

template <class S>
void parse_ascii_stl(std::string_view text, const SurfaceFileSettings& settings, SurfaceMesh<S>& mesh) {
  TextPlace place{mesh.source};
  std::array<Vector<S, 3>, 3> corners;
  std::size_t corner = 0;
  bool in_facet = false;
  bool in_solid = false;
  while (!text.empty()) {
    ++place.line;
    std::string_view rest = take_line(text);
    std::string word = lower_case(take_word(rest));
    if (word == "end") word += lower_case(take_word(rest));
    if (word == "facet") {
      if (in_facet) place.fail("a facet begins before the last one has ended");
      in_facet = true;
      corner = 0;
    } else if (word == "vertex") {
      if (!in_facet) place.fail("a vertex outside of a facet");
      if (corner == 3) place.fail("a facet has more than three vertices; STL holds triangles only");
      corners[corner++] = take_point<S>(rest, settings.scale, place);
    } else if (word == "endfacet") {
      if (!in_facet || corner != 3) place.fail("a facet ends after ", corner, " vertices; it needs three");
      add_triangle(mesh, corners);
      in_facet = false;
    } else if (word == "solid" || word == "endsolid") {
      if (in_facet) place.fail("'", word, "' within a facet");
      in_solid = word == "solid";
    } else if (!word.empty() && word != "outer" && word != "endloop") {
      place.fail("'", printable(word), "' is not a keyword of an STL file");
    }
  }
  if (in_facet) place.fail("the file ends within a facet; it is cut off");
  // A closed surface is complete in any case.
  if (in_solid && !settings.closed) place.fail("the file ends without 'endsolid'; it is cut off");
}

}  // namespace detail

/// Reads a surface from an STL file, ASCII or binary, with one solid or several. Vertices are welded (`weld`), repeated
/// triangles are dropped (`drop_repeated`), and the surface is checked (`require_closed`) unless `settings.closed` is
/// false. Throws `InputError`, with the line (ASCII) or the byte (binary), if the file cannot be read, and if more
/// binary triangles follow than the header announces.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_stl(const std::string& path, const SurfaceFileSettings& settings) {
  detail::validate(settings, path);
  std::string text = detail::read_text(path);
  SurfaceMesh<S> mesh;
  mesh.source = path;
  if (detail::is_ascii_stl(text)) {
    detail::clean_text(text, path);
    detail::parse_ascii_stl(text, settings, mesh);
  } else {
    detail::parse_binary_stl(text, settings.scale, mesh);
  }
  return detail::finished(mesh, settings);
}

/// Reads a closed surface from an STL file.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_stl(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  return read_stl<S>(path, SurfaceFileSettings{scale, tolerance});
}

}  // namespace hmps::inline HMPS_ABI
