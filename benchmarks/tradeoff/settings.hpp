// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "common/error.hpp"
#include "report/text.hpp"

namespace tradeoff {

using report::bullets, report::bytes, report::counted, report::rounded, report::wrapped;

/// The value of a parameter: a number in SI units, or a word such as the name of a metaball.
using Value = std::variant<double, std::string>;

/// One value for each parameter of a scene, by name, in the order in which they were given.
class Settings {
 public:
  Settings() = default;
  Settings(std::initializer_list<std::pair<std::string, Value>> values) : values_(values) {}

  /// Throws `InputError` if there is no such parameter.
  [[nodiscard]] const Value& at(std::string_view name) const {
    const auto found = std::find_if(values_.begin(), values_.end(), [&](const auto& v) { return v.first == name; });
    examples::require(found != values_.end(), "tradeoff: no parameter is called ", name,
                      "; name it among the scene's parameters");
    return found->second;
  }
  /// Throw `InputError` if there is no such parameter or its value is of the other kind.
  [[nodiscard]] double number(std::string_view name) const { return as<double>(name, "a number"); }
  [[nodiscard]] const std::string& word(std::string_view name) const { return as<std::string>(name, "a word"); }

  /// These settings with one value changed.
  [[nodiscard]] Settings with(std::string_view name, Value value) const {
    (void)at(name);
    Settings changed = *this;
    for (auto& [key, old] : changed.values_)
      if (key == name) old = std::move(value);
    return changed;
  }
  void add(std::string name, Value value) { values_.emplace_back(std::move(name), std::move(value)); }

  [[nodiscard]] auto begin() const { return values_.begin(); }
  [[nodiscard]] auto end() const { return values_.end(); }
  [[nodiscard]] bool operator==(const Settings&) const = default;

 private:
  template <class T>
  [[nodiscard]] const T& as(std::string_view name, const char* kind) const {
    const T* value = std::get_if<T>(&at(name));
    examples::require(value != nullptr, "tradeoff: the parameter ", name, " is not ", kind,
                      "; look at its values in the scene");
    return *value;
  }

  std::vector<std::pair<std::string, Value>> values_;
};

}  // namespace tradeoff
