// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <hmps/core/error.hpp>
#include <optional>
#include <string_view>

#include "../../common/error.hpp"

namespace swallowing {

/// How the middle of the epiglottis moves (section 3.5 of the paper).
enum class Model {
  X,  ///< it is control region F, which the hyoid bone pulls
  Y   ///< it moves passively
};

/// One column of the paper's Tables 1 and 2.
struct Case {
  std::string_view name;
  Model model;
  double friction;
  std::optional<double> fold_time;  ///< s, the paper's Table 2; none if the epiglottis did not fold
};
inline constexpr std::array<Case, 4> cases{{{"X1", Model::X, 0.1, 1.65},
                                            {"X3", Model::X, 0.3, 1.70},
                                            {"Y1", Model::Y, 0.1, 1.70},
                                            {"Y3", Model::Y, 0.3, std::nullopt}}};

/// The case of that name; throws `InputError` if there is none.
[[nodiscard]] inline const Case& find_case(std::string_view name) {
  for (const Case& c : cases)
    if (c.name == name) return c;
  throw hmps::InputError(examples::message("there is no case ", name, "; the cases are X1, X3, Y1 and Y3"));
}

}  // namespace swallowing
