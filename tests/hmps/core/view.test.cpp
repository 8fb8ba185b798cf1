// SPDX-License-Identifier: MIT
#include "hmps/core/view.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <string>
#include <type_traits>
#include <vector>

namespace view_test {

template <class T>
struct Particle {
  int id;
  std::array<T, 3> position;
  T velocity[3];
  Eigen::Matrix<T, 3, 1> force;
  Eigen::Matrix<T, 3, 3> gradient;
  T mass;
  char flag;
};

template <class T>
class Views : public testing::Test {};
using Scalars = testing::Types<float, double>;
TYPED_TEST_SUITE(Views, Scalars);

// Fills `view` with 10 i + c, reads it back in both ways, and writes through `set` and `add`.
template <class View>
void round_trip(const View& view, std::size_t size) {
  using T = typename View::Scalar;
  ASSERT_EQ(view.size(), size);
  for (std::size_t i = 0; i < size; ++i)
    for (int c = 0; c < View::dimension; ++c) view(i, c) = static_cast<T>(10 * i) + static_cast<T>(c);
  for (std::size_t i = 0; i < size; ++i)
    for (int c = 0; c < View::dimension; ++c) EXPECT_EQ(view[i][c], static_cast<T>(10 * i) + static_cast<T>(c));
  const auto old = view[1];
  view.set(1, (2.0 * old.template cast<double>()).eval());
  EXPECT_EQ(view[1], T(2) * old);
  view.add(1, old);
  EXPECT_EQ(view[1], T(3) * old);
  EXPECT_EQ(view[0][0], T(0)) << "a neighbour was overwritten";
}

TYPED_TEST(Views, OfArraysOfStructs) {
  using P = Particle<TypeParam>;
  std::vector<P> particles(4);
  round_trip(hmps::vectors(particles, &P::position), 4);
  round_trip(hmps::vectors(particles, &P::velocity), 4);
  round_trip(hmps::vectors(particles, &P::force), 4);
  EXPECT_EQ(particles[2].position[1], TypeParam(21));
  EXPECT_EQ(particles[2].velocity[2], TypeParam(22));
  EXPECT_EQ(particles[3].force[0], TypeParam(30));

  const auto mass = hmps::scalars(particles, &P::mass);
  mass[3] = TypeParam(5);
  EXPECT_EQ(particles[3].mass, TypeParam(5));
  const auto gradient = hmps::matrices(particles, &P::gradient);
  gradient(2, 3) = TypeParam(7);  // Column-major: row 0, column 1.
  EXPECT_EQ(particles[2].gradient(0, 1), TypeParam(7));
  EXPECT_EQ(gradient[2](0, 1), TypeParam(7));
  gradient.set(1, Eigen::Matrix<double, 3, 3>::Identity());
  EXPECT_EQ(particles[1].gradient, (Eigen::Matrix<TypeParam, 3, 3>::Identity()));

  const std::vector<P>& fixed = particles;
  static_assert(std::is_same_v<decltype(hmps::vectors(fixed, &P::position)), hmps::VectorView<const TypeParam, 3>>);
  static_assert(std::is_same_v<decltype(hmps::scalars(fixed, &P::mass)), hmps::ScalarView<const TypeParam>>);
  EXPECT_EQ(hmps::vectors(fixed, &P::position)[2], hmps::vectors(particles, &P::position)[2]);
}

TYPED_TEST(Views, OfStructsOfArrays) {
  std::vector<TypeParam> x(5), y(5), z(5);
  round_trip(hmps::vectors(x, y, z), 5);
  EXPECT_EQ(z[4], TypeParam(42));
  round_trip(hmps::vectors(x, y), 5);
  const std::vector<TypeParam>& fixed = x;
  static_assert(std::is_same_v<decltype(hmps::vectors(fixed, fixed)), hmps::VectorView<const TypeParam, 2>>);
}

TYPED_TEST(Views, OfRangesOfVectors) {
  std::vector<Eigen::Matrix<TypeParam, 3, 1>> eigen(3);
  std::vector<Eigen::Matrix<TypeParam, 2, 1>> plane(3);
  std::vector<hmps::Vector<TypeParam, 3>> own(3);
  std::array<TypeParam[2], 3> raw;
  round_trip(hmps::vectors(eigen), 3);
  round_trip(hmps::vectors(plane), 3);
  round_trip(hmps::vectors(own), 3);
  round_trip(hmps::vectors(raw), 3);
  EXPECT_EQ(eigen[2][1], TypeParam(21));
  std::vector<Eigen::Matrix<TypeParam, 2, 2>> tensors(2);
  hmps::matrices(tensors)(1, 2) = TypeParam(3);
  EXPECT_EQ(tensors[1](0, 1), TypeParam(3));
  std::vector<std::array<TypeParam, 9>> flat(2);
  hmps::matrices(flat).set(1, Eigen::Matrix<TypeParam, 3, 3>::Constant(TypeParam(4)));
  EXPECT_EQ(flat[1][8], TypeParam(4));
}

TYPED_TEST(Views, OfEigenMatricesAndMaps) {
  using Columns = Eigen::Matrix<TypeParam, 3, Eigen::Dynamic>;
  using Rows = Eigen::Matrix<TypeParam, 3, Eigen::Dynamic, Eigen::RowMajor>;
  Columns columns(3, 4);
  round_trip(hmps::vectors(columns), 4);
  EXPECT_EQ(columns(2, 3), TypeParam(32));
  Rows rows(3, 4);
  round_trip(hmps::vectors(rows), 4);
  EXPECT_EQ(rows(2, 3), TypeParam(32));

  std::vector<TypeParam> memory(3 * 4), wide(4 * 8);
  round_trip(hmps::vectors(Eigen::Map<Columns>(memory.data(), 3, 4)), 4);
  EXPECT_EQ(memory[11], TypeParam(32));
  // Four of every eight numbers, the second of each vector two behind the first.
  Eigen::Map<Columns, 0, Eigen::Stride<8, 2>> strided(wide.data(), 3, 4);
  round_trip(hmps::vectors(strided), 4);
  EXPECT_EQ(wide[3 * 8 + 2 * 2], TypeParam(32));

  const Columns& fixed = columns;
  static_assert(std::is_same_v<decltype(hmps::vectors(fixed)), hmps::VectorView<const TypeParam, 3>>);
  EXPECT_EQ(hmps::vectors(fixed)[3], columns.col(3));
  const Eigen::Map<const Columns> map(memory.data(), 3, 4);
  static_assert(std::is_same_v<decltype(hmps::vectors(map)), hmps::VectorView<const TypeParam, 3>>);
  EXPECT_EQ(hmps::vectors(map)[3], map.col(3));
}

TYPED_TEST(Views, OfPointersWithAStride) {
  std::vector<TypeParam> memory(5 * 7);
  round_trip(hmps::vectors<3>(memory.data() + 1, 5, 7 * sizeof(TypeParam)), 5);
  EXPECT_EQ(memory[4 * 7 + 3], TypeParam(42));
  round_trip(hmps::vectors<2>(memory.data(), 5), 5);
  EXPECT_EQ(memory[9], TypeParam(41));
  // Backwards in memory.
  round_trip(hmps::vectors<2>(memory.data() + 12, 5, -3 * static_cast<std::ptrdiff_t>(sizeof(TypeParam))), 5);
  EXPECT_EQ(memory[1], TypeParam(41));
}

TYPED_TEST(Views, OfScalars) {
  std::vector<TypeParam> values(3);
  hmps::scalars(values)[2] = TypeParam(2);
  EXPECT_EQ(values[2], TypeParam(2));
  Eigen::Matrix<TypeParam, Eigen::Dynamic, 1> eigen(3);
  hmps::scalars(eigen)[1] = TypeParam(3);
  EXPECT_EQ(eigen[1], TypeParam(3));
}

TYPED_TEST(Views, ConvertToReadOnlyAndGiveParts) {
  std::vector<std::array<TypeParam, 3>> points(6);
  for (std::size_t i = 0; i < 6; ++i) points[i].fill(static_cast<TypeParam>(i));
  const auto view = hmps::vectors(points);
  const hmps::VectorView<const TypeParam, 3> fixed(view);
  EXPECT_EQ(fixed.size(), 6u);
  EXPECT_EQ(fixed[5][2], TypeParam(5));
  static_assert(!std::is_convertible_v<hmps::VectorView<const TypeParam, 3>, hmps::VectorView<TypeParam, 3>>);
  const auto part = view.part(2, 3);
  EXPECT_EQ(part.size(), 3u);
  EXPECT_EQ(part(0, 1), TypeParam(2));
  EXPECT_EQ(view.part(6, 0).size(), 0u);
}

TEST(Views, OfNothingAreEmpty) {
  std::vector<Particle<double>> none;
  EXPECT_EQ(hmps::vectors(none, &Particle<double>::position).size(), 0u);
  std::vector<double> empty;
  EXPECT_EQ(hmps::vectors(empty, empty).size(), 0u);
  EXPECT_EQ(hmps::scalars(empty).size(), 0u);
  EXPECT_NO_THROW(hmps::require_finite(hmps::scalars(empty), "density"));
}

template <class Call>
std::string error_of(Call&& call) {
  try {
    call();
  } catch (const hmps::InputError& error) {
    return error.what();
  }
  return "nothing was thrown";
}
bool has(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Views, SetZeroWritesTheirNumbersAndNothingElse) {
  std::vector<Particle<float>> particles(5);
  for (auto& particle : particles) {
    particle.id = 7;
    particle.position = {1, 2, 3};
    particle.velocity[0] = 4;
  }
  hmps::set_zero(hmps::vectors(particles, &Particle<float>::position).part(1, 3));
  for (std::size_t i = 0; i < 5; ++i) {
    const bool inside = 1 <= i && i <= 3;
    EXPECT_EQ(particles[i].position, (inside ? std::array<float, 3>{} : std::array<float, 3>{1, 2, 3})) << i;
    EXPECT_EQ(particles[i].id, 7) << i;
    EXPECT_EQ(particles[i].velocity[0], 4) << i;
  }

  std::vector<double> numbers(7, 4);
  std::vector<Eigen::Matrix2d> tensors(2, Eigen::Matrix2d::Ones());
  hmps::set_zero(hmps::scalars(numbers), [](std::size_t n, const auto& body) {
    for (std::size_t i = n; i-- > 0;) body(i);
  });
  hmps::set_zero(hmps::matrices(tensors));
  EXPECT_EQ(numbers, std::vector<double>(7, 0));
  EXPECT_EQ(tensors[0].norm() + tensors[1].norm(), 0);
  EXPECT_NO_THROW(hmps::set_zero(hmps::VectorView<double, 3>()));
}

TEST(Views, ErrorsNameTheParticleAndTheValue) {
  std::vector<double> x(3), y(2);
  std::string text = error_of([&] { (void)hmps::vectors(x, y); });
  EXPECT_TRUE(has(text, "3 and 2 elements")) << text;

  text = error_of([&] { hmps::require_size(hmps::scalars(x), 5, "velocities"); });
  EXPECT_TRUE(has(text, "velocities") && has(text, "3 particles") && has(text, "5 are needed")) << text;

  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    std::vector<std::array<double, 3>> points(4, {0, 0, 0});
    points[2][1] = bad;
    text = error_of([&] { hmps::require_finite(hmps::vectors(points), "the position"); });
    EXPECT_TRUE(has(text, "component 1 of the position of particle 2")) << text;
    EXPECT_TRUE(has(text, bad != bad ? "nan" : "inf")) << text;
  }
}

}  // namespace view_test
