// SPDX-License-Identifier: MIT
#include "output/shaded.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "../../common/error.hpp"

namespace swallowing {

namespace {

using examples::Colour;
using Vector = Eigen::Vector3d;

/// A part of a picture that a line separates from the others: the surface of an organ, or what is cut of it.
struct Part {
  Organ organ = Organ::none;
  bool cut = false;
  bool operator==(const Part&) const = default;
};

/// A panel of samples, several in each pixel along both axes, each of which shows what is nearest to the viewer. Its
/// coordinates run to the right, upward from the top, and towards the viewer.
class Samples {
 public:
  static constexpr int per_pixel = 3;

  Samples(const Window& window, int width, int height)
      : scale_(per_pixel * window.scale),
        window_(window),
        columns_(per_pixel * width),
        rows_(per_pixel * height),
        samples_(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_)) {
    for (int o = 0; o < organ_count; ++o) colours_.push_back(colour_of(std::string(name(static_cast<Organ>(o)))));
    colours_[static_cast<std::size_t>(Organ::constrictors)] = plate_colour;
  }

  /// A place across, up and behind (m), in samples.
  [[nodiscard]] Vector place(const std::array<double, 3>& at) const {
    return {scale_ * (at[0] - window_.left), scale_ * (at[1] - window_.top), -scale_ * at[2]};
  }

  /// Fills a triangle, counter-clockwise for the viewer, between corners of some brightness.
  void triangle(const std::array<Vector, 3>& corners, const std::array<double, 3>& brightness, Part part) {
    const auto& [a, b, c] = corners;
    const double area = cross(a, b, c);
    if (!(area > 0)) return;
    // Rounding must not leave a sample on a common edge to none of the two triangles.
    const double least = -1e-9 * area;
    const auto& p = corners;  // a lambda cannot capture a, b and c
    for_each_sample(a.cwiseMin(b).cwiseMin(c), a.cwiseMax(b).cwiseMax(c), [&](const Vector& at, Sample& sample) {
      const std::array weights{cross(p[1], p[2], at), cross(p[2], p[0], at), cross(p[0], p[1], at)};
      if (weights[0] < least || weights[1] < least || weights[2] < least) return;
      double depth = 0, bright = 0;
      for (std::size_t k = 0; k < 3; ++k)
        depth += weights[k] / area * p[k][2], bright += weights[k] / area * brightness[k];
      set(sample, depth, bright, part);
    });
  }

  void ball(const Vector& middle, double radius, Part part) {
    const Vector reach = Vector::Constant(radius);
    for_each_sample(middle - reach, middle + reach, [&](const Vector& at, Sample& sample) {
      const Vector normal((at[0] - middle[0]) / radius, (at[1] - middle[1]) / radius, 0);
      const double rest = 1 - normal.squaredNorm();
      if (rest < 0) return;
      const Vector outward = normal + std::sqrt(rest) * Vector::UnitZ();
      set(sample, middle[2] + radius * outward[2], brightness_of(outward), part);
    });
  }

  [[nodiscard]] static double brightness_of(const Vector& normal) {
    static const Vector light = Vector(-0.4, 0.6, 0.7).normalized();
    return 0.5 + 0.5 * std::max(0., normal.dot(light));
  }

  /// Draws all upon the canvas.
  void paint(examples::Canvas& canvas) const {
    const int width = columns_ / per_pixel, height = rows_ / per_pixel;
    cairo_surface_t* surface = cairo_image_surface_create(CAIRO_FORMAT_ARGB32, width, height);
    examples::require(cairo_surface_status(surface) == CAIRO_STATUS_SUCCESS, "no memory for a picture of ", width,
                      " by ", height, " pixels");
    const auto stride = cairo_image_surface_get_stride(surface);
    unsigned char* data = cairo_image_surface_get_data(surface);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const Colour mean = pixel(x, y);
        const auto byte = [](double value) { return static_cast<std::uint32_t>(std::lround(255 * value)); };
        // Cairo's pixels are premultiplied by their opacity.
        *reinterpret_cast<std::uint32_t*>(data + y * stride + 4 * x) =
            byte(mean.a) << 24 | byte(mean.r) << 16 | byte(mean.g) << 8 | byte(mean.b);
      }
    cairo_surface_mark_dirty(surface);
    cairo_set_source_surface(canvas.cairo(), surface, 0, 0);
    cairo_paint(canvas.cairo());
    cairo_surface_destroy(surface);
  }

 private:
  struct Sample {
    float depth = -std::numeric_limits<float>::infinity();  // in front
    float brightness = 0;
    Part part;
  };

  [[nodiscard]] static double cross(const Vector& a, const Vector& b, const Vector& c) {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }
  template <class Visit>
  void for_each_sample(const Vector& lower, const Vector& upper, Visit&& visit) {
    const auto first = [](double from, int end) {
      return static_cast<int>(std::clamp(std::ceil(from - 0.5), 0., 1. * end));
    };
    for (int row = first(-upper[1], rows_); row < rows_ && row + 0.5 <= -lower[1]; ++row)
      for (int column = first(lower[0], columns_); column < columns_ && column + 0.5 <= upper[0]; ++column)
        visit(Vector(column + 0.5, -(row + 0.5), 0), samples_[index(column, row)]);
  }
  static void set(Sample& sample, double depth, double brightness, Part part) {
    if (depth > static_cast<double>(sample.depth))
      sample = {static_cast<float>(depth), static_cast<float>(brightness), part};
  }
  [[nodiscard]] std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column);
  }

  /// Whether a line runs along a sample: where its part ends, or where the surface is interrupted.
  [[nodiscard]] bool line_at(int column, int row) const {
    constexpr double step = 2e-3;  // m
    const Sample& here = samples_[index(column, row)];
    const auto differs = [&](bool exists, int c, int r) {
      if (!exists) return false;
      const Sample& other = samples_[index(c, r)];
      return other.part != here.part || std::abs(other.depth - here.depth) > static_cast<float>(step * scale_);
    };
    return differs(column > 0, column - 1, row) || differs(column + 1 < columns_, column + 1, row) ||
           differs(row > 0, column, row - 1) || differs(row + 1 < rows_, column, row + 1);
  }
  [[nodiscard]] Colour colour_at(int column, int row) const {
    const Sample& here = samples_[index(column, row)];
    constexpr double fading = 0.035;  // m
    const double fog = 0.14 + 0.4 * (1 - std::exp(std::min(0., static_cast<double>(here.depth)) / scale_ / fading));
    const Colour& plain = colours_[static_cast<std::size_t>(here.part.organ)];
    if (here.part.cut) return line_at(column, row) ? plain.mixed(ink, 0.75) : plain;
    const Colour shaded = plain.mixed(ink, 1 - static_cast<double>(here.brightness)).mixed(ground, fog);
    return line_at(column, row) ? shaded.mixed(ink, 0.45) : shaded;
  }
  /// The mean colour of a pixel, premultiplied by its opacity.
  [[nodiscard]] Colour pixel(int x, int y) const {
    Colour sum{0, 0, 0, 0};
    for (int row = per_pixel * y; row < per_pixel * (y + 1); ++row)
      for (int column = per_pixel * x; column < per_pixel * (x + 1); ++column) {
        if (samples_[index(column, row)].part.organ == Organ::none) continue;
        const Colour colour = colour_at(column, row);
        sum.r += colour.r, sum.g += colour.g, sum.b += colour.b, sum.a += 1;
      }
    constexpr double count = per_pixel * per_pixel;
    return {sum.r / count, sum.g / count, sum.b / count, sum.a / count};
  }

  double scale_;  // samples per m
  Window window_;
  int columns_, rows_;
  std::vector<Colour> colours_;  // of the organs
  std::vector<Sample> samples_;
};

/// The normals at the vertices, of the triangles that are not cut at the midsagittal plane.
[[nodiscard]] std::vector<Vector> normals_of(const CarriedOrgans& organs, const std::vector<Vector>& vertices) {
  std::vector<Vector> normals(vertices.size(), Vector::Zero());
  for (std::size_t t = 0; t < organs.triangles().size(); ++t) {
    if (organs.cut(t)) continue;
    const auto& [a, b, c] = organs.triangles()[t];
    const Vector area = (vertices[b] - vertices[a]).cross(vertices[c] - vertices[a]);
    for (const hmps::Index v : organs.triangles()[t]) normals[v] += area;
  }
  for (Vector& normal : normals) normal.normalize();
  return normals;
}

}  // namespace

void draw_shaded(examples::Canvas& canvas, const CarriedOrgans& organs, const Snapshot& snapshot, const View& view,
                 const Window& window) {
  double left = 0, top = 0, right = 0, bottom = 0;
  cairo_clip_extents(canvas.cairo(), &left, &top, &right, &bottom);
  Samples samples(window, static_cast<int>(std::ceil(right)), static_cast<int>(std::ceil(bottom)));
  std::vector<Vector> vertices;
  for (const auto& vertex : organs.vertices(snapshot.positions))
    vertices.push_back(samples.place(view.project(vertex)));
  const std::vector<Vector> normals = normals_of(organs, vertices);
  for (std::size_t t = 0; t < organs.triangles().size(); ++t) {
    const auto& triangle = organs.triangles()[t];
    const Part part{organs.organ()[triangle[0]], organs.cut(t)};
    std::array<Vector, 3> corners;
    std::array brightness{1., 1., 1.};
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = vertices[triangle[k]];
      if (!part.cut) brightness[k] = Samples::brightness_of(normals[triangle[k]]);
    }
    samples.triangle(corners, brightness, part);
  }
  const double radius = Ball::radius * snapshot.spacing * window.scale * Samples::per_pixel;
  for (std::size_t i = 0; i < snapshot.positions.size(); ++i)
    if (snapshot.role[i] == Role::plate && view.shows(snapshot, i))
      samples.ball(samples.place(view.project(snapshot.positions[i])), radius, {Organ::constrictors});
  samples.paint(canvas);
}

}  // namespace swallowing
