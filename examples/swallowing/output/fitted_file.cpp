// SPDX-License-Identifier: MIT
#include "output/fitted_file.hpp"

#include <cstddef>
#include <span>

#include "../../common/error.hpp"
#include "output/checkpoint.hpp"

namespace swallowing {

namespace {

constexpr const char* file_name = "fitted.bin";

[[nodiscard]] std::span<double> coordinates(std::vector<Point>& points) {
  return {points.empty() ? nullptr : points[0].data(), 3 * points.size()};
}

}  // namespace

void write_fitted(const std::filesystem::path& out, const FittedOrgans& fitted, double spacing) {
  auto positions = fitted.particles.positions;
  Checkpoint file;
  file.set("spacing", spacing);
  file.set("positions", coordinates(positions));
  file.set("volumes", fitted.particles.volumes);
  file.set("layers", fitted.particles.layers);
  file.set("layer spacings", fitted.particles.layer_spacings);
  file.set("depth", fitted.depth);
  file.set("iterations", fitted.particles.iterations);
  file.set("largest deviation", fitted.particles.largest_deviation);
  file.save(out / file_name);
}

std::optional<FittedOrgans> read_fitted(const std::filesystem::path& out, double spacing) {
  const auto file = Checkpoint::load(out / file_name);
  if (!file) return std::nullopt;
  const auto other = file->value<double>("spacing");
  examples::require(other == spacing, (out / file_name).string(), " holds particles of a spacing of ", other,
                    " m in place of ", spacing, " m; resume with that spacing, or start anew without --resume");
  FittedOrgans fitted;
  fitted.depth = file->get<double>("depth");
  const std::size_t n = fitted.depth.size();
  auto& particles = fitted.particles;
  particles.positions.resize(n);
  particles.volumes.resize(n);
  particles.layers.resize(n);
  particles.layer_spacings.resize(n);
  auto positions = coordinates(particles.positions);
  file->get("positions", positions);
  file->get("volumes", particles.volumes);
  file->get("layers", particles.layers);
  file->get("layer spacings", particles.layer_spacings);
  particles.iterations = file->value<int>("iterations");
  particles.largest_deviation = file->value<double>("largest deviation");
  return fitted;
}

}  // namespace swallowing
