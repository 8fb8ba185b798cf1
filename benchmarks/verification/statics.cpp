// SPDX-License-Identifier: MIT
// Blocks of the seed law at rest: a cantilever under its weight, a cube between bonded plates.
#include <array>
#include <cmath>

#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace statics_detail {
namespace {

using Vector = hmps::Vector<double, 3>;

Measured sag(int n, const Method& method) {
  constexpr double length = 0.06, height = 0.02, density = 1000, gravity = 9.81;
  const double l0 = height / n;
  Body<3> body(l0, cells<3>(l0, {3 * n, n, n}, method.held));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0; };
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  with_force(method, body.F(), bonds, tissue, [&](auto& internal) {
    const auto force = [&](const auto& x, const auto& v, const auto& f) {
      internal(x, v, f);
      for (std::size_t i = 0; i < f.size(); ++i) f(i, 2) -= density * gravity;
    };
    settle(body, force, moves, density * gravity * length * height * height, 3e-4);
  });
  const Vector end = displacement_at<3>(body, {3 * n, n, n}, Vector(length, height / 2, height / 2));
  return {l0, body.size(), {1e3 * end[2], 1e3 * end[0]}};
}

/// A cube between plates that face each other along the first axis. The upper one is moved by `shift` (m) in ten parts.
Measured bonded(int n, const Method& method, const Vector& shift, bool shear) {
  constexpr double side = 0.024;
  const double l0 = side / n;
  Body<3> body(l0, cells<3>(l0, {n, n, n}, method.held, method.held));
  const auto moves = [&](std::size_t i) { return body.reference[i][0] > 0 && body.reference[i][0] < side; };
  const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
  return with_force(method, body.F(), bonds, tissue, [&](auto& force) {
    constexpr int parts = 10;
    for (int part = 1; part <= parts; ++part) {
      for (std::size_t i = 0; i < body.size(); ++i)
        body.position[i] += shift / parts * std::clamp(body.reference[i][0] / side, 0.0, 1.0);
      settle(body, force, moves, 0, part < parts ? 1e-2 : 3e-4);
    }
    Vector carried = Vector::Zero();
    for (std::size_t i = 0; i < body.size(); ++i)
      if (body.reference[i][0] > side) carried -= body.load[i] * body.volume();
    if (!shear) return Measured{l0, body.size(), {-carried[0]}};
    const auto share = hmps::split_bulk_modulus(tissue.bulk_modulus(), tissue.shear_modulus());
    const auto law = method.mean_dilatation ? with_bulk_modulus(tissue, share.law) : tissue;
    double energy = hmps::strain_energy(body.F(), law, body.volume()) +
                    hmps::artificial_energy(bonds, body.x(), body.F(), modulus_of(method, tissue), body.volume());
    if (method.mean_dilatation) energy += hmps::mean_dilatation_energy(bonds, body.F(), share.mean, body.volume());
    return Measured{l0, body.size(), {carried[1], 1e3 * energy}};
  });
}

}  // namespace
}  // namespace statics_detail

Problem cantilever() {
  return {
      .name = "cantilever",
      .title = "10. Cantilever under its weight",
      .text =
          "A bar of the paper's soft tissue, 60 x 20 x 20 mm, is clamped at one end and at rest under g = 9.81 "
          "m/s2.",
      .quantities =
          {{.name = "sag of the end", .unit = "mm", .answer = -23.4, .source = "finite elements", .uncertainty = 0.1},
           {.name = "shortening", .unit = "mm", .answer = -4.38, .source = "finite elements", .uncertainty = 0.03}},
      .across = "particles across the height",
      .sizes = {3, 4, 5, 6, 7, 8, 9, 10, 11},
      .methods = all_methods,
      .run = statics_detail::sag,
      .parity = true,
      .remark =
          "With E_hat = E the stabiliser makes the bar too stiff. With 4/3 mu the result is close to the answer. At "
          "kappa / mu = 300, even numbers of particles lock a little. Mean dilatation removes the difference between "
          "odd and even numbers, but also the stiffness that compensates for the clamp, which holds the bar too far "
          "back."};
}

Problem bonded_shear() {
  using namespace statics_detail;
  return {
      .name = "bonded cube, shear",
      .title = "12. Bonded cube in shear",
      .text =
          "A 24 mm cube of the paper's soft tissue lies between bonded plates, one of which is moved sideways by 12 "
          "mm in ten parts. The answer for the energy is the work of the finite-element force, which is nearly "
          "proportional to the displacement; the energy of the particles is the strain energy plus that of the "
          "stabiliser.",
      .quantities =
          {{.name = "force", .unit = "N", .answer = 1.40, .source = "finite elements", .uncertainty = 0.02},
           {.name = "energy", .unit = "mJ", .answer = 8.48, .source = "finite elements", .uncertainty = 0.12}},
      .across = "particles along an edge",
      .sizes = {3, 4, 5, 6, 7, 8, 9, 10, 11},
      .methods = all_methods,
      .run = [](int n, const Method& method) { return bonded(n, method, Vector(0, 0.012, 0), true); },
      .parity = true,
      .remark =
          "Two held layers make the bonded faces too stiff: the displacement has a kink between them and the first "
          "free layer, which adds to the energy of the stabiliser. The source of the force also gives an energy of "
          "16.22 mJ; this is nearly twice the work of that force, and is not used."};
}

Problem bonded_compression() {
  using namespace statics_detail;
  return {
      .name = "bonded cube, compression",
      .title = "13. Bonded cube in compression",
      .text =
          "The same cube, compressed by 30 %. The strain at its edges is singular, so no answer is sharp; what "
          "matters is that the run does not break down.",
      .quantities = {{.name = "force", .unit = "N", .answer = 7.96, .source = "finite elements", .uncertainty = 0.1}},
      .across = "particles along an edge",
      .sizes = {3, 4, 5, 6, 7, 8, 9, 10, 11},
      .methods = all_methods,
      .run = [](int n, const Method& method) { return bonded(n, method, Vector(-0.3 * 0.024, 0, 0), false); },
      .parity = true,
      .remark =
          "Odd and even numbers of particles differ, as in all problems that compress a stiff volume. Mean "
          "dilatation brings them together on the soft side: the edges, which bulge most, are resolved least."};
}

}  // namespace verification
