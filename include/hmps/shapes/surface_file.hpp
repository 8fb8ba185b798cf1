// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "hmps/core/abi.hpp"
#include "hmps/core/error.hpp"
#include "hmps/shapes/obj_file.hpp"
#include "hmps/shapes/stl_file.hpp"
#include "hmps/shapes/surface_mesh.hpp"
#include "hmps/shapes/surface_text.hpp"

namespace hmps::inline HMPS_ABI {

/// Reads a surface from an .stl or .obj file, as its extension says; see `read_stl` and `read_obj`. For an open surface
/// in millimetres:
///
///     const auto mesh = read_surface("organ.stl", {.scale = 1e-3, .closed = false});
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_surface(const std::string& path, const SurfaceFileSettings& settings) {
  const std::string name = detail::lower_case(path);
  if (name.ends_with(".stl")) return read_stl<S>(path, settings);
  if (name.ends_with(".obj")) return read_obj<S>(path, settings);
  detail::throw_input_error({"hmps: ", path,
                             " is neither .stl nor .obj; convert it to one of these: MeshLab and Blender read .ply, "
                             ".off and .3mf, ParaView reads .vtp and .vtk"});
}

/// Reads a closed surface from an .stl or .obj file, as its extension says.
template <class S = double>
[[nodiscard]] SurfaceMesh<S> read_surface(const std::string& path, double scale = 1, double tolerance = 1e-6) {
  return read_surface<S>(path, SurfaceFileSettings{scale, tolerance});
}

}  // namespace hmps::inline HMPS_ABI
