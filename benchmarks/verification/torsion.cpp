// SPDX-License-Identifier: MIT
// Rivlin's torsion of a cylinder, which becomes a prism with steps on the lattice.
#include <cmath>
#include <numbers>

#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace torsion_detail {
namespace {

constexpr double radius = 0.01, twist = 50;  // m, rad/m: an angle of 0.5 at the surface
constexpr int held = 2;

Measured wring(int size, const Method& method) {
  using Vector = hmps::Vector<double, 3>;
  // Cells whose centre lies within size / 2 spacings of the axis, which passes through the centre or a corner of a
  // cell.
  std::vector<Vector> section;
  for (int j = -size; j <= size; ++j)
    for (int k = -size; k <= size; ++k) {
      const Vector place(0, j + (size % 2 == 0 ? 0.5 : 0.0), k + (size % 2 == 0 ? 0.5 : 0.0));
      if (place.norm() < 0.5 * size) section.push_back(place);
    }
  const double l0 = radius * std::sqrt(std::numbers::pi / static_cast<double>(section.size()));
  const int length = 2 * size;  // free layers, about two diameters
  std::vector<Vector> points;
  for (int layer = -held; layer < length + held; ++layer)
    for (const Vector& place : section) points.push_back(l0 * (place + Vector(layer + 0.5, 0, 0)));
  Body<3> body(l0, points);
  for (std::size_t i = 0; i < body.size(); ++i) {
    const Vector& X = body.reference[i];
    const double angle = twist * X[0], c = std::cos(angle), s = std::sin(angle);
    body.position[i] = Vector(X[0], c * X[1] - s * X[2], s * X[1] + c * X[2]);
  }
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0 && body.reference[i][0] < length * l0; };
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  with_force(method, body.F(), bonds, tissue, [&](auto& force) { settle(body, force, moves, 0, 1e-5); });
  // The moment and the thrust that must act on the upper end.
  double moment = 0, thrust = 0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    if (body.reference[i][0] < length * l0) continue;
    moment -= body.position[i].cross(body.load[i])[0] * body.volume();
    thrust -= body.load[i][0] * body.volume();
  }
  return {l0, body.size(), {1e3 * moment, thrust}};
}

}  // namespace
}  // namespace torsion_detail

Problem torsion() {
  using namespace torsion_detail;
  const double a4 = std::pow(radius, 4), pi = std::numbers::pi;
  return {
      .name = "torsion",
      .title = "14. Torsion of a cylinder",
      .text =
          "A cylinder of the paper's soft tissue, 10 mm in radius and about 40 mm long, is twisted by 50 rad/m while "
          "its ends are held at a fixed distance. For an incompressible material, Rivlin gives M = pi (C1 + C2) psi "
          "a^4 and N = -(pi / 2) psi^2 a^4 (C1 + 2 C2). On the lattice the cylinder is a prism with steps; the "
          "spacing is such that its cross-section has the area of the disc. Two layers beyond each end are held at "
          "their exact positions; moment and thrust are the loads that they carry.",
      .quantities = {{.name = "moment",
                      .unit = "N mm",
                      .answer = 1e3 * pi * (tissue.c1 + tissue.c2) * twist * a4,
                      .source = "exact"},
                     {.name = "thrust",
                      .unit = "N",
                      .answer = -pi / 2 * twist * twist * a4 * (tissue.c1 + 2 * tissue.c2),
                      .source = "exact"}},
      .across = "cells across the diameter",
      .sizes = {5, 6, 7, 8, 9, 10, 12, 14, 16},
      .methods = {paper, shear_wave, mean_dilatation, bar_mean_dilatation},
      .run = wring,
      .remark =
          "The cross-section with steps is not a disc: its corners carry little shear, so its moment lies a little "
          "below that of the disc once the stiffness of the stabiliser has vanished. The thrust, a second-order "
          "effect, has a larger error, which fluctuates with the shape of the cross-section; with E_hat = E it is "
          "closer to the answer, because the stiffness of the stabiliser compensates."};
}

}  // namespace verification
