// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <type_traits>

namespace examples {

/// The number that the whole of `text` is in decimal notation: -2, 0.5, 1e-5 or, where `T` is an integer, 010, which is
/// ten. Nothing for all else: other notations (0x1), signs of digits (1_000), what stands before or behind a number,
/// what is not finite, and what `T` cannot hold.
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
