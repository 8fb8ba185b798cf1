// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace examples {

inline constexpr std::uint64_t checksum_of_nothing = 0xcbf29ce484222325;

/// `sum` and one word more. Every step is invertible, so that no change of one word goes unseen.
[[nodiscard]] constexpr std::uint64_t add_to_checksum(std::uint64_t sum, std::uint64_t word) {
  sum = (sum ^ word) * 0x9e3779b97f4a7c15;
  return sum ^ (sum >> 29);
}

/// `sum` and `bytes` as words of 64 bits in this machine's order of bytes, the last of them filled up with zeros. Fast
/// enough not to be noticed beside the writing of a file.
[[nodiscard]] inline std::uint64_t checksum(std::string_view bytes, std::uint64_t sum = checksum_of_nothing) {
  for (std::size_t at = 0; at < bytes.size(); at += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, bytes.data() + at, std::min<std::size_t>(8, bytes.size() - at));
    sum = add_to_checksum(sum, word);
  }
  return sum;
}

}  // namespace examples
