// SPDX-License-Identifier: MIT
#include "report/chart.hpp"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace chart_test {

using namespace report;

TEST(Axis, IsLinear) {
  const Axis axis = Axis::linear(2, 4, 100, 300);
  EXPECT_DOUBLE_EQ(axis(2), 100);
  EXPECT_DOUBLE_EQ(axis(3), 200);
  EXPECT_DOUBLE_EQ(axis(4.5), 350);
}
TEST(Axis, IsLogarithmicWithATenthOfADecadeAtEitherEnd) {
  const Axis axis = Axis::logarithmic(1, 100, 0, 220);
  EXPECT_NEAR(axis(1), 10, 1e-9);
  EXPECT_NEAR(axis(10), 110, 1e-9);
  EXPECT_NEAR(axis(100), 210, 1e-9);
}
TEST(Axis, HasTicksAtPowersOfTenOrMoreWhereTheyAreFew) {
  const auto ticks = [](double low, double high) { return Axis::logarithmic(low, high, 0, 1).ticks(); };
  EXPECT_EQ(ticks(1, 1000), (std::vector<double>{1, 10, 100, 1000}));
  EXPECT_EQ(ticks(1, 10), (std::vector<double>{1, 2, 5, 10}));
}
TEST(Axis, IsAtLeastHalfADecadeLong) {
  const Axis axis = Axis::logarithmic(5, 5, 0, 100);
  EXPECT_NEAR(axis(5), 20, 1e-9);
}

/// The colour of a pixel, 0xrrggbb.
unsigned pixel(const Canvas& canvas, int x, int y) {
  cairo_surface_t* surface = cairo_get_target(canvas.cairo());
  cairo_surface_flush(surface);
  const unsigned char* row = cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface);
  return row[4 * x] | unsigned{row[4 * x + 1]} << 8 | unsigned{row[4 * x + 2]} << 16;
}

TEST(Panel, DrawsTicksAcrossAndCurves) {
  Canvas canvas(100, 80);
  Panel panel{.canvas = canvas, .x = 20, .y = 10, .width = 60, .height = 40, .grid = Colour::hex(0x00ff00)};
  panel.tick_across(50.5, "");
  EXPECT_EQ(pixel(canvas, 50, 30), 0x00ff00U);
  EXPECT_EQ(pixel(canvas, 50, 70), 0xffffffU);
  panel.tick_across(60.5, "", true);
  EXPECT_EQ(pixel(canvas, 60, 30), 0xffffffU);
  panel.tick_up(20.5, "");
  EXPECT_EQ(pixel(canvas, 40, 20), 0x00ff00U);
  panel.curve({{30, 40}, {70, 40}}, Colour::hex(0xff0000), 2, 3);
  EXPECT_EQ(pixel(canvas, 45, 40), 0xff0000U);
  EXPECT_EQ(pixel(canvas, 30, 41), 0xff0000U) << "the disc is thicker than the line";
  EXPECT_EQ(pixel(canvas, 45, 41), 0xffffffU);
}
TEST(Ring, HasAHole) {
  Canvas canvas(40, 40);
  ring(canvas, 20, 20, 10, 5, Colour::hex(0x0000ff));
  EXPECT_EQ(pixel(canvas, 20, 20), 0xffffffU);
  EXPECT_EQ(pixel(canvas, 20, 12), 0x0000ffU);
  EXPECT_EQ(pixel(canvas, 20, 35), 0xffffffU);
}

}  // namespace chart_test
