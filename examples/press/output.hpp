// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdio>
#include <hmps/core/view.hpp>
#include <hmps/diagnostics/stress.hpp>
#include <hmps/output/vtu_series.hpp>
#include <hmps/particles/carried_surface.hpp>
#include <hmps/shapes/surface_mesh.hpp>
#include <vector>

#include "picture.hpp"

namespace press {

/// What is written of a body that is pressed: the particles and the surface that they carry along, both with the stress
/// of von Mises, as frames for ParaView, and a picture.
class Output {
  using Vector = hmps::Vector<double, 3>;

 public:
  /// The picture shows what lies in the box of mesh and plate, with colours for stress up to `most` (Pa).
  Output(const hmps::SurfaceMesh<double>& mesh, const hmps::VectorView<const double, 3>& reference, double l0,
         const hmps::Box<double, 3>& plate, double most)
      : mesh_(mesh),
        carried_(reference, hmps::vectors(mesh.vertices), l0),
        vertices_(mesh.vertices),
        plate_(plate),
        picture_({Vector(plate.lower[0], plate.lower[1], hmps::bounds(mesh).lower[2]), plate.upper}, most) {}

  /// Adds a frame: positions `x` in m and deformation gradients of the particles, the plate down by `depth` (m) and
  /// pushed up by `reaction` (N).
  template <class Law>
  void add(const hmps::VectorView<double, 3>& x, const hmps::MatrixView<double, 3>& F, const Law& law, double depth,
           double reaction) {
    std::printf("The plate is down by %5.2f mm and feels %.3g N.\n", 1e3 * depth, reaction);
    std::vector<double> stress(x.size()), shown(vertices_.size());
    hmps::von_mises_stresses(F, law, hmps::scalars(stress));
    carried_(x, hmps::vectors(vertices_));
    carried_.mean(hmps::scalars(stress), hmps::scalars(shown));
    particles_.add(depth, x, {hmps::vtk_field("von Mises stress", hmps::scalars(stress)), hmps::vtk_field("F", F)});
    surface_.add(depth, hmps::vectors(vertices_), {hmps::vtk_field("von Mises stress", hmps::scalars(shown))},
                 {.triangles = mesh_.triangles});
    picture_.draw(vertices_, mesh_.triangles, shown, plate_, depth);
  }
  /// Writes the picture of the first frame and the last.
  void save() { picture_.save("press/press.png"); }

 private:
  const hmps::SurfaceMesh<double>& mesh_;
  hmps::CarriedSurface<3> carried_;
  std::vector<Vector> vertices_;
  hmps::Box<double, 3> plate_;
  hmps::VtuSeries particles_{"press/press.pvd"}, surface_{"press/surface.pvd"};
  Picture picture_;
};

}  // namespace press
