// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace examples {

/// The number whose decimal notation is the whole of `text`: -2, 0.5, 1e-5 or, if `T` is an integer, 010, which is ten.
/// Returns no value otherwise: for other notations (0x1), digit separators (1_000), text before or after the number,
/// and numbers that are not finite or that `T` cannot represent.
template <class T>
requires std::is_arithmetic_v<T>
[[nodiscard]] std::optional<T> decimal(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  T value{};
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || end != text.data() + text.size()) return std::nullopt;
  if constexpr (std::is_floating_point_v<T>)
    if (!std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace examples
