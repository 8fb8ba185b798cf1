// SPDX-License-Identifier: MIT
// Where stress jumps or is applied, that of single layers is wrong at any spacing: the figures of docs/choosing.md.
#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <type_traits>
#include <vector>

#include "hmps/analysis/relaxation.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/view.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/linear_elastic.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/gravity.hpp"

namespace force_stress_limits_test {

using Point = hmps::Vector<double, 3>;

/// A bar of two materials without lateral contraction hangs from its highest layer. Its stress is the weight below.
struct Bar {
  static constexpr double rho = 1000, g = 10;
  int layers;
  /// Axial stress over the exact one at the height of each layer, the lowest first; a mean over the layer.
  std::vector<double> stress;

  Bar(int layers_of_bar, double ratio) : layers(layers_of_bar), stress(static_cast<std::size_t>(layers), 0) {
    const double l0 = 0.06 / layers;
    std::vector<Point> reference;
    std::vector<int> layer;
    std::vector<double> young;
    for (int c = 0; c < layers; ++c)
      for (int a = 0; a < 4; ++a)
        for (int b = 0; b < 4; ++b) {
          reference.emplace_back(a * l0, b * l0, (c + 0.5) * l0);
          layer.push_back(c);
          young.push_back(c < layers / 2 ? 20e3 : 20e3 * ratio);
        }
    const std::size_t n = reference.size();
    const hmps::LatticeBonds<double, 3> bonds(hmps::vectors(reference), {.spacing = l0});
    const auto E = hmps::scalars(young);
    auto force = hmps::internal_force(bonds, hmps::elastic([&](const auto& at) {
                                        using T = std::decay_t<decltype(at(E))>;
                                        return hmps::LinearElastic<T>{T(0), at(E) * T(0.5)};
                                      }),
                                      hmps::artificial([&](const auto& at) { return at(E) * 2 / 3; }),
                                      hmps::gravity(rho, Point(0, 0, -g)));
    std::vector<Point> x = reference, v(n, Point::Zero()), f = v;
    hmps::relax(force, hmps::vectors(x), hmps::vectors(v), hmps::vectors(f), rho,
                {.spacing = l0, .tolerance = 1e-5, .moves = [&](std::size_t i) { return layer[i] + 1 < layers; }});
    std::vector<hmps::Matrix<double, 3>> sigma(n);
    force.first_piola_kirchhoff_stresses(hmps::vectors(x), hmps::matrices(sigma));
    for (std::size_t i = 0; i < n; ++i)
      stress[static_cast<std::size_t>(layer[i])] += sigma[i](2, 2) / (rho * g * reference[i][2]) / 16;
  }
  [[nodiscard]] double below() const { return stress[static_cast<std::size_t>(layers / 2 - 1)]; }
  [[nodiscard]] double above() const { return stress[static_cast<std::size_t>(layers / 2)]; }
  /// The mean stress of the two over that of the exact one, which is proportional to the height.
  [[nodiscard]] double mean() const { return (below() * (layers - 1) + above() * (layers + 1)) / (2 * layers); }
};

TEST(ForceStressLimits, OnlyTheMeanOfTheLayersBesideAnInterfaceIsRight) {
  for (const auto& [ratio, soft, stiff] : {std::array{1.0, 1.0, 1.0}, {3.0, 0.76, 1.22}, {10.0, 0.61, 1.36}})
    for (const int layers : {12, 24}) {
      const Bar bar(layers, ratio);
      EXPECT_NEAR(bar.below(), soft, 0.03) << ratio << ", " << layers << " layers";
      EXPECT_NEAR(bar.above(), stiff, 0.03) << ratio << ", " << layers << " layers";
      EXPECT_NEAR(bar.mean(), 1, 0.005) << ratio << ", " << layers << " layers";
    }
}

TEST(ForceStressLimits, TheLayerThatIsHeldHasTooLittleStress) {
  for (const int layers : {12, 24}) EXPECT_NEAR(Bar(layers, 1).stress.back(), 0.64, 0.02) << layers << " layers";
}

}  // namespace force_stress_limits_test
