// SPDX-License-Identifier: MIT
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "stability/body.hpp"
#include "stability/groups.hpp"

namespace stability {
namespace rejected_input_detail {
namespace {

template <class List>
void bond(const std::vector<Vector>& points) {
  const List bonds(hmps::vectors(points), {.spacing = spacing});
}

}  // namespace
}  // namespace rejected_input_detail

Table rejected_input() {
  using namespace rejected_input_detail;
  Table table{"rejected_input", {"Input", "Message"}};
  const auto refuse = [&](const std::string& input, const std::function<void()>& call) {
    std::string words = "nothing";
    try {
      call();
    } catch (const hmps::Error& error) {
      words = error.what();
    }
    table.check(words.find("particle") != std::string::npos, input + " is not refused by naming a particle");
    table.rows.push_back({input, words});
  };
  const auto cube = lattice(4, 4, 4, spacing, Vector::Zero());
  const auto sheet = lattice(6, 6, 1, spacing, Vector::Zero());
  auto twins = cube;
  twins.push_back(cube[21]);
  auto lone = cube;
  lone.push_back(Vector(20 * spacing, 0, 0));
  auto bridged = cube;
  bridged.push_back(Vector(0, 0, 4 * spacing));
  bridged.push_back(Vector(0, 0, 5 * spacing));
  auto absent = cube;
  absent[7][1] = std::numeric_limits<double>::quiet_NaN();
  using Lattice = hmps::LatticeBonds<double, 3>;
  using List = hmps::BondList<double, 3>;
  refuse("a sheet of one layer, lattice", [&] { bond<Lattice>(sheet); });
  refuse("a sheet of one layer, list", [&] { bond<List>(sheet); });
  refuse("two particles in one place, lattice", [&] { bond<Lattice>(twins); });
  refuse("two particles in one place, list", [&] { bond<List>(twins); });
  refuse("a particle without neighbours, lattice", [&] { bond<Lattice>(lone); });
  refuse("a particle without neighbours, list", [&] { bond<List>(lone); });
  refuse("a row of two on a corner", [&] { bond<Lattice>(bridged); });
  refuse("a position that is not a number, lattice", [&] { bond<Lattice>(absent); });
  refuse("a position that is not a number, list", [&] { bond<List>(absent); });
  refuse("a force that is not finite, stable_step", [&] {
    Body<double> body(spacing, cube);
    const auto force = [](const auto&, const auto&, const auto& f) {
      f(5, 0) = std::numeric_limits<double>::infinity();
    };
    (void)hmps::stable_step(force, body.x(), body.v(), density, {.spacing = spacing});
  });
  return table;
}

}  // namespace stability
