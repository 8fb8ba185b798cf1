// SPDX-License-Identifier: MIT
// Frames of a motion for ParaView: a ball is stretched along x and narrowed across it, in a run that stops halfway and
// is resumed. Writes the folder stretched: open body.pvd and surface.pvd there.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

using Vector = hmps::Vector<double, 3>;

/// Where the material point r (m) is at the time t (s): an affine motion, which a carried surface follows exactly.
Vector moved(const Vector& r, double t) { return {(1 + t) * r[0], r[1] / std::sqrt(1 + t), r[2] / std::sqrt(1 + t)}; }

/// How far the vertices of the surface are from where the motion takes them (m), in the frames up to the time `end`.
double write_frames(double start, double end, const hmps::VtuSeriesSettings& how) {
  const double l0 = 2e-3;
  const hmps::Ball<double, 3> ball{.radius = 0.01};
  const hmps::Box<double, 3> box{Vector::Constant(-0.012), Vector::Constant(0.012)};
  const hmps::SurfaceMesh<double> mesh = hmps::isosurface(ball, box, l0);
  const std::vector<Vector> reference = hmps::fill_lattice(ball, box, l0, Vector(Vector::Zero()));
  std::vector<Vector> position = reference, displacement(reference.size());

  //! [frames]
  hmps::VtuSeries body("stretched/body.pvd", how), surface("stretched/surface.pvd", how);  // make the folder
  const hmps::CarriedSurface<3> carried(hmps::vectors(reference), hmps::vectors(mesh.vertices), l0);
  std::vector<Vector> vertices(mesh.vertices.size());
  const auto add_frame = [&](double t) {
    body.add(t, hmps::vectors(position), {hmps::vtk_field("displacement", hmps::vectors(displacement))});
    carried(hmps::vectors(position), hmps::vectors(vertices));  // the vertices move with the particles
    surface.add(t, hmps::vectors(vertices), {}, {.triangles = mesh.triangles});
  };
  //! [frames]

  double deviation = 0;
  for (double t = start; t < end + 1e-9; t += 0.1) {
    for (std::size_t i = 0; i < reference.size(); ++i) {
      position[i] = moved(reference[i], t);
      displacement[i] = position[i] - reference[i];
    }
    add_frame(t);
    for (std::size_t k = 0; k < vertices.size(); ++k)
      deviation = std::max(deviation, (vertices[k] - moved(mesh.vertices[k], t)).norm());
  }
  std::printf("There are %zu frames of %zu particles.\n", body.frames().size(), reference.size());
  return deviation;
}

int main() try {
  const double first = write_frames(0, 0.5, {});
  const double second = write_frames(0.6, 1, {.resume_at = 0.5});  // keeps the frames up to 0.5 s
  return std::fflush(stdout) == 0 && std::max(first, second) < 1e-12 ? 0 : 1;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
