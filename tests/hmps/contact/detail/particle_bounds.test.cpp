// SPDX-License-Identifier: MIT
#include "hmps/contact/detail/particle_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "hmps/core/executor.hpp"
#include "hmps/core/view.hpp"

namespace particle_bounds_test {

using hmps::Index;
using Point = hmps::Vector<double, 3>;
using Tensor = hmps::Matrix<double, 3>;

constexpr double spacing = 1e-3, radius = 2.5e-3;

/// `count` numbered particles among three times as many: number i is particle 3 i + 1. Number 5 is in no row.
template <class S>
struct Particles {
  std::vector<Index> particle;
  std::vector<Point> x;
  std::vector<Tensor> F;
  hmps::detail::ParticleBounds<S, 3> bounds{static_cast<S>(spacing), static_cast<S>(radius)};
  explicit Particles(std::size_t count) : x(3 * count), F(3 * count, Tensor::Identity()) {
    for (std::size_t i = 0; i < x.size(); ++i) {
      x[i] = spacing * Point(static_cast<double>(i), static_cast<double>(i % 7), 1);
      if (i % 3 == 1) particle.push_back(static_cast<Index>(i));
    }
    bounds.resize(count);
  }
  Point& place(std::size_t i) { return x[particle[i]]; }
  Tensor& gradient(std::size_t i) { return F[particle[i]]; }
  bool measure(bool is_first, std::size_t since, std::size_t until) {
    return bounds.measure(
        hmps::vectors(x), hmps::matrices(F), particle, is_first, {since, until}, [](std::size_t i) { return i != 5; },
        hmps::Serial{});
  }
  [[nodiscard]] double deviation(std::size_t i, std::size_t calls) const {
    return std::sqrt(
        static_cast<double>(bounds.deviation_squared(hmps::vectors(x), particle[i], i, static_cast<S>(calls))));
  }
};

TEST(ParticleBounds, KnowNothingOfTheFirstMotion) {
  Particles<double> p(1100);  // in three chunks
  EXPECT_FALSE(p.measure(true, 3, 8));
  for (std::size_t i = 0; i < p.particle.size(); ++i) {
    EXPECT_EQ(p.bounds.place()[i], p.place(i));
    EXPECT_TRUE(p.bounds.drift()[i].isZero(0));
    EXPECT_EQ(p.bounds.strain()[i], 0.05);
    EXPECT_EQ(p.bounds.deviation()[i], std::numeric_limits<double>::max());
    EXPECT_NEAR(p.bounds.reach()[i], radius, 1e-15);
    EXPECT_NEAR(p.bounds.compression()[i], 1, 1e-12);
  }
}

TEST(ParticleBounds, ExpectEachParticleToDriftOn) {
  Particles<double> p(600);
  (void)p.measure(true, 0, 8);
  const Point step = spacing * Point(0.1, 0, -0.2);
  p.place(570) += 4 * step;
  (void)p.measure(false, 4, 10);
  EXPECT_NEAR((p.bounds.drift()[570] - step).norm(), 0, 1e-15);
  EXPECT_TRUE(p.bounds.drift()[569].isZero(0));
  EXPECT_NEAR(p.bounds.fastest(), step.norm(), 1e-15);
  // It stood still before, so it may deviate by twice as much in each call.
  EXPECT_NEAR(p.bounds.deviation()[570], 0.01 * spacing + 2 * 2.5 * 4 * step.norm(), 1e-15);
  EXPECT_NEAR(p.bounds.deviation()[569], 0.01 * spacing, 1e-15);
  EXPECT_NEAR(p.deviation(570, 0), 0, 1e-15);
  EXPECT_NEAR(p.deviation(570, 3), 3 * step.norm(), 1e-15) << "three calls later it still stands where it was";
  p.place(570) += 10 * step;
  EXPECT_NEAR(p.deviation(570, 10), 0, 1e-15);
  (void)p.measure(false, 10, 10);
  EXPECT_NEAR(p.bounds.deviation()[570], 0.01 * spacing, 1e-15) << "it moved as expected";
}

TEST(ParticleBounds, LimitDriftToHalfAndAllToWhatListsBear) {
  Particles<double> p(3);
  (void)p.measure(true, 0, 8);
  p.place(0)[1] += 0.1 * spacing;
  p.place(1)[1] += 0.001 * spacing;
  (void)p.measure(false, 1, 8);
  const double most = 0.4 * spacing, least = 0.01 * spacing;
  const double free = p.bounds.deviation()[1];
  ASSERT_LT(free, 0.1 * most);
  p.bounds.limit_travel(most, 8);
  EXPECT_NEAR(8 * p.bounds.drift()[0].norm(), 0.5 * most, 1e-15);
  EXPECT_NEAR(p.bounds.deviation()[0], 0.5 * most, 1e-15);
  EXPECT_NEAR(p.bounds.travel()[0], most, 1e-15);
  EXPECT_NEAR(8 * p.bounds.drift()[1].norm(), 0.008 * spacing, 1e-15);
  EXPECT_EQ(p.bounds.deviation()[1], free);
  EXPECT_NEAR(p.bounds.travel()[1], free + 0.008 * spacing, 1e-15);
  EXPECT_NEAR(p.bounds.deviation()[2], least, 1e-15);
}

TEST(ParticleBounds, MeasureStretchAndCompression) {
  Particles<double> p(600);
  p.gradient(590) = Eigen::Vector3d(2, 0.5, 1).asDiagonal();
  p.gradient(591) = 0.5 * Tensor::Identity();
  p.gradient(592).col(0).setZero();  // flattened
  (void)p.measure(true, 0, 8);
  const auto& b = p.bounds;
  EXPECT_GE(b.reach()[590], 2 * radius);
  EXPECT_LE(b.reach()[590], 2.2 * radius);
  EXPECT_GE(b.compression()[590], 2);
  EXPECT_NEAR((b.metric()[590].diagonal() - Point(0.25, 4, 1)).norm(), 0, 1e-12);
  EXPECT_NEAR(b.reach()[591], 0.5 * radius, 1e-15);
  EXPECT_NEAR(b.compression()[591], 2, 1e-12);
  EXPECT_LT(b.compression()[592], 0) << "no wall";
}

TEST(ParticleBounds, RefuseGradientsThatAreNone) {
  Particles<double> p(600);
  p.gradient(592).setZero();
  EXPECT_THROW((void)p.measure(true, 0, 8), hmps::InputError);
  p.gradient(592).setConstant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_THROW((void)p.measure(true, 0, 8), hmps::StateError);
}

TEST(ParticleBounds, AllowAMultipleOfTheLatestStrain) {
  Particles<double> p(8);
  (void)p.measure(true, 0, 8);
  // All lengths that B measures change by 1 - 1/1.01; the bound on this is sqrt(3) times as much for a change in all
  // directions.
  p.gradient(2) *= 1.01;
  const double change = 0.5 * std::sqrt(3.) * (1 - 1 / (1.01 * 1.01)) * 1.01 * 1.01;
  EXPECT_FALSE(p.measure(false, 4, 8));
  EXPECT_NEAR(p.bounds.strain()[2], 4 * 2 * change, 1e-12);
  EXPECT_NEAR(p.bounds.strain()[3], 0.025, 1e-12) << "half of the first";
  EXPECT_FALSE(p.measure(false, 8, 8));
  EXPECT_NEAR(p.bounds.strain()[2], 2 * 2 * change, 1e-12);
  for (int k = 0; k < 5; ++k) EXPECT_FALSE(p.measure(false, 8, 8));
  EXPECT_EQ(p.bounds.strain()[2], 0.01);
}

// Strains of 3.5 % and 7 %, where 5 % is allowed for at first.
TEST(ParticleBounds, TellWhetherAListedParticleHasDeformedFurther) {
  for (const std::size_t i : {2U, 5U})
    for (const bool is_first : {false, true})
      for (const double stretch : {1.02, 1.04}) {
        Particles<double> p(8);
        EXPECT_FALSE(p.measure(true, 0, 8));
        p.gradient(i) *= stretch;
        EXPECT_EQ(p.measure(is_first, 4, 8), i == 2 && !is_first && stretch > 1.03) << i << " " << stretch;
      }
}

TEST(ParticleBounds, MeasurePlacesFromAnOriginThatIsCloseEnough) {
  // At 30 m floats resolve 2e-6 m.
  Particles<float> p(600);
  for (Point& x : p.x) x += Point(30, 0, 0);
  (void)p.measure(true, 0, 8);
  p.bounds.centre_origin(hmps::vectors(p.x), p.particle);
  for (std::size_t i = 1; i < 600; ++i) {
    const Point apart = (p.bounds.place()[i] - p.bounds.place()[0]).cast<double>();
    EXPECT_NEAR((apart - (p.place(i) - p.place(0))).norm(), 0, 2e-4 * spacing);
    EXPECT_EQ(p.bounds.place()[i], p.bounds.place_of(hmps::vectors(p.x), p.particle[i]));
  }
  // The origin stays where it is as long as it is close enough.
  const auto first = p.bounds.place()[0];
  for (Point& x : p.x) x += Point(0.1, 0, 0);
  (void)p.measure(false, 1, 8);
  p.bounds.centre_origin(hmps::vectors(p.x), p.particle);
  EXPECT_NEAR(p.bounds.place()[0][0] - first[0], 0.1, 1e-6);
  Particles<double> wide(600);
  for (Point& x : wide.x) x += Point(30, 0, 0);
  (void)wide.measure(true, 0, 8);
  wide.bounds.centre_origin(hmps::vectors(wide.x), wide.particle);
  EXPECT_EQ(wide.bounds.place()[0], wide.place(0));
}

}  // namespace particle_bounds_test
