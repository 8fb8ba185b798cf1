// SPDX-License-Identifier: MIT
// A plate is pulled away from under a block of soft tissue. As long as it slides, friction accelerates the block with
// mu g: the program compares the speed that the block has gained with mu g t.
#include <cmath>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

int main() {
  using Vector = hmps::Vector<double, 3>;
  const double l0 = 2e-3, rho = 1000, mu = 0.2, g = 9.81, dt = 3e-5;  // m, kg/m3, -, m/s2, s

  // Two bodies in the same arrays, the plate first; they meet at z = 0.
  const hmps::Box<double, 3> plate{Vector(-0.05, -0.012, -0.006), Vector(0.03, 0.012, 0)};
  const hmps::Box<double, 3> block{Vector(-0.008, -0.008, 0), Vector(0.008, 0.008, 0.012)};
  const Vector middle = Vector::Constant(l0 / 2);
  std::vector<Vector> reference = hmps::fill_lattice(plate, l0, middle);
  const std::size_t first = reference.size();  // first particle of the block
  for (const Vector& r : hmps::fill_lattice(block, l0, middle)) reference.push_back(r);
  const auto near = [&](bool of_block, double depth) {  // the particles of one body that are close to the other
    std::vector<hmps::Index> list;
    for (std::size_t i = 0; i < reference.size(); ++i)
      if ((i >= first) == of_block && std::abs(reference[i][2]) < depth) list.push_back(static_cast<hmps::Index>(i));
    return list;
  };
  const auto plate_skin = near(false, l0), plate_wall = near(false, 2 * l0), all_of_plate = near(false, 1);
  const auto block_skin = near(true, l0), block_wall = near(true, 2 * l0);

  // The state is the user's; the library gets views of it.
  std::vector<Vector> position = reference, velocity(reference.size(), Vector::Zero()), load = velocity;
  std::vector<hmps::Matrix<double, 3>> gradient(reference.size());
  const auto x = hmps::vectors(position), v = hmps::vectors(velocity), f = hmps::vectors(load);
  const auto X = hmps::vectors(std::as_const(reference));
  const auto F = hmps::matrices(gradient);

  //! [composition]
  const auto same_body = [&](std::size_t i, std::size_t j) { return (i < first) == (j < first); };
  const hmps::LatticeBonds<double, 3> bonds(X, {.spacing = l0}, same_body);
  auto force =
      hmps::internal_force(bonds, hmps::elastic(hmps::MooneyRivlin<>::from_young(20e3, 1e6)), hmps::artificial(10e3),
                           hmps::viscous(rho, 2e-3), hmps::gravity(rho, Vector(0, 0, -g)), hmps::record(F));

  hmps::MetaballContact<double, 3, hmps::SmoothMetaball> contact({.spacing = l0, .density = rho, .friction = mu});
  const auto held = [](hmps::Index) { return true; };
  const auto below = contact.add_organ({"plate", plate_skin, plate_wall, held});
  const auto above = contact.add_organ({"block", block_skin, block_wall});
  contact.add_pair(below, above);

  const hmps::Keyframes<3> path{{.time = 0, .value = Vector::Zero()}, {.time = 0.1, .value = Vector(0.04, 0, 0)}};
  const hmps::ControlRegion pulled(all_of_plate, X, hmps::Translation<3>{path});

  const auto advance = [&](double t) {  // from t - dt to t
    force(x, v, f);                     // what holds the bodies together and their weight, N/m3
    hmps::kick(v, f, rho, dt);
    pulled.prescribe(x, v, t, dt);  // forced displacement, which contact has to see
    hmps::set_zero(f);
    contact.add(x, v, F, f, dt);  // adds what they do to each other
    pulled.unload(f);             // what is pulled follows no force
    hmps::kick(v, f, rho, dt);
    hmps::drift(x, v, dt);
  };
  //! [composition]

  double speed = 0;
  for (int step = 1; step <= 3000; ++step) {
    advance(step * dt);
    if (step % 500 != 0) continue;
    speed = 0;
    for (std::size_t i = first; i < reference.size(); ++i) speed += velocity[i][0];
    speed /= static_cast<double>(reference.size() - first);
    std::printf("t = %.3f s: plate %.3f m/s, block %.4f m/s, mu g t = %.4f m/s\n", step * dt, velocity[0][0], speed,
                mu * g * step * dt);
  }
  return std::fflush(stdout) == 0 && std::abs(speed / (mu * g * 3000 * dt) - 1) < 0.02 ? 0 : 1;
}
