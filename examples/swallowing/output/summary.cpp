// SPDX-License-Identifier: MIT
#include "output/summary.hpp"

#include <nlohmann/json.hpp>

#include "../../common/error.hpp"
#include "../../common/files.hpp"

namespace swallowing {

namespace {

using Json = nlohmann::ordered_json;

template <class T>
[[nodiscard]] Json nullable(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
template <class T>
[[nodiscard]] std::optional<T> optional(const Json& json, const char* name) {
  return json.at(name).is_null() ? std::nullopt : std::optional<T>(json.at(name).get<T>());
}
/// A number of a file in which null stands for a value that was not finite.
[[nodiscard]] double number(const Json& json, const char* name) {
  return optional<double>(json, name).value_or(std::numeric_limits<double>::quiet_NaN());
}

}  // namespace

void write_summary(const std::filesystem::path& path, const Summary& s) {
  Json det_f = nullptr;
  if (s.det_f)
    det_f = {{"mean", s.det_f->mean},
             {"share_within_0_98_1_02", s.det_f->share_within_0_98_1_02},
             {"min", s.det_f->min},
             {"max", s.det_f->max}};
  Json nearest = nullptr;
  if (const auto& n = s.nearest_to_limit)
    nearest = {
        {"share", n->share}, {"limit", n->limit}, {"time", n->time}, {"particle", n->particle}, {"organ", n->organ}};
  Json settings = Json::object();
  for (const auto& [name, value] : s.settings) settings[name] = value;
  const Json json = {{"case", s.case_name},
                     {"spacing", s.spacing},
                     {"time_step", s.time_step},
                     {"time_step_min", s.time_step_min},
                     {"time_step_max", s.time_step_max},
                     {"time_step_limit", s.time_step_limit},
                     {"nearest_to_limit", nearest},
                     {"steps", s.steps},
                     {"time", s.time},
                     {"scalar", s.scalar},
                     {"threads", s.threads},
                     {"friction", s.friction},
                     {"penalty", s.penalty},
                     {"contact", s.paper_contact ? "paper" : "smooth"},
                     {"particles_free", s.particles_free},
                     {"particles_control", s.particles_control},
                     {"fold_time", nullable(s.fold_time)},
                     {"fold_time_base", nullable(s.fold_time_base)},
                     {"tip_angle_min", s.tip_angle_min},
                     {"det_f", det_f},
                     {"max_penetration", s.max_penetration},
                     {"wall_seconds", s.wall_seconds},
                     {"particle_steps_per_second", s.particle_steps_per_second},
                     {"contact_share", s.contact_share},
                     {"contact_share_per_tenth", s.contact_share_per_tenth},
                     {"failure", nullable(s.failure)},
                     {"settings", settings}};
  examples::write_atomically(path, json.dump(2) + "\n");
}

std::optional<Summary> read_summary(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) return std::nullopt;
  try {
    const Json json = Json::parse(examples::read_file(path));
    Summary s;
    s.case_name = json.at("case").get<std::string>();
    s.spacing = number(json, "spacing");
    s.time_step = number(json, "time_step");
    s.time_step_min = number(json, "time_step_min");
    s.time_step_max = number(json, "time_step_max");
    s.time_step_limit = number(json, "time_step_limit");
    if (const Json& n = json.at("nearest_to_limit"); !n.is_null())
      s.nearest_to_limit = NearestToLimit{number(n, "share"), number(n, "limit"), number(n, "time"),
                                          n.at("particle").get<std::uint64_t>(), n.at("organ").get<std::string>()};
    s.steps = json.at("steps").get<std::uint64_t>();
    s.time = number(json, "time");
    s.scalar = json.at("scalar").get<std::string>();
    s.threads = json.at("threads").get<int>();
    s.friction = number(json, "friction");
    s.penalty = number(json, "penalty");
    s.paper_contact = json.value("contact", "smooth") == "paper";
    s.particles_free = json.at("particles_free").get<std::uint64_t>();
    s.particles_control = json.at("particles_control").get<std::uint64_t>();
    s.fold_time = optional<double>(json, "fold_time");
    s.fold_time_base = optional<double>(json, "fold_time_base");
    s.tip_angle_min = number(json, "tip_angle_min");
    if (const Json& det_f = json.at("det_f"); !det_f.is_null())
      s.det_f = DetF{number(det_f, "mean"), number(det_f, "share_within_0_98_1_02"), number(det_f, "min"),
                     number(det_f, "max")};
    s.max_penetration = number(json, "max_penetration");
    s.wall_seconds = number(json, "wall_seconds");
    s.particle_steps_per_second = number(json, "particle_steps_per_second");
    s.contact_share = number(json, "contact_share");
    s.contact_share_per_tenth = json.at("contact_share_per_tenth").get<std::vector<double>>();
    s.failure = optional<std::string>(json, "failure");
    if (json.contains("settings"))  // An earlier version did not write them: it agrees with nothing.
      for (const auto& [name, value] : json.at("settings").items())
        s.settings.emplace_back(name, value.get<std::string>());
    return s;
  } catch (const Json::exception& problem) {
    throw hmps::InputError(examples::message(path.string(), " is not a summary of this program: ", problem.what(),
                                             "; remove it or choose another folder with --out"));
  }
}

}  // namespace swallowing
