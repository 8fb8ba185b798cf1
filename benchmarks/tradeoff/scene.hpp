// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/error.hpp"
#include "tradeoff/settings.hpp"

namespace tradeoff {

/// A parameter of a scene and the values over which it is varied; one of them is the standard.
struct Parameter {
  std::string name;
  std::vector<Value> values;  ///< in SI units
  Value standard;             ///< one of them
  std::string unit = "";      ///< for display, such as mm
  double per_unit = 1;        ///< size of that unit in SI units, such as 1e-3
  /// Whether a smaller value resolves the same problem better, so that errors should fall with it.
  bool refines = false;
  bool choice = true;  ///< false: it belongs to the problem, such as a modulus, and gives no advice

  [[nodiscard]] std::string shown(const Value& value) const {
    if (const auto* word = std::get_if<std::string>(&value)) return *word;
    return rounded(std::get<double>(value) / per_unit) + (unit.empty() ? "" : " " + unit);
  }
};

/// A quantity that is measured in a run and compared with the right answer. The error is shown in per cent of `scale`,
/// or of the right answer if the scale is 0.
struct Quantity {
  std::string name;       ///< as used in a sentence: "the frequency"
  std::string unit = "";  ///< of the values
  double scale = 0;
  double matters = 0.1;  ///< the smallest difference of errors that counts, in per cent
  bool headline = true;  ///< false: only in the CSV
};

/// The result of a run: the quantities in the order of `Scene::quantities`, and the cost.
struct Outcome {
  std::vector<double> values;
  double particle_steps = 0;
  double seconds = 0;     ///< of processor time
  std::size_t bytes = 0;  ///< of memory held while stepping
};

/// A scene to be swept. It is an aggregate: to make one of your own, write a function that fills it in. sag.cpp is the
/// shortest example.
///
/// `run(settings)` builds the scene from scratch, runs it and returns its `Outcome`. It throws `hmps::StateError` if
/// the simulation breaks down and `hmps::InputError` if settings are incompatible; both become a line of the table. A
/// value that is not finite is refused.
///
/// `known(settings)` returns the right answers in the order of the quantities. Without it, they are measured with the
/// settings `reference`, which should be much finer than all others.
struct Scene {
  std::string name;         ///< of files and of --scene
  std::string title;        ///< of the section
  std::string description;  ///< what is simulated and what it is compared with, in sentences
  std::vector<Quantity> quantities;
  std::vector<Parameter> parameters;
  /// Groups of parameters. Within a group all values are combined with each other, while parameters outside it keep
  /// their standard. So two parameters that exclude each other may both be crossed with a third.
  std::vector<std::vector<std::string>> crossed;
  std::function<Outcome(const Settings&)> run;
  std::function<std::vector<double>(const Settings&)> known = {};
  std::optional<Settings> reference = {};
  int repeats = 5;  ///< how often short runs are timed, each time beside a run of the standard

  [[nodiscard]] Settings standard() const {
    Settings settings;
    for (const Parameter& p : parameters) settings.add(p.name, p.standard);
    return settings;
  }
  [[nodiscard]] const Parameter& parameter(const std::string& wanted) const {
    for (const Parameter& p : parameters)
      if (p.name == wanted) return p;
    throw hmps::InputError(examples::message("tradeoff: the scene ", name, " has no parameter ", wanted));
  }
  /// Whether the settings belong to the same problem, that is, only choices differ from the standard.
  [[nodiscard]] bool same_problem(const Settings& settings) const {
    for (const Parameter& p : parameters)
      if (!p.choice && settings.at(p.name) != p.standard) return false;
    return true;
  }
  /// The settings that differ from `from`, in words: "spacing 5 mm, scalar float".
  [[nodiscard]] std::string difference(const Settings& settings, const Settings& from) const {
    std::string text;
    for (const Parameter& p : parameters)
      if (settings.at(p.name) != from.at(p.name))
        text += (text.empty() ? "" : ", ") + p.name + " " + p.shown(settings.at(p.name));
    return text.empty() ? "the standard" : text;
  }
};

}  // namespace tradeoff
