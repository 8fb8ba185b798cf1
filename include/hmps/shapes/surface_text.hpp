// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/finite.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace hmps::inline HMPS_ABI {

/// Settings for reading a surface file.
struct SurfaceFileSettings {
  double scale = 1;         ///< factor for coordinates: 1e-3 for files in millimetres
  double tolerance = 1e-6;  ///< vertices closer than this fraction of the largest extent are merged (`weld`)
  bool closed = true;       ///< whether the surface must be closed; if not, fill it with `fill_open_lattice`
};

namespace detail {

[[nodiscard]] inline std::string lower_case(std::string_view word) {
  std::string result(word);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// The current position in a text, for messages.
struct TextPlace {
  const std::string& source;
  std::size_t line = 0;
  template <class... Parts>
  [[noreturn]] void fail(const Parts&... parts) const {
    throw InputError(message("hmps: ", source, ", line ", line, ": ", parts...));
  }
};

/// Removes three finite numbers from the front of `rest` and multiplies them by `scale`.
template <class S>
[[nodiscard]] Vector<S, 3> take_point(std::string_view& rest, double scale, const TextPlace& place) {
  Vector<S, 3> point;
  for (int c = 0; c < 3; ++c) {
    double number{};
    const std::string_view word = take_word(rest);
    if (word.empty()) place.fail("a vertex has only ", c, " coordinates");
    if (!parse_number(word, number) || !is_finite(number)) place.fail("'", printable(word), "' is not a finite number");
    point[c] = static_cast<S>(scale * number);
  }
  return point;
}

/// Prepares the bytes of a text: removes a UTF-8 byte-order mark, refuses UTF-16, and converts lone CR line ends to LF.
inline void clean_text(std::string& text, const std::string& source) {
  require(!text.starts_with("\xFF\xFE") && !text.starts_with("\xFE\xFF"), "hmps: ", source,
          " is a text in UTF-16; save it in UTF-8 or ASCII");
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  if (text.find('\n') == std::string::npos) std::replace(text.begin(), text.end(), '\r', '\n');
}

template <class S>
void add_triangle(SurfaceMesh<S>& mesh, const std::array<Vector<S, 3>, 3>& corners) {
  const auto first = static_cast<Index>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
}

/// Welds the surface, drops repeated triangles, and checks the rest.
template <class S>
[[nodiscard]] SurfaceMesh<S> finished(const SurfaceMesh<S>& read, const SurfaceFileSettings& settings) {
  SurfaceMesh<S> mesh = drop_repeated(weld(read, settings.tolerance));
  if (settings.closed)
    require_closed(mesh);
  else
    require_triangles(mesh);
  return mesh;
}

inline void validate(const SurfaceFileSettings& settings, const std::string& path) {
  require(is_finite(settings.scale) && settings.scale > 0, "hmps: ", path, " is to be read with a scale of ",
          settings.scale, "; give a positive number, 1e-3 for millimetres");
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
