// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "tradeoff/scene.hpp"

namespace tradeoff {

/// How large the sweeps are, and where runs leave what takes long.
struct Scale {
  bool quick = false;                ///< seconds, to see that it works; its figures mean little
  std::filesystem::path out = "";    ///< folder for results that a later sweep can take up
  std::filesystem::path finer = "";  ///< folder with results of finer runs of the swallow, to compare with
};

/// The scenes. One of your own goes into a file beside sag.cpp, to start from, and gets its line here, in main.cpp and
/// in CMakeLists.txt.
[[nodiscard]] Scene beam(const Scale& scale);
[[nodiscard]] Scene bar(const Scale& scale);
[[nodiscard]] Scene sag(const Scale& scale);
[[nodiscard]] Scene contact(const Scale& scale);
[[nodiscard]] Scene swallow(const Scale& scale);  ///< only where the example's library is built

}  // namespace tradeoff
