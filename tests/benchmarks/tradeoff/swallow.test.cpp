// SPDX-License-Identifier: MIT
// With what the swallow is compared. The runs themselves take minutes.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "../../reference/temporary_folder.hpp"
#include "output/summary.hpp"
#include "tradeoff/scenes.hpp"
#include "tradeoff/sweep.hpp"

namespace swallow_test {

namespace fs = std::filesystem;

class Finer : public ::testing::Test {
 protected:
  void add(const std::string& name, const swallowing::Summary& summary) {
    fs::create_directories(folder_.path() / name);
    write_summary(folder_.path() / name / "summary.json", summary);
  }
  [[nodiscard]] tradeoff::Scene scene() const {
    return tradeoff::swallow({.out = folder_.path() / "out", .finer = folder_.path()});
  }

  static swallowing::Summary good() {
    swallowing::Summary summary;
    summary.case_name = "X1";
    summary.spacing = 1.2e-3;
    summary.friction = 0.1;
    summary.fold_time = 1.64;
    summary.tip_angle_min = -5;
    return summary;
  }

 private:
  hmps_test::TemporaryFolder folder_;
};

TEST_F(Finer, RunIsTakenAsTheAnswer) {
  swallowing::Summary coarser = good();
  coarser.spacing = 1.5e-3;
  coarser.fold_time = 1.7;
  add("a/X1", coarser);
  add("b/X1", good());
  const tradeoff::Scene found = scene();
  ASSERT_TRUE(found.known);
  EXPECT_EQ(found.known(found.standard()), (std::vector<double>{1.64, -5}));
  EXPECT_NE(found.description.find("1.2 mm"), std::string::npos);
}

TEST_F(Finer, RunOfAnotherKindIsNot) {
  swallowing::Summary other = good();
  other.case_name = "Y1";
  add("case", other);
  other = good();
  other.spacing = 1.8e-3;
  add("no_finer", other);
  other = good();
  other.friction = 0.3;
  add("friction", other);
  other = good();
  other.failure = "broke down";
  add("failed", other);
  other = good();
  other.fold_time.reset();
  add("not_folded", other);
  other = good();
  other.settings = {{"particles", "fitted"}};
  add("fitted", other);
  const tradeoff::Scene found = scene();
  EXPECT_FALSE(found.known);
  ASSERT_TRUE(found.reference.has_value());
  EXPECT_EQ(found.reference->number("spacing"), 1.8e-3);
}

TEST_F(Finer, FittedParticlesAreNotCombinedWithAShiftedLattice) {
  const tradeoff::Scene found = scene();
  const auto fitted = found.standard().with("particles", "fitted");
  EXPECT_THROW((void)found.run(fitted.with("lattice shift", 0.5)), hmps::InputError);
  for (const auto& settings : tradeoff::plan(found))
    EXPECT_TRUE(settings.word("particles") == "lattice" || settings.number("lattice shift") == 0);
}

}  // namespace swallow_test
