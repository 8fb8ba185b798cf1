// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>

namespace hmps_test {

/// An empty folder among the system's temporary files, which no other object has: not of another test, nor of the same
/// test in another process (ctest runs the tests of one program beside each other). Removed with what is in it at the
/// end of its life.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = "hmps_" + std::string(test->test_suite_name()) + "_" + test->name() + "_";
    std::replace(name.begin(), name.end(), '/', '_');  // as in the names of typed tests
    for (int count = 0; count < 1000; ++count) {
      path_ = std::filesystem::temp_directory_path() / (name + std::to_string(count));
      if (std::filesystem::create_directory(path_)) return;
    }
    throw std::runtime_error("no free name for a temporary folder: remove " + path_.string() + " and its like");
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace hmps_test
