// SPDX-License-Identifier: MIT
#include "hmps/output/pvd_text.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace pvd_text_test {

using namespace hmps;

TEST(PvdText, ListsFramesWhoseTimesComeBackToTheLastBit) {
  const std::vector<std::pair<double, std::string>> frames{{-1e-300, "a&b_0.vtu"}, {0.1, "a\"_1.vtu"}, {1. / 3, ""}};
  const std::string text = pvd_text(frames);
  EXPECT_NE(text.find("<DataSet timestep=\"0.1\" group=\"\" part=\"0\" file=\"a&quot;_1.vtu\"/>\n"), std::string::npos);
  EXPECT_EQ(detail::pvd_times(text), (std::vector<double>{-1e-300, 0.1, 1. / 3}));
  EXPECT_EQ(detail::pvd_times(pvd_text({})), std::vector<double>());
  EXPECT_EQ(detail::pvd_times("<DataSet timestep=\"1,5\"<DataSet timestep=\""), (std::vector<double>{0, 0}));
}

}  // namespace pvd_text_test
