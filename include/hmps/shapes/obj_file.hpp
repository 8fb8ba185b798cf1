// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/core/error.hpp"
#include "hmps/core/types.hpp"
#include "hmps/shapes/detail/polygon.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/surface_text.hpp"

namespace hmps::inline HMPS_ABI {

namespace detail {

/// Reads the `v` and `f` lines of a Wavefront OBJ file.
template <class S>
class ObjParser {
 public:
  ObjParser(SurfaceMesh<S>& mesh, double scale) : mesh_(mesh), scale_(scale), place_{mesh.source} {}

  void operator()(std::string_view text) {
    std::string joined;
    while (!text.empty()) {
      ++place_.line;
      std::size_t more = 0;
      std::string_view line = take_line(text);
      line = line.substr(0, line.find('#'));
      if (trimmed(line).ends_with('\\')) {
        // Continued on the next line.
        joined.clear();
        while (trimmed(line).ends_with('\\')) {
          line = trimmed(line);
          joined.append(line.substr(0, line.size() - 1)).push_back(' ');
          line = {};
          if (text.empty()) break;
          ++more;
          line = take_line(text);
          line = line.substr(0, line.find('#'));
        }
        line = joined.append(line);
      }
      take(line);
      place_.line += more;
    }
    for (const Ahead& ahead : ahead_)
      if (ahead.number > static_cast<std::int64_t>(mesh_.vertices.size())) {
        place_.line = ahead.line;
        place_.fail("a face names vertex ", ahead.number, " but ", mesh_.vertices.size(), " vertices are in the file");
      }
    for (const Face& face : faces_) split(face);
  }

 private:
  /// A corner that refers to a vertex that has not been read yet.
  struct Ahead {
    std::int64_t number;
    std::size_t line;
  };
  /// A face with more than three corners: the first of its triangles, and how many they are.
  struct Face {
    std::size_t first, count, line;
  };

  void take(std::string_view line) {
    const std::string_view word = take_word(line);
    if (word == "v")
      mesh_.vertices.push_back(take_point<S>(line, scale_, place_));
    else if (word == "f")
      take_face(line);
  }

  void take_face(std::string_view line) {
    polygon_.clear();
    for (std::string_view corner = take_word(line); !corner.empty(); corner = take_word(line)) {
      std::int64_t number{};
      if (!parse_number(corner.substr(0, corner.find('/')), number))
        place_.fail("'", printable(corner), "' is not a corner of a face");
      const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
      // Positive indices count from the first vertex, negative ones back from the last vertex read so far.
      if (number == 0 || number < -count)
        place_.fail("a face names vertex ", number, " but ", count, " vertices precede it");
      if (number >= static_cast<std::int64_t>(std::numeric_limits<Index>::max()))
        place_.fail("a face names vertex ", number, ", more than a 32-bit index can address");
      if (number > count) ahead_.push_back({number, place_.line});
      polygon_.push_back(static_cast<Index>(number > 0 ? number - 1 : count + number));
    }
    if (polygon_.size() < 3) place_.fail("a face has ", polygon_.size(), " corners; it needs at least three");
    if (polygon_.size() > 3) faces_.push_back({mesh_.triangles.size(), polygon_.size() - 2, place_.line});
    // A fan, until all vertices are known.
    for (std::size_t c = 2; c < polygon_.size(); ++c)
      mesh_.triangles.push_back({polygon_[0], polygon_[c - 1], polygon_[c]});
  }

  /// Replaces the fan of a face where it is not the face.
  void split(const Face& face) {
    const auto fan = mesh_.triangles.begin() + static_cast<std::ptrdiff_t>(face.first);
    polygon_.assign({(*fan)[0], (*fan)[1]});
    for (std::size_t k = 0; k < face.count; ++k) polygon_.push_back(fan[static_cast<std::ptrdiff_t>(k)][2]);
    std::vector<Vector<double, 3>> corners;
    double largest = 0;
    for (const Index corner : polygon_) {
      corners.push_back(mesh_.vertices[corner].template cast<double>());
      for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(corners.back()[c]));
    }
    const PolygonSplit parts(std::move(corners), 4 * static_cast<double>(std::numeric_limits<S>::epsilon()) * largest);
    place_.line = face.line;
    if (parts.fault() == PolygonFault::no_area)
      place_.fail("a face of ", polygon_.size(),
                  " corners encloses no area, because its border crosses itself; delete the face, or "
                  "triangulate it in a mesh editor");
    if (parts.fault() == PolygonFault::crosses_itself)
      place_.fail("the border of a face of ", polygon_.size(),
                  " corners crosses itself or runs around twice; correct the order of its corners, or triangulate it "
                  "in a mesh editor");
    for (std::size_t k = 0; k < face.count; ++k) {
      const auto& [a, b, c] = parts.triangles()[k];
      fan[static_cast<std::ptrdiff_t>(k)] = {polygon_[a], polygon_[b], polygon_[c]};
    }
  }

  SurfaceMesh<S>& mesh_;
  double scale_;
  TextPlace place_;
  std::vector<Index> polygon_;
  std::vector<Ahead> ahead_;
  std::vector<Face> faces_;
};

}  // namespace detail

/// Reads a surface from a Wavefront OBJ file: its `v` and `f` lines, in any order. Polygons are split into
/// triangles: convex ones into the fan of their first corner, others by clipping ears in the plane of their mean
/// normal. Normals, textures, groups and materials are ignored. A backslash at the end continues a line. Scaled, welded
/// and checked as in `read_stl`. Throws `InputError`, with the line, if the file cannot be read, and for a polygon
/// whose border crosses itself or that has no area.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_obj(const std::string& path, const SurfaceFileSettings& settings) {
  detail::validate(settings, path);
  std::string text = detail::read_text(path);
  detail::clean_text(text, path);
  SurfaceMesh<S> mesh;
  mesh.source = path;
  detail::ObjParser<S>(mesh, settings.scale)(text);
  return detail::finished(mesh, settings);
}

/// Reads a closed surface from a Wavefront OBJ file.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_obj(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  return read_obj<S>(path, SurfaceFileSettings{scale, tolerance});
}

}  // namespace hmps::inline HMPS_ABI
