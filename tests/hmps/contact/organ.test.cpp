// SPDX-License-Identifier: MIT
#include "hmps/contact/organ.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace organ_test {

TEST(ExcludeAttached, NamesSlavesWithinADistanceInMetres) {
  // A strip of slaves at y = 0 that is bonded to particle 5 at (0, 1).
  std::vector<hmps::Vector<double, 2>> reference{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}, {0, 1}};
  const std::vector<hmps::Index> slaves{4, 3, 2, 1, 0, 0}, bonded{5};
  const auto view = hmps::vectors(reference);
  EXPECT_EQ(hmps::exclude_attached(view, slaves, bonded, 1.0), (std::vector<hmps::Index>{0}));
  EXPECT_EQ(hmps::exclude_attached(view, slaves, bonded, 2.5), (std::vector<hmps::Index>{0, 1, 2}));
  EXPECT_TRUE(hmps::exclude_attached(view, slaves, {}, 2.5).empty());
}

TEST(ExcludeAttached, RefusesBadInput) {
  std::vector<hmps::Vector<double, 2>> reference{{0, 0}, {1, 0}};
  const std::vector<hmps::Index> good{0}, bad{2};
  const auto view = hmps::vectors(reference);
  EXPECT_THROW((void)hmps::exclude_attached(view, good, good, 0.), hmps::InputError);
  EXPECT_THROW((void)hmps::exclude_attached(view, bad, good, 1.), hmps::InputError);
  EXPECT_THROW((void)hmps::exclude_attached(view, good, bad, 1.), hmps::InputError);
}

TEST(ExcludeAttached, RefusesADistanceInMillimetres) {
  const std::vector<hmps::Vector<double, 2>> reference{{0, 0}, {0.01, 0}, {0.02, 0}, {0, 0.001}};
  const std::vector<hmps::Index> slaves{0, 1, 2}, bonded{3};
  EXPECT_EQ(hmps::exclude_attached(hmps::vectors(reference), slaves, bonded, 0.003).size(), 1u);
  EXPECT_THROW((void)hmps::exclude_attached(hmps::vectors(reference), slaves, bonded, 3.0), hmps::InputError);
}

}  // namespace organ_test
