// SPDX-License-Identifier: MIT
#include "hmps/particles/fitted.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "../../reference/message_of.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/core/view.hpp"
#include "hmps/particles/support.hpp"
#include "hmps/search/fixed_radius.hpp"
#include "hmps/shapes/combine.hpp"
#include "hmps/shapes/mesh_distance.hpp"
#include "hmps/shapes/surface_mesh.hpp"

namespace fitted_test {

using hmps_test::message_of;

using hmps::Box;
using hmps::fit_particles;
using hmps::Vector;
using V3 = Vector<double, 3>;

template <class V>
[[nodiscard]] double sum(const V& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

/// The distance of the two nearest particles.
template <class S, int D>
[[nodiscard]] double nearest(const std::vector<Vector<S, D>>& points, double reach) {
  const auto list = hmps::find_neighbours(hmps::vectors(points), static_cast<S>(reach));
  double least = reach;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const hmps::Index j : list[i]) least = std::min(least, static_cast<double>((points[i] - points[j]).norm()));
  return least;
}

/// A plate of 10 x 8 x `thickness`, turned by 65 degrees about y and moved off the lattice.
struct Plate {
  double thickness;
  hmps::Matrix<double, 3> turn = [] {
    const double c = std::cos(65 * 3.14159265358979 / 180), s = std::sin(65 * 3.14159265358979 / 180);
    hmps::Matrix<double, 3> rotation;
    rotation << c, 0, -s, 0, 1, 0, s, 0, c;
    return rotation;
  }();
  V3 moved{0.31, 0.17, 0.43};

  [[nodiscard]] V3 local(const V3& x) const { return turn.transpose() * (x - moved); }
  [[nodiscard]] double operator()(const V3& x) const {
    return Box<double, 3>{V3::Zero(), V3(10, 8, thickness)}(local(x));
  }
  [[nodiscard]] double volume() const { return 80 * thickness; }
  [[nodiscard]] static Box<double, 3> box() { return {V3(-6, -1, -1), V3(6, 10, 13)}; }
};

TEST(FitParticles, FillsATiltedPlateWithWholeLayers) {
  for (const double thickness : {2.0, 2.7, 3.0, 4.0}) {
    const Plate plate{thickness};
    const auto fitted = fit_particles(plate, Plate::box(), 1.0);
    const int layers = static_cast<int>(std::lround(thickness));
    const double apart = thickness / layers;
    // One for each cube of the spacing; rounding may change the number by one for each layer.
    EXPECT_NEAR(static_cast<double>(fitted.size()), plate.volume(), layers);
    std::vector<int> count(static_cast<std::size_t>(layers));
    for (const V3& x : fitted.positions) {
      // Away from the narrow faces, around which the layers run.
      const V3 at = plate.local(x);
      const double rim = std::min({at[0], 10 - at[0], at[1], 8 - at[1]});
      if (rim < thickness / 2 + 0.1) continue;
      const double layer = at[2] / apart - 0.5;
      EXPECT_NEAR(layer, std::round(layer), 0.03) << thickness << ": " << at.transpose();
      ++count[static_cast<std::size_t>(std::clamp(std::lround(layer), 0L, layers - 1L))];
    }
    for (const int n : count) EXPECT_NEAR(n, sum(count) / layers, 0.15 * sum(count) / layers) << thickness;
    EXPECT_LT(fitted.largest_deviation, 1e-9);
    EXPECT_GT(nearest(fitted.positions, 1.5), 0.55);
    // Along edges and in corners, half a layer from two or three faces, support is less than on a lattice.
    for (const auto& [i, support] : hmps::find_weak(hmps::vectors(fitted.positions), {.spacing = 1})) {
      const V3 at = plate.local(fitted.positions[i]), far(10 - at[0], 8 - at[1], thickness - at[2]);
      EXPECT_GE((at.cwiseMin(far).array() < 0.6).count(), 2) << at.transpose();
      EXPECT_GT(support, 0.5) << at.transpose();
    }
    EXPECT_NO_THROW((hmps::BondList<double, 3>(hmps::vectors(fitted.positions), {.spacing = 1})));
  }
}

// Also along the grid of samples, whose rows do not end where layers do. Layers at the same depth from either face of a
// wall have the same number.
TEST(FitParticles, FillsAllLayersOfABoxAlike) {
  for (const double thickness : {2.0, 3.3, 4.0, 4.45}) {
    const Box<double, 3> box{V3(0.3, 0.1, 0.2), V3(16.3, 14.1, 0.2 + thickness)};
    const auto fitted = fit_particles(box, box, 1.0);
    const int layers = static_cast<int>(std::lround(thickness));
    std::vector<int> count(static_cast<std::size_t>(layers));
    for (const V3& x : fitted.positions) {
      const V3 at = x - box.lower;
      if (std::min({at[0], 16 - at[0], at[1], 14 - at[1]}) < 2) continue;
      ++count[static_cast<std::size_t>(std::clamp(static_cast<int>(at[2] / thickness * layers), 0, layers - 1))];
    }
    // 120 spacings^2 of each layer. Without the shares of layers and faces there are 17 % too many or too few.
    for (const int n : count) EXPECT_NEAR(n, 120 * thickness / layers, 0.08 * 120) << thickness;
  }
}

TEST(FitParticles, KeepsTheOutermostLayerHalfALayerInside) {
  const Plate plate{3.0};
  const auto fitted = fit_particles(plate, Plate::box(), 1.0);
  double least = 1e9;
  std::size_t outermost = 0;
  for (const V3& x : fitted.positions) {
    least = std::min(least, -plate(x));
    outermost += -plate(x) < 0.5 + 1e-9;
  }
  EXPECT_NEAR(least, 0.5, 1e-9);
  // The volume of the layer: what is left of the plate without a box that is smaller by two in each extent.
  EXPECT_NEAR(static_cast<double>(outermost), plate.volume() - 8 * 6 * 1, 0.1 * plate.volume());
}

TEST(FitParticles, DistributesTheVolume) {
  for (const double radius : {1.2, 3.0, 4.3}) {
    const hmps::Ball<double, 3> ball{.radius = radius};
    const auto fitted = fit_particles(ball, Box<double, 3>{V3::Constant(-5), V3::Constant(5)}, 1.0);
    const double volume = 4 * 3.14159265358979 / 3 * radius * radius * radius;
    EXPECT_NEAR(sum(fitted.volumes), volume, 1e-3 * volume);
    EXPECT_NEAR(static_cast<double>(fitted.size()), volume, 4);
    EXPECT_LT(fitted.largest_deviation, 1e-9);
    ASSERT_EQ(fitted.volumes.size(), fitted.size());
    for (const double v : fitted.volumes) EXPECT_NEAR(v, volume / static_cast<double>(fitted.size()), 0.35);
  }
  const Plate plate{2.7};
  EXPECT_NEAR(sum(fit_particles(plate, Plate::box(), 1.0, {.iterations = 1}).volumes), plate.volume(),
              1e-3 * plate.volume());
}

TEST(FitParticles, FillsACurvedShellWithWholeLayers) {
  const hmps::Ball<double, 3> ball{.radius = 7};
  const auto half = hmps::intersect(hmps::shell(ball, 2.8), hmps::HalfSpace<double, 3>{V3::Zero(), V3(0, 0, 1)});
  const auto fitted = fit_particles(half, Box<double, 3>{V3(-9, -9, -9), V3(9, 9, 1)}, 1.0);
  std::vector<int> count(3);
  for (const V3& x : fitted.positions) {
    if (x[2] > -1.5) continue;
    const double layer = (ball(x) + 1.4) / (2.8 / 3) - 0.5;
    EXPECT_NEAR(layer, std::round(layer), 0.03) << x.transpose();
    ++count[static_cast<std::size_t>(std::clamp(std::lround(layer), 0L, 2L))];
  }
  // The share of each layer is that of its volume, (r + s / 2)^3 - (r - s / 2)^3.
  const double s = 2.8 / 3, all = std::pow(8.4, 3) - std::pow(5.6, 3);
  for (int k = 0; k < 3; ++k) {
    const double share = (std::pow(5.6 + (k + 1) * s, 3) - std::pow(5.6 + k * s, 3)) / all;
    EXPECT_NEAR(count[static_cast<std::size_t>(k)] / sum(count), share, 0.02) << k;
  }
  EXPECT_LT(fitted.largest_deviation, 1e-6);
}

TEST(FitParticles, WorksInTwoDimensionsAndInFloat) {
  using V = Vector<float, 2>;
  const auto ring = hmps::shell(hmps::Ball<float, 2>{.radius = 8.0F}, 3.0F);
  const auto fitted = fit_particles(ring, Box<float, 2>{V(-10, -10), V(10, 10)}, 1.0F);
  const double area = 2 * 3.14159265358979 * 8 * 3;
  EXPECT_NEAR(sum(fitted.volumes), area, 1e-3 * area);
  EXPECT_NEAR(static_cast<double>(fitted.size()), area, 3);
  for (const V& x : fitted.positions) {
    const double layer = static_cast<double>(x.norm()) - 7;
    EXPECT_NEAR(layer, std::round(layer), 0.03);
  }
  EXPECT_GT(nearest(fitted.positions, 1.5), 0.7);
}

TEST(FitParticles, FillsAThickBody) {
  const Box<double, 3> cube{V3::Constant(0.3), V3::Constant(10.3)};
  const auto fitted = fit_particles(cube, Box<double, 3>{V3::Zero(), V3::Constant(11)}, 1.0);
  EXPECT_NEAR(static_cast<double>(fitted.size()), 1000, 6);
  EXPECT_NEAR(sum(fitted.volumes), 1000, 1);
  EXPECT_GT(nearest(fitted.positions, 1.5), 0.6);
  for (const double v : fitted.volumes) EXPECT_NEAR(v, 1, 0.55);
}

// The middle is filled however far it is from the surface.
TEST(FitParticles, FillsTheMiddleOfABodyOfManySpacings) {
  using V2 = Vector<double, 2>;
  const auto fitted = fit_particles(Box<double, 2>{V2(0, 0), V2(64, 64)}, Box<double, 2>{V2(-1, -1), V2(65, 65)}, 1.0);
  EXPECT_NEAR(static_cast<double>(fitted.size()), 64 * 64, 8);
  const auto within = std::count_if(fitted.positions.begin(), fitted.positions.end(),
                                    [](const V2& x) { return (x.array() > 22).all() && (x.array() < 42).all(); });
  EXPECT_NEAR(static_cast<double>(within), 20 * 20, 20);
  EXPECT_LE(*std::max_element(fitted.volumes.begin(), fitted.volumes.end()), 1.5);
}

// Each side of a narrow gap has the layers of its own part. Where both sides crossed one cell of the samples, the block
// used to be hollow, and the particles of the plate clumped.
TEST(FitParticles, DistinguishesTheSidesOfANarrowGap) {
  for (const double gap : {0.1, 0.3, 0.7})
    for (const double shift : {0.0, 0.31, 0.6}) {
      const Box<double, 3> block{V3(0, 0, shift - 10), V3(10, 10, shift)};
      const Box<double, 3> plate{V3(0, 0, shift + gap), V3(10, 10, shift + gap + 2)};
      const auto fitted = fit_particles(unite(block, plate), Box<double, 3>{V3(-1, -1, -11), V3(11, 11, 5)}, 1.0);
      EXPECT_NEAR(static_cast<double>(fitted.size()), 1200, 6);
      for (std::size_t i = 0; i < fitted.size(); ++i) {
        EXPECT_NEAR(fitted.volumes[i], 1, 0.5);
        EXPECT_TRUE(fitted.layers[i] > 0 || fitted.layer_spacings[i] == 1.0) << i;
        const V3& x = fitted.positions[i];
        if (std::min({x[0], x[1], 10 - x[0], 10 - x[1]}) < 2.8) continue;  // layers run around the rim
        EXPECT_EQ(fitted.layers[i], x[2] < shift ? 0 : 2) << x.transpose() << ", gap " << gap << ", shift " << shift;
      }
    }
}

// A wall of the least thickness allowed has particles everywhere, whatever the rounding of its thickness.
TEST(FitParticles, FillsWallsOfTheThinnestSpacing) {
  using Vf = Vector<float, 3>;
  const auto shell = [](const Vf& x) { return std::max(x.norm() - 6, 4.8F - x.norm()); };
  const auto fitted = fit_particles(shell, Box<float, 3>{Vf::Constant(-7), Vf::Constant(7)}, 1.0F);
  EXPECT_NEAR(static_cast<double>(fitted.size()), 4 / 3. * 3.14159 * (216 - 4.8 * 4.8 * 4.8), 10);
  for (const float v : fitted.volumes) EXPECT_NEAR(v, 1, 0.4);
}

TEST(FitParticles, MergesThinEdgesIntoNeighboursAndFillsJunctions) {
  // A wedge of 30 degrees: 1.2 thick at 2.2 from its edge.
  const double a = 15 * 3.14159265358979 / 180;
  const auto wedge = hmps::intersect(hmps::HalfSpace<double, 3>{V3::Zero(), V3(-std::sin(a), 0, std::cos(a))},
                                     hmps::HalfSpace<double, 3>{V3::Zero(), V3(-std::sin(a), 0, -std::cos(a))},
                                     Box<double, 3>{V3(-1, 0, -4), V3(10, 6, 4)});
  const auto fitted = fit_particles(wedge, Box<double, 3>{V3(-1, -1, -4), V3(11, 7, 4)}, 1.0);
  const double volume = 10 * 10 * std::tan(a) * 6;
  EXPECT_NEAR(sum(fitted.volumes), volume, 1e-3 * volume);
  for (const V3& x : fitted.positions) EXPECT_LT(wedge(x), 0) << x.transpose();
  EXPECT_THROW((void)fit_particles(wedge, Box<double, 3>{V3(-1, -1, -4), V3(11, 7, 4)}, 1.0, {.longest_edge = 1.5}),
               hmps::InputError);

  const auto junction =
      hmps::unite(Box<double, 3>{V3(-6, 0, 0), V3(6, 6, 2)}, Box<double, 3>{V3(-1, 0, 1), V3(1, 6, 8)});
  const auto joined = fit_particles(junction, Box<double, 3>{V3(-7, -1, -1), V3(7, 7, 9)}, 1.0);
  EXPECT_NEAR(sum(joined.volumes), 216, 0.2);
  EXPECT_NEAR(static_cast<double>(joined.size()), 216, 4);
  // Where the number of layers changes, particles may end between two levels.
  EXPECT_LT(joined.largest_deviation, 0.02);
  EXPECT_GT(nearest(joined.positions, 1.5), 0.5);
}

/// Runs the loop backwards on two threads.
struct TwoThreads {
  template <class Body>
  void operator()(std::size_t n, Body&& body) const {
    std::thread other([&] {
      for (std::size_t i = n; i-- > n / 2;) body(i);
    });
    for (std::size_t i = n / 2; i-- > 0;) body(i);
    other.join();
  }
};

/// A block, and a leaf of 0.8 spacings beside it, across a gap.
TEST(FitParticles, RefusesAPartWithoutParticlesAcrossAGap) {
  for (const double gap : {0.2, 1.0, 2.0}) {
    const Box<double, 3> block{V3(0, 0, 0), V3(6, 6, 6)}, leaf{V3(0, 0, 6 + gap), V3(6, 6, 6.8 + gap)};
    const std::string text = message_of([&] {
      (void)fit_particles(hmps::unite(block, leaf), Box<double, 3>{V3(-1, -1, -1), V3(7, 7, 10)}, 1.0);
    });
    EXPECT_EQ(text.rfind("hmps: a part of the body at (", 0), 0U) << gap << ' ' << text;
    EXPECT_NE(text.find("about 0.8 m thick, holds no particle"), std::string::npos) << gap << ' ' << text;
    EXPECT_NE(text.find("give a spacing of at most 0.66"), std::string::npos) << gap << ' ' << text;
  }
}

/// A cone, whose tip has room for only a few particles.
TEST(FitParticles, LeavesNoParticleWithoutSupport) {
  const auto cone = [](const V3& x) {
    constexpr double radius = 2, height = 6;
    const double slant = std::hypot(radius, height), across = std::hypot(x[0], x[1]);
    return std::max((across * height - (height - x[2]) * radius) / slant, -x[2]);
  };
  const Box<double, 3> box{V3(-3, -3, -1), V3(3, 3, 7)};
  const auto weakest = [](const auto& fitted) {
    double least = 10;
    for (const auto& weak : hmps::find_weak(hmps::vectors(fitted.positions), {.spacing = 1, .threshold = 10}))
      least = std::min(least, weak.support);
    return least;
  };
  const double inside = hmps::detail::full_support<3>(hmps::paper_radius_ratio);
  EXPECT_NEAR(inside, 3.48, 0.01);
  const auto all = fit_particles(cone, box, 1.0, {.least_support = 0});
  const auto held = fit_particles(cone, box, 1.0);
  EXPECT_LT(weakest(all), 0.03 * inside);
  EXPECT_GE(weakest(held), 0.05 * inside);
  EXPECT_GE(held.size() + 2, all.size());
  EXPECT_NEAR(sum(held.volumes), sum(all.volumes), 1e-9);
}

// The advice used to be nine tenths of the spacing, again and again.
TEST(FitParticles, AdvisesASpacingThatSucceedsAtOnceWhereNoParticleHasSupport) {
  const auto advised = [](double angle, double width, double height, const hmps::FitSettings& settings) {
    const double c = std::cos(angle), s = std::sin(angle);
    const V3 size(width > 3 ? width : 6, width, height);
    // A bar or sheet, turned about y and z.
    const auto shape = [=](const V3& x) {
      const V3 a(c * x[0] + s * x[1], -s * x[0] + c * x[1], x[2]);
      return Box<double, 3>{V3::Zero(), size}(V3(c * a[0] + s * a[2], a[1], -s * a[0] + c * a[2]));
    };
    const Box<double, 3> box{V3(-6, -2, -2), V3(9, 12, 9)};
    const std::string text = message_of([&] { (void)fit_particles(shape, box, 1.0, settings); });
    const auto at = text.find("has enough neighbours to hold it"), advice = text.find("at most ");
    EXPECT_LT(at, advice) << text;
    if (advice == std::string::npos) return text;
    const double spacing = std::stod(text.substr(advice + 8));
    EXPECT_NEAR(spacing, std::min(width, height) / 2.3, 0.03);
    EXPECT_GT(fit_particles(shape, box, spacing, settings).size(), 20U) << text;
    return text;
  };
  const std::string needle = advised(0, 0.5, 0.5, {.iterations = 20});
  EXPECT_EQ(needle.find("least_layers"), std::string::npos) << needle;
  (void)advised(0.6, 1.2, 1.2, {.iterations = 20});
  const std::string sheet = advised(0.6, 4, 1, {.least_layers = 1, .iterations = 20});
  EXPECT_NE(sheet.find("a single layer, which least_layers = 1 allows"), std::string::npos) << sheet;
  EXPECT_NE(sheet.find("least_support = 0"), std::string::npos) << sheet;
  // Half of the diameter of a ball is too much.
  const hmps::Ball<double, 3> ball{.radius = 0.6};
  const Box<double, 3> around{V3::Constant(-2), V3::Constant(2)};
  const std::string text = message_of([&] { (void)fit_particles(ball, around, 1.0, {.iterations = 20}); });
  const double spacing = std::stod(text.substr(text.find("at most ") + 8));
  EXPECT_NO_THROW((void)fit_particles(ball, around, spacing, {.iterations = 20})) << text;
}

// Faces that meet at more than 60 degrees, as where a flaring body is cut, are not the two sides of a wall.
TEST(FitParticles, DoesNotTreatAnAcuteEdgeAsAWall) {
  for (const double degrees : {62.0, 66.0, 70.0}) {
    const double angle = degrees * 3.14159265358979 / 180;
    const auto flaring = [=](const Vector<double, 2>& x) {
      return std::max(std::abs(x[1]) - 12, std::sin(angle) * (std::abs(x[0]) - 20) - std::cos(angle) * x[1]);
    };
    const auto fitted = fit_particles(flaring, Box<double, 2>{{-30, -13}, {30, 13}}, 1.0);
    EXPECT_TRUE(std::all_of(fitted.layers.begin(), fitted.layers.end(), [](int n) { return n == 0; })) << degrees;
  }
}

TEST(FitParticles, GivesTheSameBitsByAnyExecutor) {
  const Plate plate{2.7};
  const hmps::FitSettings settings{.iterations = 30};
  const auto a = fit_particles(plate, Plate::box(), 1.0, settings);
  const auto b = fit_particles(plate, Plate::box(), 1.0, settings, TwoThreads{});
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.volumes, b.volumes);
  EXPECT_EQ(a.largest_deviation, b.largest_deviation);
}

// The distance to a mesh takes microseconds. Sampling every point of every cell that the surface cuts would take 3200
// evaluations per particle.
TEST(FitParticles, EvaluatesTheShapeRarely) {
  const Plate plate{2.9};
  std::size_t asked = 0;
  const auto counted = [&](const V3& x) {
    ++asked;
    return plate(x);
  };
  const auto fitted =
      fit_particles(counted, Box<double, 3>{V3(-4, -1, -1), V3(5, 10, 12)}, 1.0, {.iterations = 1, .least_support = 0});
  EXPECT_LT(asked, 2000 * fitted.size());
}

TEST(FitParticles, FillsASurfaceInOneCall) {
  const double l0 = 1e-3;
  hmps::SurfaceMesh<double> brick;
  for (int k = 0; k < 8; ++k)
    brick.vertices.push_back(l0 * V3(k & 1 ? 6.3 : 0.2, k & 2 ? 5.1 : 0.1, k & 4 ? 3.0 : 0.0));
  brick.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                     {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  const auto fitted = fit_particles(brick, l0);
  const hmps::MeshDistance<double> shape(brick);
  EXPECT_EQ(fitted.positions, fit_particles(shape, shape.box(), l0).positions);
  EXPECT_NEAR(sum(fitted.volumes), 91.5e-9, 1e-3 * 91.5e-9);
  const std::string message = message_of([&] { (void)fit_particles(brick, 1.0); });
  EXPECT_NE(message.find("give both in metres"), std::string::npos) << message;
  brick.triangles.pop_back();
  EXPECT_THROW((void)fit_particles(brick, l0), hmps::InputError);
}

TEST(FitParticles, AppendsAnotherPart) {
  const auto fit = [](double from, double to) {
    const Box<double, 3> part{V3(from, 0, 0), V3(to, 5, 4)};
    return fit_particles(part, part, 1.0);
  };
  const auto left = fit(-4, 0), right = fit(0, 3);
  auto both = left;
  both.append(right);
  ASSERT_EQ(both.size(), left.size() + right.size());
  for (std::size_t i = 0; i < both.size(); ++i) {
    const auto& part = i < left.size() ? left : right;
    const std::size_t k = i < left.size() ? i : i - left.size();
    EXPECT_EQ(both.positions[i], part.positions[k]);
    EXPECT_EQ(both.volumes[i], part.volumes[k]);
    EXPECT_EQ(both.layers[i], part.layers[k]);
    EXPECT_EQ(both.layer_spacings[i], part.layer_spacings[k]);
  }
  EXPECT_EQ(both.largest_deviation, std::max(left.largest_deviation, right.largest_deviation));
  EXPECT_EQ(both.spacing, 1.0);
  auto empty = hmps::FittedParticles<double, 3>{};
  empty.append(right);
  EXPECT_EQ(empty.edges, right.edges);
  EXPECT_EQ(empty.spacing, 1.0);
  const Box<double, 3> finer{V3(0, 0, 0), V3(3, 5, 4)};
  const std::string message = message_of([&] { both.append(fit_particles(finer, finer, 0.8)); });
  EXPECT_NE(message.find("a part with a spacing of 0.8 m"), std::string::npos) << message;
}

// A wall of two layers ends in an edge one layer deep, which the particles within 1.5 spacings see beside its faces.
TEST(FitParticles, TellsTheEdgesOfWalls) {
  const Box<double, 3> plate{V3(0, 0, 0), V3(16, 20, 2)};
  const auto fitted = fit_particles(plate, plate, 1.0);
  int rims = 0, middles = 0;
  for (std::size_t i = 0; i < fitted.size(); ++i) {
    const V3& x = fitted.positions[i];
    const double inside = std::min({x[0], 16 - x[0], x[1], 20 - x[1]});
    if (inside < 0.7) {
      ++rims;
      EXPECT_GT(fitted.edges[i], 0.45) << x.transpose();
    } else if (inside > 2.6) {
      ++middles;
      EXPECT_EQ(fitted.edges[i], 0) << x.transpose();
    }
    EXPECT_LE(fitted.edges[i], 1);
  }
  EXPECT_GT(rims, 100);
  EXPECT_GT(middles, 200);
}

TEST(FitParticles, FindsNoEdgesOfThickBodies) {
  const Box<double, 3> cube{V3(0, 0, 0), V3(12, 12, 12)};
  for (const double edge : fit_particles(cube, cube, 1.0).edges) EXPECT_EQ(edge, 0);
}

// Two pieces of a plate that meet at x = 8: the face between them is no edge, the rims elsewhere still are.
TEST(FitParticles, ForgetsTheEdgeWherePartsMeet) {
  const auto fit = [](double from, double to) {
    const Box<double, 3> part{V3(from, 0, 0), V3(to, 12, 2)};
    return fit_particles(part, part, 1.0);
  };
  auto plate = fit(0, 8);
  plate.append(fit(8, 16));
  for (std::size_t i = 0; i < plate.size(); ++i) {
    const double x = plate.positions[i][0];
    if (std::abs(x - 8) < 2) {
      EXPECT_EQ(plate.edges[i], 0) << x;
    } else if (x < 0.7 || x > 15.3) {
      EXPECT_GT(plate.edges[i], 0.45) << x;
    }
  }
}

TEST(FitParticles, ReportsProgress) {
  const hmps::Ball<double, 3> ball{.radius = 2};
  int calls = 0;
  double move = 0;
  const auto fitted = fit_particles(ball, Box<double, 3>{V3::Constant(-3), V3::Constant(3)}, 1.0,
                                    {.iterations = 40, .progress = [&](const hmps::FitProgress& progress) {
                                       EXPECT_EQ(progress.iteration, ++calls);
                                       EXPECT_EQ(progress.iterations, 40);
                                       move = progress.move;
                                     }});
  EXPECT_EQ(calls, 40);
  EXPECT_EQ(fitted.iterations, 40);
  EXPECT_LE(move, 0.2 / 40 + 1e-12);
}

TEST(FitParticles, RefusesWhatCannotBeFitted) {
  const hmps::Ball<double, 3> ball{.radius = 2};
  const Box<double, 3> box{V3::Constant(-3), V3::Constant(3)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto starts = [](const std::string& text, const std::string& with) { return text.rfind(with, 0) == 0; };
  for (const double spacing : {0.0, -1.0, nan})
    EXPECT_TRUE(starts(message_of([&] { (void)fit_particles(ball, box, spacing); }), "hmps: the lattice spacing is "));
  EXPECT_TRUE(starts(message_of([&] {
                       (void)fit_particles(ball, Box<double, 3>{box.upper, box.lower}, 1.0);
                     }),
                     "hmps: the box"));
  EXPECT_TRUE(starts(message_of([&] {
                       (void)fit_particles(ball, Box<double, 3>{V3(0, 0, 0), V3(1, 1, 0)}, 1.0);
                     }),
                     "hmps: the box to fit particles in"));
  EXPECT_TRUE(starts(message_of([&] {
                       (void)fit_particles(hmps::Ball<double, 3>{V3(20, 0, 0), 1}, box, 1.0);
                     }),
                     "hmps: the shape has no volume in the box"));
  EXPECT_TRUE(
      starts(message_of([&] { (void)fit_particles([&](const V3& x) { return x[0] > 1 ? nan : ball(x); }, box, 1.0); }),
             "hmps: the shape is NaN at ("));
  for (const double factor : {1e-3, 1e3})
    EXPECT_NE(message_of([&] {
                (void)fit_particles([&](const V3& x) { return factor * ball(x); }, box, 1.0);
              }).find("must be about the signed distance"),
              std::string::npos)
        << factor;
  for (const hmps::FitSettings& bad :
       {hmps::FitSettings{.least_layers = 0}, hmps::FitSettings{.least_layers = 9},
        hmps::FitSettings{.thinnest_spacing = 0}, hmps::FitSettings{.thinnest_spacing = 0.6e-3},
        hmps::FitSettings{.thinnest_spacing = 1.1}, hmps::FitSettings{.longest_edge = 0},
        hmps::FitSettings{.iterations = 0}, hmps::FitSettings{.least_support = -0.1},
        hmps::FitSettings{.least_support = nan}})
    EXPECT_NE(message_of([&] { (void)fit_particles(ball, box, 1.0, bad); }), "none");

  // A plate of one spacing holds one layer, not the two of the default. A thin fin is found on a thick body too.
  const Box<double, 3> plate{V3(-2.5, -2.5, 0), V3(2.5, 2.5, 1)};
  EXPECT_TRUE(
      starts(message_of([&] { (void)fit_particles(plate, box, 1.0); }), "hmps: the body is about 1 m thick at ("));
  // One layer has no deformation gradient, but may serve another purpose.
  EXPECT_TRUE(
      starts(message_of([&] { (void)fit_particles(plate, box, 1.0, {.least_layers = 1}); }),
             "hmps: none of the 25 particles that fit into the body at a spacing of 1 m has enough neighbours"));
  EXPECT_NEAR(static_cast<double>(fit_particles(plate, box, 1.0, {.least_layers = 1, .least_support = 0}).size()), 25,
              1);
  const auto finned =
      hmps::unite(Box<double, 3>{V3(-3, -3, -3), V3(3, 3, 3)}, Box<double, 3>{V3(0, -3, 0), V3(12, 3, 0.8)});
  const std::string text = message_of([&] {
    (void)fit_particles(finned, Box<double, 3>{V3(-4, -4, -4), V3(13, 4, 4)}, 1.0);
  });
  EXPECT_TRUE(starts(text, "hmps: the body is about 0.8 m thick at (")) << text;
}

TEST(FitParticlesMisuse, IsRefusedWhereItsScalarDoesNotResolveTheSpacing) {
  using P = hmps::Vector<float, 3>;
  const float spacing = 1e-3f;
  const auto fit_at = [&](float place) {
    const P middle = P::Constant(place), reach = P::Constant(5 * spacing);
    return hmps::fit_particles([&](const P& x) { return (x - middle).norm() - 4 * spacing; },
                               hmps::Box<float, 3>{P(middle - reach), P(middle + reach)}, spacing)
        .size();
  };
  EXPECT_NEAR(static_cast<double>(fit_at(10)), static_cast<double>(fit_at(0)), 0.02 * static_cast<double>(fit_at(0)));
  EXPECT_THROW((void)fit_at(1e3f), hmps::InputError);
  EXPECT_THROW((void)fit_at(1e4f), hmps::InputError);
}

}  // namespace fitted_test
