// SPDX-License-Identifier: MIT
#pragma once

#include <charconv>
#include <concepts>
#include <cstddef>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>

#include "hmps/core/abi.hpp"
#include "hmps/core/inline.hpp"

#if defined(min) || defined(max)
#error "hmps: min and max are macros: define NOMINMAX before <windows.h> is included"
#endif

namespace hmps {

/// Base class of all exceptions of the library. The message names the particle, the value and the remedy.
struct Error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Invalid input. Thrown before anything is computed.
struct InputError : Error {
  using Error::Error;
};

/// A simulation that has left its valid range (inverted particle, NaN, a speed above the speed of sound). Thrown during
/// a run.
struct StateError : Error {
  using Error::Error;
};

}  // namespace hmps

namespace hmps::inline HMPS_ABI::detail {

/// One part of a message: words, a number, or the numbers of an Eigen vector. Refers to words and vectors; does not
/// copy them. The text is built by non-template functions, because in a header-only library every place that can throw
/// adds to compile time.
class MessagePart {
 public:
  /// A literal, which would otherwise instantiate a constructor for each length.
  MessagePart(const char* words) : words_(words) {}
  template <class T>
  MessagePart(const T& part) {
    if constexpr (std::convertible_to<const T&, std::string_view>) {
      words_ = part;
    } else if constexpr (std::same_as<T, char>) {
      words_ = std::string_view(&part, 1);
    } else if constexpr (std::signed_integral<T>) {
      kind_ = Kind::integer;
      integer_ = part;
    } else if constexpr (std::unsigned_integral<T>) {
      kind_ = Kind::unsigned_integer;
      unsigned_ = part;
    } else if constexpr (std::floating_point<T>) {
      kind_ = Kind::number;
      number_ = static_cast<double>(part);
    } else {
      kind_ = Kind::vector;
      vector_ = &part;
      component_ = [](const void* vector, std::ptrdiff_t k, double& number) {
        const T& numbers = *static_cast<const T*>(vector);
        if (k >= numbers.size()) return false;
        number = static_cast<double>(numbers(k));
        return true;
      };
    }
  }

  HMPS_COLD void append_to(std::string& text) const {
    switch (kind_) {
      case Kind::words:
        text += words_;
        break;
      case Kind::integer:
        text += std::to_string(integer_);
        break;
      case Kind::unsigned_integer:
        text += std::to_string(unsigned_);
        break;
      case Kind::number:
        append_number(text, number_);
        break;
      case Kind::vector:
        double number = 0;
        for (std::ptrdiff_t k = 0; component_(vector_, k, number); ++k) {
          if (k > 0) text += ' ';
          append_number(text, number);
        }
    }
  }

 private:
  enum class Kind { words, integer, unsigned_integer, number, vector };
  /// Appends `number` with nine digits, which distinguish any two floats.
  HMPS_COLD static void append_number(std::string& text, double number) {
    char digits[32];
    text.append(digits, std::to_chars(digits, digits + sizeof digits, number, std::chars_format::general, 9).ptr);
  }

  Kind kind_ = Kind::words;
  std::string_view words_;
  union {
    long long integer_;
    unsigned long long unsigned_;
    double number_;
    const void* vector_ = nullptr;
  };
  bool (*component_)(const void*, std::ptrdiff_t, double&) = nullptr;
};

[[nodiscard]] HMPS_COLD inline std::string join_parts(std::initializer_list<MessagePart> parts) {
  std::string text;
  for (const MessagePart& part : parts) part.append_to(text);
  return text;
}
[[noreturn]] HMPS_COLD inline void throw_input_error(std::initializer_list<MessagePart> parts) {
  throw InputError(join_parts(parts));
}

/// Joins its arguments into one message. Numbers have nine digits, which distinguish any two floats.
template <class... Parts>
[[nodiscard]] std::string message(const Parts&... parts) {
  return join_parts({MessagePart(parts)...});
}

/// Throws an `InputError` with the message `parts` unless `condition` holds.
template <class... Parts>
void require(bool condition, const Parts&... parts) {
  if (!condition) throw_input_error({MessagePart(parts)...});
}

[[noreturn]] HMPS_COLD inline void throw_index_error(std::size_t index, std::size_t size, const char* item,
                                                     const char* list) {
  throw_input_error({"hmps: ", item, " ", index, " is out of range: ", list, " ", size, " ", item, size == 1 ? "" : "s",
                     " (indices start at 0)"});
}
/// Throws an `InputError` unless `index` is below `size`, the number of `item`s, in words: `require_index(7, 5,
/// "particle", "the list has")`.
inline void require_index(std::size_t index, std::size_t size, const char* item, const char* list) {
  if (index >= size) throw_index_error(index, size, item, list);
}

}  // namespace hmps::inline HMPS_ABI::detail
