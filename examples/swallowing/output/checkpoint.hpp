// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <optional>
#include <ranges>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "../../common/error.hpp"
#include "../../common/files.hpp"

namespace swallowing {

/// The settings on which the bits of a run depend: name and value as text.
using RunSettings = std::vector<std::pair<std::string, std::string>>;

/// The whole state of a run at the end of a step, as named arrays of plain numbers.
class Checkpoint {
 public:
  RunSettings settings;
  double time = 0;  ///< s
  std::uint64_t step = 0;

  /// Stores a contiguous range of numbers (or of structs of numbers) under `name`.
  template <std::ranges::contiguous_range R>
  void set(const std::string& name, const R& range) {
    using T = std::ranges::range_value_t<R>;
    static_assert(std::is_trivially_copyable_v<T>, "a checkpoint stores plain numbers");
    const std::size_t size = std::ranges::size(range);
    Array array{name, sizeof(T), std::string(size * sizeof(T), '\0')};
    if (size > 0) std::memcpy(array.bytes.data(), std::ranges::data(range), array.bytes.size());
    std::erase_if(arrays_, [&](const Array& old) { return old.name == name; });
    arrays_.push_back(std::move(array));
  }
  /// Stores one number under `name`.
  template <class T>
  requires std::is_arithmetic_v<T>
  void set(const std::string& name, T value) { set(name, std::span<const T>(&value, 1)); }
  /// Whether there is an array under `name`.
  [[nodiscard]] bool contains(const std::string& name) const {
    return std::ranges::any_of(arrays_, [&](const Array& array) { return array.name == name; });
  }
  /// The array stored under `name`. Throws `InputError` if there is none, or if it has another type.
  template <class T>
  [[nodiscard]] std::vector<T> get(const std::string& name) const {
    const Array& array = find(name);
    examples::require(array.width == sizeof(T), "the checkpoint holds ", name, " with ", array.width,
                      " bytes per element, but ", sizeof(T), " were requested");
    std::vector<T> values(array.bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), array.bytes.data(), array.bytes.size());
    return values;
  }
  /// Copies the array stored under `name` into `target`. Throws `InputError` if its size differs.
  template <std::ranges::contiguous_range R>
  void get(const std::string& name, R& target) const {
    using T = std::ranges::range_value_t<R>;
    const Array& array = find(name);
    examples::require(array.width == sizeof(T) && array.bytes.size() == std::ranges::size(target) * sizeof(T),
                      "the checkpoint holds ", array.bytes.size() / array.width, " elements of ", array.width,
                      " bytes of ", name, ", the scene has ", std::ranges::size(target), " of ", sizeof(T));
    if (!array.bytes.empty()) std::memcpy(std::ranges::data(target), array.bytes.data(), array.bytes.size());
  }
  /// The single number stored under `name`.
  template <class T>
  [[nodiscard]] T value(const std::string& name) const {
    const std::vector<T> values = get<T>(name);
    examples::require(values.size() == 1, "the checkpoint holds ", values.size(), " values of ", name,
                      " instead of one");
    return values[0];
  }

  /// Writes the checkpoint to `path` atomically: whatever happens meanwhile, the file there is complete.
  void save(const std::filesystem::path& path) const;
  /// Reads the checkpoint at `path`; nothing if there is no file. Throws `InputError` if the file is damaged, is not a
  /// checkpoint, or has another version.
  [[nodiscard]] static std::optional<Checkpoint> load(const std::filesystem::path& path);

 private:
  struct Array {
    std::string name;
    std::uint64_t width = 1;  ///< bytes of one element
    std::string bytes;
  };
  [[nodiscard]] const Array& find(const std::string& name) const;

  std::vector<Array> arrays_;
};

/// The first setting in which two runs differ, in words: "spacing 0.0018 in place of 0.0024", of which `other` has the
/// first; nothing if they agree.
[[nodiscard]] std::optional<std::string> first_difference(const RunSettings& other, const RunSettings& settings);

/// How the names of those settings begin that hash the tracks of the motion.
inline constexpr std::string_view track_setting = "content of ";

/// Throws `InputError`, naming the first difference, unless the checkpoint from `path` was written by a run with the
/// same `settings`. If the motion so far is the same (`same_motion`), the tracks may differ in what is to come.
void require_same_settings(const Checkpoint& checkpoint, const RunSettings& settings, const std::filesystem::path& path,
                           bool same_motion);

}  // namespace swallowing
