// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace swallowing {

/// A hash (FNV-1a) of a text that is given piece by piece, to detect whether the text has changed.
class Digest {
 public:
  Digest() = default;
  explicit Digest(std::string_view text) { add(text); }
  void add(std::string_view text) {
    for (const char c : text) value_ = (value_ ^ static_cast<unsigned char>(c)) * 1099511628211u;
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 14695981039346656037u;
};

}  // namespace swallowing
