// SPDX-License-Identifier: MIT
#include "output/snapshots.hpp"

#include <cstdio>

#include "../../common/error.hpp"
#include "output/checkpoint.hpp"

namespace swallowing {

namespace {

[[nodiscard]] std::filesystem::path file(const std::filesystem::path& folder, double time) {
  char name[40];
  std::snprintf(name, sizeof(name), "snapshot_%.3fs.bin", time);
  return folder / name;
}

}  // namespace

Snapshots::Snapshots(const std::filesystem::path& folder, std::optional<double> resume_time) : folder_(folder) {
  std::filesystem::create_directories(folder_);
  for (const double time : snapshot_times)
    if (!resume_time || time > *resume_time + 5e-10) std::filesystem::remove(file(folder_, time));
}

void Snapshots::add(double time, const Snapshot& snapshot) const {
  Checkpoint box;  // used as a container: either complete or absent, with a checksum
  box.time = snapshot.time;
  for (const std::string& organ : snapshot.organs) box.settings.emplace_back("organ", organ);
  for (const std::string& region : snapshot.regions) box.settings.emplace_back("region", region);
  box.set("spacing", snapshot.spacing);
  box.set("positions", snapshot.positions);
  box.set("organ", snapshot.organ);
  box.set("role", snapshot.role);
  box.set("region", snapshot.region);
  box.set("centre", snapshot.centre);
  box.set("tip", snapshot.tip);
  box.set("tip_angle", snapshot.tip_angle);
  box.save(file(folder_, time));
}

std::optional<Snapshot> load_snapshot(const std::filesystem::path& folder, double time) try {
  const auto box = Checkpoint::load(file(folder, time));
  if (!box) return std::nullopt;
  Snapshot s;
  s.time = box->time;
  for (const auto& [key, name] : box->settings) (key == "region" ? s.regions : s.organs).push_back(name);
  s.spacing = box->value<double>("spacing");
  s.positions = box->get<std::array<float, 3>>("positions");
  s.organ = box->get<std::uint8_t>("organ");
  s.role = box->get<Role>("role");
  s.region = box->get<std::uint8_t>("region");
  box->get("centre", s.centre);
  box->get("tip", s.tip);
  s.tip_angle = box->value<double>("tip_angle");
  return s;
} catch (const hmps::InputError& error) {
  throw hmps::InputError(examples::message("cannot draw ", file(folder, time).string(), ": ", error.what()));
}

}  // namespace swallowing
