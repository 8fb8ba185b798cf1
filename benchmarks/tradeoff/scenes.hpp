// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "tradeoff/scene.hpp"

namespace tradeoff {

/// The size of the sweeps, and the folders for results that take long to compute.
struct Scale {
  bool quick = false;                ///< takes seconds, as a test; its figures mean little
  std::filesystem::path out = "";    ///< folder for results that a later sweep can reuse
  std::filesystem::path finer = "";  ///< folder with results of finer runs of the swallow, to compare with
};

/// The scenes. To add one of your own, put it into a file beside sag.cpp, which is a good start, and add a line here,
/// in main.cpp and in CMakeLists.txt.
[[nodiscard]] Scene beam(const Scale& scale);
[[nodiscard]] Scene bar(const Scale& scale);
[[nodiscard]] Scene sag(const Scale& scale);
[[nodiscard]] Scene contact(const Scale& scale);
[[nodiscard]] Scene swallow(const Scale& scale);  ///< only if the library of the example is built

}  // namespace tradeoff
