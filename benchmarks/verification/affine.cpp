// SPDX-License-Identifier: MIT
// Affine maps, rigid motions and waves in the lattice: the method should be right at any spacing.
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "verification/problems.hpp"
#include "verification/support.hpp"

namespace verification {
namespace affine_detail {
namespace {

template <int D>
using Tensor = hmps::Matrix<double, D>;

/// Particles inside `shape` near the sites of a lattice of `l0`, each shifted by up to `jitter` spacings.
template <int D, class Shape>
std::vector<hmps::Vector<double, D>> cloud(const Shape& shape, double l0, double jitter) {
  const hmps::Vector<double, D> corner = hmps::Vector<double, D>::Ones();
  auto points =
      hmps::fill_lattice(shape, hmps::Box<double, D>{-corner, corner}, l0, hmps::Vector<double, D>(corner * (l0 / 2)));
  for (std::size_t i = 0; i < points.size(); ++i)
    for (int c = 0; c < D; ++c) points[i][c] += jitter * l0 * noise(i, c);
  return points;
}

/// The largest error of F in a body under an affine map, and the largest elastic force, relative to |P| / l0, on
/// particles more than four spacings inside its surface.
struct PatchError {
  double gradient = 0, force = 0;
  std::size_t particles = 0;
  void worst(const PatchError& other) {
    gradient = std::max(gradient, other.gradient);
    force = std::max(force, other.force);
    particles += other.particles;
  }
};
template <int D, class Shape>
PatchError patch(const Shape& shape, double l0, double jitter) {
  Body<D> body(l0, cloud<D>(shape, l0, jitter));
  Tensor<D> F = Tensor<D>::Identity();
  for (int r = 0; r < D; ++r)
    for (int c = 0; c < D; ++c) F(r, c) += 0.1 * (r == c ? r + 1 : 1 + r - 2 * c);
  for (auto& place : body.position) place = F * place;
  const hmps::BondList<double, D> bonds(body.X(), {.spacing = l0, .radius_ratio = 1.75 + 0.5 * jitter});
  auto force = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::record(body.F()));
  force(body.x(), body.f());
  const double scale = hmps::first_piola_kirchhoff(tissue, F).norm() / l0;
  PatchError error{.particles = body.size()};
  for (std::size_t i = 0; i < body.size(); ++i) {
    error.gradient = std::max(error.gradient, (body.gradient[i] - F).cwiseAbs().maxCoeff());
    if (shape(body.reference[i]) < -4 * l0) error.force = std::max(error.force, body.load[i].norm() / scale);
  }
  return error;
}
/// Every kind of surface: flat faces with edges and corners, a curved one, a sheet of two layers, a hole.
template <int D>
PatchError patches(double l0, double jitter) {
  using Vector = hmps::Vector<double, D>;
  const Vector centre = Vector::Zero();
  Vector thin = Vector::Constant(0.8);
  thin[D - 1] = 0.99 * l0;
  const hmps::Ball<double, D> ball{centre, 0.9}, hole{centre, 0.25};
  const hmps::Box<double, D> cube{Vector::Constant(-0.7), Vector::Constant(0.7)}, sheet{-thin, thin};
  PatchError error;
  error.worst(patch<D>(ball, l0, jitter));
  error.worst(patch<D>(cube, l0, jitter));
  error.worst(patch<D>(sheet, l0, 0.5 * jitter));
  error.worst(patch<D>([&](const Vector& x) { return std::max(ball(x), -hole(x)); }, l0, jitter));
  return error;
}

Measured affine(int size, const Method&) {
  const double l0 = 2.0 / size;
  PatchError lattice, jittered;
  lattice.worst(patches<2>(l0, 0));
  lattice.worst(patches<3>(l0, 0));
  jittered.worst(patches<2>(l0, 0.2));
  jittered.worst(patches<3>(l0, 0.2));
  return {l0, lattice.particles, {std::max(lattice.gradient, jittered.gradient), lattice.force, jittered.force}};
}

/// Rotates and translates bodies, with lattice bonds and with lists of bonds.
template <int D>
void turn(double l0, double& stress, double& force_density, std::size_t& particles) {
  using Vector = hmps::Vector<double, D>;
  const hmps::Ball<double, D> ball{Vector::Zero(), 0.9};
  Body<D> body(l0, cloud<D>(ball, l0, 0));
  particles += body.size();
  const hmps::LatticeBonds<double, D> bonds(body.X(), {.spacing = l0});
  for (double degrees = 0; degrees <= 100; degrees += 12.5) {
    const double angle = degrees * std::numbers::pi / 180;
    Tensor<D> R = Tensor<D>::Identity();
    if constexpr (D == 2)
      R = Eigen::Rotation2D<double>(angle).toRotationMatrix();
    else
      R = Eigen::AngleAxis<double>(angle, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
    for (std::size_t i = 0; i < body.size(); ++i) body.position[i] = R * body.reference[i] + Vector::Constant(3);
    with_force(shear_wave, body.F(), bonds, tissue, [&](auto& force) { force(body.x(), body.f()); });
    for (std::size_t i = 0; i < body.size(); ++i) {
      stress = std::max(stress, hmps::first_piola_kirchhoff(tissue, body.gradient[i]).norm());
      force_density = std::max(force_density, body.load[i].norm() * l0);
    }
  }
}

}  // namespace
}  // namespace affine_detail

Problem affine_patch() {
  return {
      .name = "affine patch",
      .title = "1. Affine patch",
      .text =
          "One affine map is applied to a ball, a cube, a sheet of two layers and a ball with a hole, in two and in "
          "three dimensions, once on the lattice and once with particles shifted at random by up to a fifth of a "
          "spacing. Every particle should have the gradient of the map, and particles more than four spacings inside "
          "the surface should feel no elastic force.",
      .quantities =
          {{.name = "F", .unit = "1", .answer = 0, .source = "exact", .scale = 1, .bound = 1e-12},
           {.name = "force inside, on the lattice",
            .unit = "P / l0",
            .answer = 0,
            .source = "exact",
            .scale = 1,
            .bound = 1e-10},
           {.name = "force inside, shifted particles", .unit = "P / l0", .answer = 0, .source = "exact", .scale = 1}},
      .across = "spacings across",
      .sizes = {12, 16, 24},
      .methods = {paper},
      .run = affine_detail::affine,
      .remark =
          "On particles that are shifted from the lattice, a uniform stress is not in equilibrium: the sums of w "
          "A^-1 r0 over the bonds do not cancel there, and refinement does not help. Statics and waves need the "
          "lattice; such a cloud is suitable only where nothing but F is needed."};
}

Problem rigid_motion() {
  using namespace affine_detail;
  return {.name = "rigid motion",
          .title = "2. Rigid motion",
          .text =
              "A ball of the paper's soft tissue, in two and in three dimensions, is moved by three times its radius "
              "and turned by 0 to 100 degrees. There should be neither stress nor force.",
          .quantities =
              {{.name = "stress", .unit = "kappa", .answer = 0, .source = "exact", .scale = 1, .bound = 1e-13},
               {.name = "force", .unit = "kappa / l0", .answer = 0, .source = "exact", .scale = 1, .bound = 1e-13}},
          .across = "spacings across",
          .sizes = {6, 12, 18},
          .methods = {shear_wave},
          .run = [](int size, const Method&) {
            Measured measured{2.0 / size, 0, {0, 0}};
            turn<2>(measured.spacing, measured.values[0], measured.values[1], measured.particles);
            turn<3>(measured.spacing, measured.values[0], measured.values[1], measured.particles);
            for (double& value : measured.values) value /= tissue.bulk_modulus();
            return measured;
          }};
}

Problem dispersion() {
  return {.name = "dispersion",
          .title = "28. Waves in the lattice",
          .text =
              "The force on a particle inside the lattice in plane waves of 2 to 40 spacings along an axis, "
              "longitudinal and transverse, for linear elasticity. With a = sum w r^2 / 3, g = sum w r sin(k r) / a "
              "and q = 2 sum w (1 - cos k r) / a, the force should be -(M g^2 + E_hat (q - g^2)) times the "
              "displacement, where M is lambda + 2 mu or mu.",
          .quantities = {{.name = "stiffness", .unit = "1", .answer = 0, .source = "exact", .scale = 1, .bound = 1e-9}},
          .across = "wavelength in spacings",
          .sizes = {2, 3, 5, 10, 40},
          .methods = methods,
          .run = [](int wavelength, const Method& method) {
            const double l0 = 1e-3;
            Body<3> body(l0, cells<3>(l0, {7, 7, 7}));
            const auto middle = nearest(body, hmps::Vector<double, 3>(hmps::Vector<double, 3>::Constant(3.5 * l0)));
            const hmps::LatticeBonds<double, 3> bonds(body.X(), {.spacing = l0});
            const hmps::LinearElastic<> law{tissue.bulk_modulus(), tissue.shear_modulus()};
            const double k = 2 * std::numbers::pi / (wavelength * l0);
            double a = 0, g = 0, q = 0, worst = 0;
            bonds.for_each_bond(middle, [&](auto, const auto& r, double w) {
              a += w * r.squaredNorm() / 3;
              g += w * std::sin(k * r[0]) * r[0];
              q += 2 * w * (1 - std::cos(k * r[0]));
            });
            g /= a;
            q /= a;
            with_force(method, body.F(), bonds, law, [&](auto& force) {
              for (int direction = 0; direction < 3; ++direction) {
                const double amplitude = 1e-3 * l0;
                body.position = body.reference;
                for (auto& place : body.position)
                  place[direction] += amplitude * std::cos(k * (place[0] - body.reference[middle][0]));
                force(body.x(), body.f());
                const double modulus = direction == 0 ? law.lambda + 2 * law.mu : law.mu;
                const double exact = modulus * g * g + modulus_of(method, law) * (q - g * g);
                worst = std::max(worst, std::abs(-body.load[middle][direction] / (exact * amplitude) - 1));
              }
            });
            return Measured{l0, body.size(), {worst}};
          }};
}

}  // namespace verification
