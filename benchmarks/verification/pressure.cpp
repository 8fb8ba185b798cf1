// SPDX-License-Identifier: MIT
// Plane strain under loads on faces.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace pressure_detail {
namespace {

using Vector = hmps::Vector<double, 2>;
using Tensor = hmps::Matrix<double, 2>;

/// The outward surface area of each particle per volume, in 1/m: vectors b such that a uniform stress P is in
/// equilibrium with the force densities P b. They vanish inside, and over the particles below a face they add up to its
/// area.
std::vector<Vector> surface(const hmps::LatticeBonds<double, 2>& bonds) {
  std::vector<Vector> b(bonds.size(), Vector::Zero());
  for (std::size_t i = 0; i < b.size(); ++i)
    bonds.for_each_bond(i, [&](std::size_t j, const auto& r0, double w) {
      b[i] -= w * ((bonds.shape_inverse(i) + bonds.shape_inverse(j)) * r0);
    });
  return b;
}

/// The displacement at `point`, from the nearest particle and its gradient.
Vector near(const Body<2>& body, const Vector& point) {
  const std::size_t i = nearest(body, point);
  return body.displacement(i) + (body.gradient[i] - Tensor::Identity()) * (point - body.reference[i]);
}

/// The rubber of problems 15 and 16, whose answers are those of the incompressible limit.
const hmps::MooneyRivlin<> rubber{80e6, 20e6, 1e11};

/// Adds the load of Cauchy's stress `share` * `sigma` on the faces whose areas are `b`.
auto with_pressure(auto& internal, Body<2>& body, const std::vector<Vector>& b, const Tensor& sigma,
                   const double& share) {
  return [&internal, &body, &b, &share, sigma](const auto& x, const auto& v, const auto& f) {
    internal(x, v, f);
    for (std::size_t i = 0; i < f.size(); ++i) {
      const Tensor& F = body.gradient[i];
      f.add(i, share * F.determinant() * (sigma * (F.inverse().transpose() * b[i])));
    }
  };
}

Measured wall(int n, const Method& method) {
  const double l0 = 1.0 / n;
  const std::array<int, 2> count{n, 2 * n};
  Body<2> body(l0, cells<2>(l0, count));
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0});
  const auto b = surface(bonds);
  with_force(method, body.F(), bonds, rubber, [&](auto& internal) {
    double share = 0;
    const Tensor sigma = Vector(-50e6, 100e6).asDiagonal();
    const auto force = with_pressure(internal, body, b, sigma, share);
    for (int part = 1; part <= 5; ++part) {
      share = part / 5.0;
      settle(body, force, all_move, 200e6, 1e-6);
    }
  });
  const auto at = [&](double x, double y) { return displacement_at<2>(body, count, Vector(x, y)); };
  return {l0, body.size(), {at(1, 1)[0] - at(0, 1)[0], at(0.5, 2)[1] - at(0.5, 0)[1]}};
}

Measured tube(int n, const Method& method) {
  constexpr double inner = 7, outer = 18.625, pressure = 100e6;
  const double l0 = 2 * outer / n;
  const auto ring = [](const Vector& x) { return std::max(x.norm() - outer, inner - x.norm()); };
  const Vector corner = Vector::Constant(outer);
  Body<2> body(l0, hmps::fill_lattice(ring, hmps::Box<double, 2>{-corner, corner}, l0,
                                      Vector(Vector::Constant(n % 2 == 0 ? l0 / 2 : 0))));
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0});
  auto b = surface(bonds);
  for (std::size_t i = 0; i < body.size(); ++i)
    if (body.reference[i].norm() > (inner + outer) / 2) b[i].setZero();
  with_force(method, body.F(), bonds, rubber, [&](auto& internal) {
    double share = 0;
    const Tensor sigma = -pressure * Tensor::Identity();
    const auto force = with_pressure(internal, body, b, sigma, share);
    for (int part = 1; part <= 5; ++part) {
      share = part / 5.0;
      settle(body, force, all_move, 2 * std::numbers::pi * inner * pressure, part < 5 ? 1e-2 : 1e-4);
    }
  });
  // r^2 - R^2 is the same throughout an incompressible tube; at each face it is taken from the particles nearest to it.
  const auto widened = [&](double radius) {
    double sum = 0, count = 0;
    for (std::size_t i = 0; i < body.size(); ++i)
      if (std::abs(body.reference[i].norm() - radius) < 2 * l0)
        sum += body.position[i].squaredNorm() - body.reference[i].squaredNorm(), ++count;
    return std::sqrt(radius * radius + sum / count) - radius;
  };
  return {l0, body.size(), {widened(inner), widened(outer)}};
}

Measured cook(int n, const Method& method) {
  constexpr double width = 0.048, left = 0.044, right = 0.016, traction = 6.25e6;
  const double l0 = width / n;
  const auto panel = [&](const Vector& x) {
    const double below = left / width * x[0], above = left + right / width * x[0];
    return std::max(below - x[1], x[1] - above);
  };
  const hmps::Box<double, 2> box{Vector(-method.held * l0, -0.01), Vector(width, left + right)};
  Body<2> body(l0, hmps::fill_lattice(panel, box, l0, Vector(Vector::Constant(l0 / 2))));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0; };
  const hmps::LatticeBonds<double, 2> bonds(body.X(), {.spacing = l0});
  // The weights with which the two columns at the loaded face carry the load; the steps of the sloping faces near them
  // do not count.
  std::vector<double> share(body.size(), 0);
  double total = 0;
  for (std::size_t i = 0; i < body.size(); ++i) {
    const double depth = (width - body.reference[i][0]) / l0;
    share[i] = depth < 1 ? 1.5 : depth < 2 ? -0.5 : 0;
    total += share[i] * body.volume();
  }
  with_force(method, body.F(), bonds, hmps::LinearElastic<>::from_young_poisson(70e6, 1.0 / 3), [&](auto& internal) {
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x, v, f);
      for (std::size_t i = 0; i < f.size(); ++i) f(i, 1) += traction * right * share[i] / total;
    };
    settle(body, force, moves, traction * right, 1e-4);
  });
  return {l0, body.size(), {1e3 * near(body, Vector(width, left + right))[1]}};
}

const std::string on_faces =
    " The load acts on the particles as the force densities with which a uniform stress would be in equilibrium on "
    "the lattice, so a straight face under a uniform load causes no error.";

}  // namespace
}  // namespace pressure_detail

Problem long_wall() {
  using namespace pressure_detail;
  return {
      .name = "long wall",
      .title = "15. Long wall",
      .text =
          "A block of 1 x 2 m in plane strain, Mooney-Rivlin with C1 = 80 MPa and C2 = 20 MPa, under -50 MPa across "
          "and 100 MPa along, per area of the deformed faces. The answer is that of an incompressible material; here "
          "kappa / mu is 1000." +
          on_faces,
      .quantities =
          {{.name = "across",
            .unit = "m",
            .answer = -0.1675,
            .source = "published",
            .uncertainty = 1e-4,
            .bound = 1e-3},
           {.name = "along", .unit = "m", .answer = 0.4025, .source = "published", .uncertainty = 1e-4, .bound = 1e-3}},
      .across = "particles across",
      .sizes = {4, 5, 8, 12},
      .methods = bulky_methods,
      .run = wall,
      .remark =
          "Across, the result is right to the digits of the answer; along, the remaining error comes from these "
          "digits and from mu / kappa."};
}

Problem thick_cylinder() {
  using namespace pressure_detail;
  return {
      .name = "thick cylinder",
      .title = "16. Thick cylinder",
      .text =
          "A tube of the same material in plane strain, with radii from 7 to 18.625 m, under an inner pressure "
          "of 100 MPa. It is a full ring on the lattice, whose faces have steps. All particles of the inner half of "
          "the wall are loaded, not only the two layers that `Pressure` needs, so the problem is no test of how the "
          "layers of a curved face are chosen." +
          on_faces,
      .quantities = {{.name = "inner face", .unit = "m", .answer = 3.2115, .source = "exact"},
                     {.name = "outer face", .unit = "m", .answer = 1.4291, .source = "exact"}},
      .across = "cells across the outer diameter",
      .sizes = {20, 28, 40, 56, 80, 112},
      .methods = bulky_methods,
      .run = tube,
      .remark =
          "The faces are stairs instead of circles, in a material that hardly changes its volume. The error "
          "fluctuates with the way the lattice cuts the circles, and does not decrease in this range: the "
          "lattice is at its worst on curved faces under pressure."};
}

Problem cooks_membrane() {
  return {
      .name = "Cook's membrane",
      .title = "21. Cook's membrane",
      .text =
          "A panel with corners at (0, 0), (48, 44), (48, 60) and (0, 44) mm in plane strain, linear, with E = 70 "
          "MPa and nu = 1/3, is held at x = 0 and loaded by a shear stress of 6.25 MPa at x = 48 mm. The result is "
          "the rise of the upper right corner. On the lattice the sloping faces have steps. The last two columns "
          "carry 3/2 and -1/2 of the load, so that its moment is that of a load at the face.",
      .quantities =
          {{.name = "rise of the corner", .unit = "mm", .answer = 32.24, .source = "published", .uncertainty = 0.04}},
      .across = "cells across the width",
      .sizes = {12, 16, 24, 36, 48, 64, 96},
      .methods = clamped_methods,
      .run = pressure_detail::cook,
      .remark =
          "The error is of first order: the face is held half a spacing too far back, and the sloping faces "
          "have steps."};
}

}  // namespace verification
