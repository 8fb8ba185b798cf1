// SPDX-License-Identifier: MIT
#include "hmps/terms/sheet_stabiliser.hpp"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <cstdio>

#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "sheets.hpp"

namespace sheet_stabiliser_test {

using namespace sheets;

/// Calls `use(terms...)` with the internal forces that are chosen for a sheet of unit shear modulus.
template <class Use>
auto with_chosen(int layers, double bulk, Use&& use) {
  const auto [modulus, share] = hmps::sheet_stabiliser(layers, bulk, 1.0);
  const auto stabiliser = hmps::artificial(modulus);
  const auto law = hmps::elastic(material(share.law));
  if (share.mean > 0) return use(stabiliser, law, hmps::mean_dilatation(share.mean));
  return use(stabiliser, law);
}

/// Bending waves in a sheet: the relative error of their frequency.
class Bending {
 public:
  Bending(int layers, double bulk) : sheet_(layers, 1.75, bonds), h_(layers), bulk_(bulk) {}

  [[nodiscard]] double operator()(double kh, const Vector& along, const auto&... terms) const {
    return sheet_.bending(kh / h_ * along.normalized(), terms...) / plate(kh / h_, h_, bulk_) - 1;
  }

 private:
  static constexpr int bonds = 6;  // the scales of neighbourhoods feel the rim of the patch beyond four
  Sheet sheet_;
  double h_, bulk_;
};

const Vector along_x(1, 0, 0), diagonal(1, 1, 0);

// Sheets of two or more particles bend as they should, while without a mean dilatation those of an even number lock.
// Prints the table in docs/theory.md.
TEST(SheetStabiliser, PreventsLockingOfSheets) {
  std::printf(
      "| kappa/mu | layers | without | mean dilatation | 45 degrees | k h = 1.5 | E_hat = mu | 3/2 mu | chosen |\n"
      "|---|---|---|---|---|---|---|---|---|\n");
  const double modulus = hmps::shear_wave_modulus(1.0);
  for (const double bulk : {3.0, 5.0, 10.0, 15.0, 20.0, 30.0, 100.0, 300.0}) {
    const auto split = hmps::split_bulk_modulus(bulk, 1.0);
    for (const int layers : {2, 3, 4, 5, 8}) {
      const Bending error(layers, bulk);
      const auto averaged = [&](double kh, const Vector& along, double stabiliser) {
        return error(kh, along, hmps::artificial(stabiliser), hmps::elastic(material(split.law)),
                     hmps::mean_dilatation(split.mean));
      };
      const double without = error(slender, along_x, hmps::artificial(modulus), hmps::elastic(material(bulk)));
      const double with = averaged(slender, along_x, modulus), turned = averaged(slender, diagonal, modulus);
      const double chosen =
          with_chosen(layers, bulk, [&](const auto&... terms) { return error(slender, along_x, terms...); });
      std::printf("| %.0f | %d | %+.1f | %+.1f | %+.1f | %+.1f | %+.1f | %+.1f | %+.1f |\n", bulk, layers,
                  100 * without, 100 * with, 100 * turned, 100 * averaged(1.5, along_x, modulus),
                  100 * averaged(slender, along_x, 1), 100 * averaged(slender, along_x, 1.5), 100 * chosen);
      // The errors with one choice for all sheets, and with the choice for this number of layers.
      const double bound = layers > 2 ? 0.045 : bulk < 10 ? 0.08 : 0.052;
      EXPECT_LT(std::abs(with), bound) << bulk << ' ' << layers;
      EXPECT_LT(std::abs(turned), bound) << bulk << ' ' << layers;
      EXPECT_LT(std::abs(chosen), layers == 2 ? 0.03 : 0.017) << bulk << ' ' << layers;
      if (layers == 2 && bulk > 5) {
        EXPECT_GT(without, 0.5) << "it would not lock without either";
      }
    }
  }
}

// Also between the ratios of the table, and where the choice changes.
TEST(SheetStabiliser, HoldsForEveryBulkModulus) {
  for (const double bulk : {3.5, 4.0, 4.99, 7.0, 9.99, 12.0, 14.99, 50.0, 99.9, 150.0, 200.0})
    for (const int layers : {2, 3, 4, 6}) {
      const Bending error(layers, bulk);
      for (const Vector& along : {along_x, diagonal}) {
        const double chosen =
            with_chosen(layers, bulk, [&](const auto&... terms) { return error(slender, along, terms...); });
        EXPECT_LT(std::abs(chosen), layers == 2 ? 0.05 : 0.02) << bulk << ' ' << layers << ' ' << along.transpose();
      }
    }
}

// Motions of a few spacings still cost energy, and none is stiffer than with the paper's E_hat = E.
TEST(SheetStabiliser, LeavesNoSpuriousModeAndNoSmallerStep) {
  const double pi = std::acos(-1.0);
  for (const double bulk : {3.0, 20.0, 300.0})
    for (const int layers : {2, 3, 4, 5}) {
      const Sheet sheet(layers, 1.75, 6);
      const double young = 9 * bulk / (3 * bulk + 1);
      for (const Vector& k : {Vector(pi / 2, 0, 0), Vector(pi, 0, 0), Vector(pi / 2, pi / 2, 0), Vector(pi, pi, 0)}) {
        const auto eigenvalues = [&](const auto&... terms) -> Eigen::VectorXd {
          return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXcd>(sheet.stiffness(k, terms...), Eigen::EigenvaluesOnly)
              .eigenvalues();
        };
        const auto chosen = with_chosen(layers, bulk, eigenvalues);
        const auto paper = eigenvalues(hmps::artificial(young), hmps::elastic(material(bulk)));
        EXPECT_GT(chosen.minCoeff(), 0.5) << bulk << ' ' << layers << ' ' << k.transpose();
        EXPECT_LT(chosen.maxCoeff(), paper.maxCoeff()) << bulk << ' ' << layers << ' ' << k.transpose();
      }
    }
}

TEST(SheetStabiliser, NamesTheInvalidArgument) {
  EXPECT_THROW((void)hmps::sheet_stabiliser(1, 10.0, 1.0), hmps::InputError);
  EXPECT_THROW((void)hmps::sheet_stabiliser(3, -1.0, 1.0), hmps::InputError);
  EXPECT_THROW((void)hmps::sheet_stabiliser(3, 10.0, 0.0), hmps::InputError);
}

}  // namespace sheet_stabiliser_test
