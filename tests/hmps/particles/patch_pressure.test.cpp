// SPDX-License-Identifier: MIT
#include "hmps/particles/patch_pressure.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "hmps/particles/surface_lattice.hpp"
#include "hmps/shapes/solid_surfaces.hpp"
#include "hmps/shapes/surfaces.hpp"

namespace patch_pressure_test {

using namespace hmps;
using V = Vector<double, 3>;

constexpr double l0 = 2e-3, particle = l0 * l0 * l0, pressure = 2e3;

/// A brick along the lattice, or a ball, with the lattice inside.
struct Body {
  SurfaceMesh<double> mesh;
  std::vector<V> x = fill_lattice(mesh, l0, V::Constant(l0 / 2)), f{x.size(), V::Zero()};

  explicit Body(SurfaceMesh<double> surface) : mesh(std::move(surface)) {}
  [[nodiscard]] V force() const {
    V sum = V::Zero();
    for (const V& density : f) sum += particle * density;
    return sum;
  }
  [[nodiscard]] V torque() const {
    V sum = V::Zero();
    for (std::size_t i = 0; i < x.size(); ++i) sum += particle * x[i].cross(f[i]);
    return sum;
  }
  void move(const Matrix<double, 3>& F, const V& shift) {
    for (V& place : x) place = F * place + shift;
  }
};
Body brick() { return Body(hmps_test::box_surface<double>(V(0, 0, 0), V(0.016, 0.012, 0.02))); }
Body ball() { return Body(hmps_test::sphere_surface<double>(V(0.01, 0, 0), 0.011, 3)); }

// A sum of a few thousand numbers of at most 10 p l0^2, each with a few roundings.
constexpr double rounding = 1e-13 * pressure * 1e-3;

TEST(PatchPressure, SumsToPressureTimesAreaThatFollowsTheBody) {
  Body body = brick();
  const auto top = surface_patch(body.mesh, [](const V&, const V& normal) { return normal[2] > 0.5; });
  const PatchPressure load(vectors(body.x), top, l0);
  load.add(vectors(body.x), vectors(body.f), pressure, particle);
  EXPECT_NEAR((body.force() - V(0, 0, -pressure * 0.016 * 0.012)).norm(), 0, rounding);
  // There is no torque about the middle of the patch.
  EXPECT_NEAR((body.torque() - V(0.008, 0.006, 0.02).cross(body.force())).norm(), 0, rounding);

  // Stretched by two along x, then turned: the force is that on twice the area, and normal to it.
  const Matrix<double, 3> R = Eigen::AngleAxisd(0.9, Eigen::Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  const Matrix<double, 3> stretch = V(2, 1, 0.5).asDiagonal();
  body.move(R * stretch, V(1, 0, -1));
  std::fill(body.f.begin(), body.f.end(), V::Zero());
  load.add(vectors(body.x), vectors(body.f), pressure, particle);
  EXPECT_NEAR((body.force() + pressure * 2 * 0.016 * 0.012 * R.col(2)).norm(), 0, rounding);
  EXPECT_NEAR((load.area_at(vectors(body.x)) - 2 * 0.016 * 0.012 * R.col(2)).norm(), 0, 1e-13 * 1e-3);
}

TEST(PatchPressure, OnAClosedSurfaceHasNoForceNorTorque) {
  for (Body body : {brick(), ball()}) {
    const PatchPressure load(vectors(body.x), body.mesh, l0);
    // Any motion, also one that is not affine.
    for (V& place : body.x) place += 0.1 * V(place[1], place[2] * place[0] / l0, place[0] * place[0] / l0);
    load.add(vectors(body.x), vectors(body.f), pressure, particle);
    EXPECT_NEAR(body.force().norm(), 0, rounding);
    EXPECT_NEAR(body.torque().norm(), 0, rounding);
  }
}

TEST(PatchPressure, DoesTheWorkOfAPressureOnTheVolume) {
  Body body = ball();
  const PatchPressure load(vectors(body.x), body.mesh, l0);
  load.add(vectors(body.x), vectors(body.f), pressure, particle);
  Matrix<double, 3> rate;
  rate << 0.3, 0.5, -0.2, 0.1, 0.4, 0.6, 0, -0.7, 0.5;  // velocity gradient in 1/s
  double power = 0;
  for (std::size_t i = 0; i < body.x.size(); ++i) power += particle * body.f[i].dot(rate * body.x[i]);
  EXPECT_NEAR(power, -pressure * rate.trace() * volume(body.mesh), rounding);
}

TEST(PatchPressure, TakesParticlesOfTheirOwnVolumeAndAddsToWhatIsThere) {
  Body body = brick();
  const PatchPressure load(vectors(body.x), body.mesh, l0);
  std::vector<double> volumes(body.x.size(), particle / 2);
  std::vector<V> half(body.x.size(), V(0, 0, 1)), whole(body.x.size(), V::Zero());
  load.add(vectors(body.x), vectors(half), pressure, scalars(volumes));
  load.add(vectors(body.x), vectors(whole), pressure, particle);
  for (std::size_t i = 0; i < half.size(); ++i)
    EXPECT_NEAR((half[i] - V(0, 0, 1) - 2 * whole[i]).norm(), 0, 1e-12 * (1 + half[i].norm()));
}

TEST(PatchPressure, RefusesWhatDoesNotFit) {
  Body body = brick();
  const PatchPressure load(vectors(body.x), body.mesh, l0);
  std::vector<V> few(3);
  EXPECT_THROW(load.add(vectors(body.x), vectors(few), pressure, particle), InputError);
  EXPECT_THROW(load.add(vectors(few), vectors(few), pressure, particle), InputError);
  EXPECT_THROW(load.add(vectors(body.x), vectors(body.f), pressure, 0.0), InputError);
  // The spacing instead of its cube, the volume of the whole body, and volume and pressure in the wrong order.
  EXPECT_THROW(load.add(vectors(body.x), vectors(body.f), pressure, l0), InputError);
  EXPECT_THROW(load.add(vectors(body.x), vectors(body.f), pressure, 480 * particle), InputError);
  EXPECT_THROW(load.add(vectors(body.x), vectors(body.f), particle, pressure), InputError);
  EXPECT_THROW(load.add(vectors(body.x), vectors(body.f), std::numeric_limits<double>::infinity(), particle),
               InputError);
}

std::string said_of(const auto& call) {
  try {
    call();
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing";
}

// A spacing that is far too short used to make millions of triangles first, and the error then asked for a shorter one.
TEST(PatchPressure, NamesItsSpacingWhereItDoesNotFit) {
  const Body body = brick();
  for (const double times : {1e-5, 0.01, 0.1, 10., 100.}) {
    const auto said = said_of([&] { (void)PatchPressure(vectors(body.x), body.mesh, times * l0); });
    EXPECT_NE(said.find("the spacing of PatchPressure is"), std::string::npos) << said;
    EXPECT_NE(said.find("0.002 m apart"), std::string::npos) << said;
  }
}

TEST(PatchPressure, NamesTheVolumeThatDoesNotFit) {
  Body body = brick();
  const PatchPressure load(vectors(body.x), body.mesh, l0);
  const std::vector<double> whole(body.x.size(), 480 * particle);
  for (const auto& said : {said_of([&] { load.add(vectors(body.x), vectors(body.f), pressure, 480 * particle); }),
                           said_of([&] { load.add(vectors(body.x), vectors(body.f), pressure, scalars(whole)); })}) {
    EXPECT_NE(said.find("the `volume` of PatchPressure::add"), std::string::npos) << said;
  }
}

// A pressure on it would pull.
TEST(PatchPressure, OnAPatchThatFacesTheBodyIsRefused) {
  const double a = 6e-3;
  SurfaceMesh<double> patch;
  patch.vertices = {V(0, 0, a), V(a, 0, a), V(a, a, a), V(0, a, a)};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}};
  std::vector<V> points;
  for (int i = 0; i < 27; ++i) points.emplace_back(V(i % 3, i / 3 % 3, i / 9) * l0 + V::Constant(l0 / 2));
  EXPECT_NO_THROW(PatchPressure(vectors(points), patch, l0));
  for (auto& t : patch.triangles) std::swap(t[1], t[2]);
  EXPECT_THROW(PatchPressure(vectors(points), patch, l0), InputError);
}

SurfaceMesh<double> top_of(const Body& body, double shift) {
  auto top = surface_patch(body.mesh, [](const V&, const V& normal) { return normal[2] > 0.5; });
  for (V& corner : top.vertices) corner[2] += shift;
  return top;
}

// Two spacings outside, relax ended in NaN; inside, the force was wrong by a sixth.
TEST(PatchPressure, RefusesAPatchOutsideOrInsideTheBody) {
  const Body body = brick();
  for (const double shift : {2., 3., 5.}) {
    const auto said = said_of([&] { (void)PatchPressure(vectors(body.x), top_of(body, shift * l0), l0); });
    EXPECT_NE(said.find("a patch of"), std::string::npos) << said;
    EXPECT_NE(said.find("lies outside the body"), std::string::npos) << said;
    EXPECT_NE(said.find("at the same place"), std::string::npos) << said;
  }
  for (const double shift : {-2., -2.5, -3., -5.}) {
    const auto said = said_of([&] { (void)PatchPressure(vectors(body.x), top_of(body, shift * l0), l0); });
    EXPECT_NE(said.find("lies inside the body"), std::string::npos) << shift << ' ' << said;
  }
  const auto outside = said_of([&] { (void)PatchPressure(vectors(body.x), top_of(body, 2 * l0), l0); });
  EXPECT_NE(outside.find("2.5"), std::string::npos) << outside;
  const auto inside = said_of([&] { (void)PatchPressure(vectors(body.x), top_of(body, -2 * l0), l0); });
  EXPECT_NE(inside.find("reach 0.003 m ahead of it, 1.5 spacings"), std::string::npos) << inside;
}

TEST(PatchPressure, TakesAPatchUpToASpacingFromTheSurface) {
  const Body body = brick();
  for (const double shift : {-1., -0.5, 0., 0.5, 1.})
    EXPECT_NO_THROW(PatchPressure(vectors(body.x), top_of(body, shift * l0), l0)) << shift;
}

// Whatever the number of layers: a sheet of four has two of them ahead of its middle surface.
TEST(PatchPressure, TakesTheMiddleSurfaceOfASheet) {
  for (const int layers : {2, 3, 4, 5}) {
    const Body sheet(hmps_test::box_surface<double>(V(0, 0, 0), V(0.016, 0.016, layers * l0)));
    EXPECT_NO_THROW(PatchPressure(vectors(sheet.x), top_of(sheet, -0.5 * layers * l0), l0)) << layers;
  }
}

// The particles across a narrow bore are not the body ahead of its wall.
TEST(PatchPressure, TakesTheWallOfANarrowBore) {
  const double inner = 1.2 * l0, outer = 4.2 * l0, length = 8 * l0;
  const Body tube(revolved_surface<double>({{inner, 0}, {outer, 0}, {outer, length}, {inner, length}}, 32));
  const auto bore = surface_patch(tube.mesh, [&](const V& at, const V& normal) {
    return std::abs(normal[2]) < 0.5 && at.head<2>().norm() < 2 * l0;
  });
  EXPECT_NO_THROW(PatchPressure(vectors(tube.x), bore, l0));
}

// `refine` asked for a larger length instead.
TEST(PatchPressure, AsksForTheUnitOfAPatchInMillimetres) {
  const Body body = brick();
  auto top = top_of(body, 0);
  for (V& corner : top.vertices) corner *= 1000;
  const auto said = said_of([&] { (void)PatchPressure(vectors(body.x), top, l0); });
  EXPECT_NE(said.find("is 16 m large"), std::string::npos) << said;
  EXPECT_NE(said.find("which reach over 0.02 m"), std::string::npos) << said;
  EXPECT_NE(said.find("a scale of 1e-3"), std::string::npos) << said;
}

}  // namespace patch_pressure_test
