// SPDX-License-Identifier: MIT
// User-defined bonds: a cloud of particles that is coarse at one end and fine at the other, where the reach of each
// bond follows from the spacing at its two ends. No single radius would do. If the whole cloud is stretched and
// sheared, every particle must have the same deformation gradient, and the forces must sum to zero.
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <hmps/hmps.hpp>
#include <utility>
#include <vector>

int main() {
  using Vector = hmps::Vector<double, 3>;
  // Layers of particles, 4 mm apart in all directions at the lower end and 2 mm at the upper one.
  std::vector<Vector> reference;
  std::vector<double> spacing;
  double z = 0;
  for (const double h : {4e-3, 4e-3, 3.5e-3, 3e-3, 2.5e-3, 2e-3, 2e-3}) {
    const int count = static_cast<int>(std::lround(0.016 / h));
    for (int i = 0; i < count; ++i)
      for (int j = 0; j < count; ++j) {
        reference.push_back(Vector((i + 0.5) * 0.016 / count, (j + 0.5) * 0.016 / count, z));
        spacing.push_back(h);
      }
    z += h;
  }

  //! [bonds]
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  std::vector<double> weights;
  for (std::size_t i = 0; i < reference.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      const double r = (reference[i] - reference[j]).norm(), reach = 1.75 * (spacing[i] + spacing[j]) / 2;
      if (r >= reach) continue;
      pairs.emplace_back(i, j);
      weights.push_back(reach / r - 1);
    }
  const hmps::BondList<double, 3> bonds(hmps::vectors(reference), pairs, weights);
  //! [bonds]

  hmps::Matrix<double, 3> stretch;
  stretch << 1.1, 0.2, 0, 0, 0.9, 0.1, 0, 0, 1.05;
  std::vector<Vector> position = reference, load = reference;
  for (Vector& r : position) r = stretch * r;
  std::vector<hmps::Matrix<double, 3>> gradient(reference.size());
  auto force = hmps::internal_force(bonds, hmps::elastic(hmps::NeoHookean<>::from_young_poisson(20e3, 0.45)),
                                    hmps::artificial(10e3), hmps::record(hmps::matrices(gradient)));
  force(hmps::vectors(position), hmps::vectors(load));

  double wrong = 0, largest = 0;
  Vector sum = Vector::Zero();
  for (std::size_t i = 0; i < reference.size(); ++i) {
    wrong = std::fmax(wrong, (gradient[i] - stretch).norm());
    largest = std::fmax(largest, load[i].norm());
    sum += load[i];
  }
  std::printf("%zu particles, %zu bonds: error of F %.1e, sum of forces over the largest %.1e\n", reference.size(),
              pairs.size(), wrong, sum.norm() / largest);
  return std::fflush(stdout) == 0 && wrong < 1e-13 && sum.norm() < 1e-12 * largest ? 0 : 1;
}
