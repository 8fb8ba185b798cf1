// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <cstddef>
#include <cstring>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "../../reference/message_of.hpp"
#include "../../reference/scenes.hpp"
#include "hmps/bonds/bond_list.hpp"
#include "hmps/bonds/lattice_bonds.hpp"
#include "hmps/core/executor.hpp"
#include "hmps/force/deformation_gradient.hpp"
#include "hmps/force/internal_force.hpp"
#include "hmps/laws/mooney_rivlin.hpp"
#include "hmps/terms/artificial.hpp"
#include "hmps/terms/elastic.hpp"
#include "hmps/terms/viscous.hpp"

/// The requirements on every executor.
namespace same_bits {

template <class E>
void call_every_index_once(const E& execute) {
  for (const std::size_t n : {0u, 1u, 7u, 1000u}) {
    std::vector<std::atomic<int>> calls(n);
    execute(n, [&](std::size_t i) { ++calls[i]; });
    for (const auto& count : calls) ASSERT_EQ(count, 1);
  }
}

template <class E>
void pass_exceptions_on(const E& execute) {
  std::atomic<int> calls = 0;
  EXPECT_THROW(execute(100,
                       [&](std::size_t i) {
                         ++calls;
                         if (i == 42) throw std::runtime_error("42");
                       }),
               std::runtime_error);
  EXPECT_GE(calls, 1);
}

/// Index 0 fails after an index of the second half has failed, if they run at the same time.
template <class E>
void prefer_the_lowest_index(const E& execute) {
  constexpr std::size_t n = 1000, most_turns = 100000;  // a single thread waits in vain
  std::atomic<std::size_t> failed = n;
  const std::string error = hmps_test::message_of<std::runtime_error>([&] {
    execute(n, [&](std::size_t i) {
      if (i == 0)
        for (std::size_t turns = 0, after = 0; turns < most_turns && after < 1000; ++turns, after += failed < n)
          std::this_thread::yield();
      else if (i < n / 2)
        return;
      else
        failed = i;
      throw std::runtime_error(std::to_string(i));
    });
  });
  EXPECT_EQ(error, "0");
}

/// Forces and deformation gradients of one state, to be compared bit by bit.
template <class B>
class Probe {
 public:
  Probe() : scene_(bent()), bonds_(hmps::vectors(scene_.reference), {.spacing = scene_.spacing}) {}

  template <class E>
  [[nodiscard]] std::vector<double> operator()(const E& execute) const {
    const std::size_t n = scene_.x.size();
    std::vector<double> numbers(12 * n);
    auto force = hmps::internal_force(bonds_, hmps::elastic(hmps::MooneyRivlin<double>{1700, 1600, 1e6}),
                                      hmps::artificial(2e4), hmps::viscous(1000, 2e-3));
    force(hmps::vectors(scene_.x), hmps::vectors(scene_.v), hmps::vectors<3>(numbers.data(), n), execute);
    std::vector<hmps::Matrix<double, 3>> F(n);
    hmps::deformation_gradient(bonds_, hmps::vectors(scene_.x), hmps::matrices(F), execute);
    for (std::size_t i = 0; i < n; ++i) std::memcpy(&numbers[3 * n + 9 * i], F[i].data(), 9 * sizeof(double));
    return numbers;
  }

 private:
  static scenes::Scene<3> bent() {
    scenes::Scene<3> scene;
    scene.reference = scenes::lattice<3>({21, 13, 9}, [](const auto& cell) { return cell[0] < 8 || cell[1] > 4; });
    scenes::move(scene);
    return scene;
  }
  scenes::Scene<3> scene_;
  B bonds_;
};

inline bool identical(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

}  // namespace same_bits
