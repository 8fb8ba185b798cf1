// SPDX-License-Identifier: MIT
// A body that is given as a surface of triangles is held at its base and pressed by a plate until it is at rest.
//
//   press [PARTICLES [SURFACE [SCALE]]]
//
// SURFACE is a closed .stl or .obj file, SCALE the metres in its unit, 1e-3 for millimetres. The folder `press`
// receives particles and surface for ParaView, press.pvd and surface.pvd, and a picture, press.png.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

#include "../common/error.hpp"
#include "../common/numbers.hpp"
#include "../common/streams.hpp"
#include "organ.hpp"
#include "output.hpp"

void run(const hmps::SurfaceMesh<double>& mesh, double particles) {
  using Vector = hmps::Vector<double, 3>;
  const double young = 20e3, poisson = 0.45, rho = 1000, squeeze = 0.25;  // Pa, -, kg/m3, share of the height

  // The body is the lattice in its surface, without what hangs by a few bonds or not at all. Behind it comes the plate,
  // above it.
  const Vector lower = hmps::bounds(mesh).lower, upper = hmps::bounds(mesh).upper;
  const double height = upper[2] - lower[2], volume = hmps::volume(mesh), l0 = std::cbrt(volume / particles);
  const auto sites = hmps::fill_lattice(mesh, l0);
  std::vector<Vector> reference;
  for (const auto i : hmps::supported_particles(hmps::vectors(sites), {.spacing = l0, .smallest_piece = 0.5}))
    reference.push_back(sites[i]);
  const std::size_t n = reference.size();
  const double beyond = 2 * l0 + squeeze * height;  // since what is pressed grows broader
  const Vector start(lower[0] - beyond, lower[1] - beyond, upper[2]);
  const hmps::Box<double, 3> plate{start, Vector(upper[0] + beyond, upper[1] + beyond, upper[2] + 2 * l0)};
  for (const Vector& r : hmps::fill_lattice(plate, l0, Vector(start.array() + l0 / 2))) reference.push_back(r);

  // The state, and views of it.
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity, seen = load;
  std::vector<hmps::Matrix<double, 3>> gradient(reference.size(), hmps::Matrix<double, 3>::Identity());
  const auto X = hmps::vectors(std::as_const(reference));
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto F = hmps::matrices(gradient);

  // What holds the body together; and contact, which sees the particles of its skin where the surface is.
  const hmps::LatticeBonds<double, 3> bonds(X.part(0, n), {.spacing = l0});
  const auto tissue = hmps::NeoHookean<>::from_young_poisson(young, poisson);
  auto internal = hmps::internal_force(bonds, hmps::elastic(tissue), hmps::record(F.part(0, n)),
                                       hmps::artificial(hmps::shear_wave_modulus(tissue.shear_modulus())));
  const auto skin = hmps::surface_layers(X.part(0, n), l0).outermost;
  std::vector<hmps::Index> wall;
  for (std::size_t i = n; i < reference.size(); ++i) wall.push_back(static_cast<hmps::Index>(i));
  const hmps::SurfaceCorrection<double, 3> raised(X, skin, hmps::MeshDistance<double>(mesh), l0);
  hmps::MetaballContact<double, 3> contact(
      {.spacing = l0, .density = rho, .stiffness = hmps::PenaltyStiffness::fixed(10 * young / (l0 * l0))});
  const auto pressed = contact.add_organ({"body", skin}), pressing = contact.add_organ({"plate", {}, wall});
  contact.add_pair(pressed, pressing, {.roles = hmps::Roles::only_first_is_slave});
  const auto force = [&](const auto& at, const auto& speed, const auto& density) {
    internal(at.part(0, n), speed.part(0, n), density.part(0, n));
    raised(at, F, hmps::vectors(seen));
    // Without friction its step does not matter. With friction it should be about that of relax.
    contact.add(hmps::vectors(std::as_const(seen)), speed, F, density, 1e-6);
  };

  // What is held: the base, the lowest tenth of the surface; and the plate, which goes down by a third of a spacing at
  // a time. At rest: what is unbalanced is small beside what the plate felt before, or, at first, beside a thousandth
  // of E times the strain on the mean section.
  const auto base = hmps::surface_patch(
      mesh, [&](const Vector& middle, const Vector&) { return middle[2] < lower[2] + height / 10; });
  std::vector<char> moves(reference.size(), 0);
  std::fill_n(moves.begin(), n, char(1));
  for (const auto i : hmps::particles_near(X.part(0, n), base, l0)) moves[i] = 0;
  hmps::RelaxationSettings settings{
      .spacing = l0, .tolerance = 3e-3, .load = 1e-3 * young * squeeze * volume / height, .moves = [&](std::size_t i) {
        return moves[i] != 0;
      }};
  press::Output output(mesh, X.part(0, n), l0, plate, 1.5 * young * squeeze);
  const int steps = static_cast<int>(std::ceil(3 * squeeze * height / l0));
  for (int k = 0; k <= steps; ++k) {
    const double depth = squeeze * height * k / steps;
    for (std::size_t i = n; i < reference.size(); ++i) position[i][2] = reference[i][2] - depth;
    if (k > 0) hmps::relax(force, x, v, f, rho, settings);
    double reaction = 0;
    for (std::size_t i = n; i < reference.size(); ++i) reaction += l0 * l0 * l0 * load[i][2];
    settings.load = std::max(settings.load, reaction);
    output.add(x.part(0, n), F.part(0, n), tissue, depth, reaction);
  }
  output.save();
}

int main(int argc, char** argv) try {
  examples::check_standard_streams("press");
  examples::require(argc <= 4, "press: '", argv[std::min(argc - 1, 4)], "' is one argument too many; give at most the ",
                    "number of particles, a surface and its scale");
  const auto number = [&](int k, const char* name, double otherwise) {
    const auto value = argc > k ? examples::decimal<double>(argv[k]) : otherwise;
    examples::require(value.value_or(0) > 0, "press: ", name, " is '", argv[std::min(k, argc - 1)],
                      "'; give a positive number");
    return *value;
  };
  const double particles = number(1, "PARTICLES", 3000), scale = number(3, "SCALE", 1);
  run(argc > 2 ? hmps::read_surface(argv[2], scale) : press::organ(), particles);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
