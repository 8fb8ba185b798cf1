// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace examples {

inline constexpr std::uint64_t checksum_of_nothing = 0xcbf29ce484222325;

/// Adds one word to `sum`. Every step is invertible, so any change of a single word changes the checksum.
[[nodiscard]] constexpr std::uint64_t add_to_checksum(std::uint64_t sum, std::uint64_t word) {
  sum = (sum ^ word) * 0x9e3779b97f4a7c15;
  return sum ^ (sum >> 29);
}

/// Adds `bytes` to `sum`, as words of 64 bits in the byte order of this machine, the last word padded with zeros. Takes
/// little time compared with writing a file.
[[nodiscard]] inline std::uint64_t checksum(std::string_view bytes, std::uint64_t sum = checksum_of_nothing) {
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    sum = add_to_checksum(sum, word);
  }
  return sum;
}

}  // namespace examples
