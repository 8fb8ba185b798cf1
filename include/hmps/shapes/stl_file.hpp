// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
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

/// Reads an ASCII STL file word by word: blanks and line ends separate words alike. Only the name of a solid ends with
/// its line, or before a facet that begins on it.
template <class S>
class AsciiStlParser {
 public:
  AsciiStlParser(SurfaceMesh<S>& mesh, const SurfaceFileSettings& settings)
      : mesh_(mesh), settings_(settings), place_{mesh.source} {}

  void operator()(std::string_view text) {
    text_ = text;
    for (std::string_view word = next(); !word.empty(); word = next()) {
      std::string keyword = lower_case(word);
      if (keyword == "end") keyword += lower_case(next());
      take(keyword);
    }
    if (in_facet_) place_.fail("the file ends within a facet; it is cut off");
    // A closed surface is complete in any case.
    if (in_solid_ && !settings_.closed) place_.fail("the file ends without 'endsolid'; it is cut off");
  }

 private:
  /// Removes and returns the next word of `text`; empty at the end. Adds the line ends before it to `line`.
  static std::string_view take_from(std::string_view& text, std::size_t& line) {
    std::size_t from = 0;
    for (; from < text.size() && is_blank(text[from]); ++from)
      if (text[from] == '\n') ++line;
    std::size_t to = from;
    while (to < text.size() && !is_blank(text[to])) ++to;
    const std::string_view word = text.substr(from, to - from);
    text.remove_prefix(to);
    return word;
  }
  std::string_view next() {
    const std::string_view word = take_from(text_, line_);
    if (!word.empty()) place_.line = line_;
    return word;
  }

  void take(const std::string& keyword) {
    if (keyword == "vertex") {
      require_facet(keyword);
      if (corner_ == 3) place_.fail("a facet has more than three vertices; STL holds triangles only");
      take_vertex();
    } else if (keyword == "facet") {
      if (in_facet_) place_.fail("a facet begins before the last one has ended");
      in_facet_ = in_solid_ = true;
      corner_ = 0;
    } else if (keyword == "normal") {
      require_facet(keyword);
      skip_normal();
    } else if (keyword == "outer") {
      require_facet(keyword);
      if (lower_case(next()) != "loop") place_.fail("'outer' is not followed by 'loop'");
    } else if (keyword == "endloop") {
      require_facet(keyword);
    } else if (keyword == "endfacet") {
      if (!in_facet_ || corner_ != 3) place_.fail("a facet ends after ", corner_, " vertices; it needs three");
      add_triangle(mesh_, corners_);
      in_facet_ = false;
    } else if (keyword == "solid" || keyword == "endsolid") {
      if (in_facet_) place_.fail("'", keyword, "' within a facet");
      in_solid_ = keyword == "solid";
      skip_name();
    } else {
      fail_at(keyword);
    }
  }

  void take_vertex() {
    const std::size_t line = place_.line;
    for (int c = 0; c < 3; ++c) {
      double number{};
      const std::string_view word = next();
      if (parse_number(word, number) && is_finite(number)) {
        corners_[corner_][c] = static_cast<S>(settings_.scale * number);
        continue;
      }
      if (!ends_numbers(word)) place_.fail("'", printable(word), "' is not a finite number");
      place_.line = line;
      place_.fail("a vertex has only ", c, " coordinates");
    }
    ++corner_;
  }

  /// Normals are not used, and some programs write NaN or commas in them.
  void skip_normal() {
    std::string_view rest = text_;
    std::size_t line = line_;
    while (!ends_numbers(take_from(rest, line))) {
      text_ = rest;
      line_ = line;
    }
  }

  void skip_name() {
    const std::size_t end = std::min(text_.find('\n'), text_.size());
    std::string_view rest = text_.substr(0, end);
    for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const auto at = static_cast<std::size_t>(word.data() - text_.data());
      if (lower_case(word) != "facet" || !continues_facet(text_.substr(at + word.size()))) continue;
      text_.remove_prefix(at);
      return;
    }
    text_.remove_prefix(end);
  }

  /// Whether `text` goes on as a facet up to its first vertex, and not as a name with the word "facet" in it.
  [[nodiscard]] static bool continues_facet(std::string_view text) {
    std::size_t line = 0;
    const auto word = [&] { return lower_case(take_from(text, line)); };
    std::string keyword = word();
    if (keyword == "normal") {
      for (int c = 0; c < 3; ++c) (void)word();
      keyword = word();
    }
    if (keyword == "outer") return word() == "loop" && word() == "vertex";
    double number{};
    const std::string first = word();
    return keyword == "vertex" && parse_number(std::string_view(first), number);
  }

  void require_facet(const std::string& keyword) const {
    if (!in_facet_) place_.fail("'", keyword, "' outside of a facet");
  }

  [[noreturn]] void fail_at(const std::string& word) const {
    double number{};
    if (parse_number(std::string_view(word), number))
      place_.fail("the number '", printable(word),
                  "' does not belong there: a vertex has three coordinates, with points as decimal marks");
    place_.fail("'", printable(word), "' is not a keyword of an STL file");
  }

  [[nodiscard]] static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }
  /// Whether `word` is one that may follow the numbers of a vertex or a normal, or the end of the file.
  [[nodiscard]] static bool ends_numbers(std::string_view word) {
    if (word.empty()) return true;
    const char first = word.front();
    if (std::string_view("vofeVOFE").find(first) == std::string_view::npos) return false;
    const std::string keyword = lower_case(word);
    return keyword == "vertex" || keyword == "outer" || keyword == "facet" || keyword.starts_with("end");
  }

  SurfaceMesh<S>& mesh_;
  const SurfaceFileSettings& settings_;
  TextPlace place_;
  std::string_view text_;
  std::size_t line_ = 1;
  std::array<Vector<S, 3>, 3> corners_;
  std::size_t corner_ = 0;
  bool in_facet_ = false;
  bool in_solid_ = false;
};

}  // namespace detail

/// Reads a surface from an STL file, ASCII or binary, with one solid or several. In an ASCII file the name of a solid
/// runs to the end of its line or to a facet on it; elsewhere lines have no meaning, and normals no effect. Vertices
/// are welded (`weld`), repeated triangles are dropped (`drop_repeated`), and the surface is checked (`require_closed`)
/// unless `settings.closed` is false. Throws `InputError`, with the line (ASCII) or the byte (binary), if the file
/// cannot be read, and if more binary triangles follow than the header announces.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_stl(const std::string& path, const SurfaceFileSettings& settings) {
  detail::validate(settings, path);
  std::string text = detail::read_text(path);
  SurfaceMesh<S> mesh;
  mesh.source = path;
  if (detail::is_ascii_stl(text)) {
    detail::clean_text(text, path);
    detail::AsciiStlParser<S>(mesh, settings)(text);
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
