// SPDX-License-Identifier: MIT
#include "output/progress.hpp"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>

namespace swallowing {

namespace {

template <class... Values>
[[nodiscard]] std::string format(const char* pattern, Values... values) {
  char text[256];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

}  // namespace

bool is_terminal() { return ::isatty(STDERR_FILENO) == 1; }

std::string duration(double seconds) {
  if (!std::isfinite(seconds) || seconds > 1e7) return "?";
  const auto s = static_cast<long>(std::lround(std::max(0., seconds)));
  if (s < 60) return format("%ld s", s);
  if (s < 3600) return format("%ld min %02ld s", s / 60, s % 60);
  return format("%ld h %02ld min", s / 3600, s % 3600 / 60);
}

std::string with_prefix(double value) {
  if (!(std::abs(value) >= 1e3)) return format("%.3g ", value);
  const int step = std::min(3, static_cast<int>(std::log10(std::abs(value)) / 3));
  const double scaled = value / std::pow(1e3, step);
  return format(scaled < 9.995 ? "%.2f %c" : scaled < 99.95 ? "%.1f %c" : "%.0f %c", scaled, " kMG"[step]);
}

double Progress::steady_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

Progress::Progress(std::ostream& out, Settings settings, Clock clock)
    : out_(&out), settings_(std::move(settings)), clock_(std::move(clock)), began_(clock_()), drawn_(began_ - 1) {
  twentieths_ = static_cast<int>(20 * settings_.start / settings_.until);
}

void Progress::update(double time, std::uint64_t steps, double smallest_j) {
  if (settings_.terminal) {
    if ((steps & 7) != 0) return;  // reading the clock takes time
    const double now = clock_();
    if (now - drawn_ < 0.1) return;
    drawn_ = now;
    draw(time, steps, smallest_j);
  } else {
    const int twentieths = static_cast<int>(20 * time / settings_.until * (1 + 1e-12));
    if (twentieths <= twentieths_) return;
    twentieths_ = twentieths;
    draw(time, steps, smallest_j);
  }
}

void Progress::finish(double time, std::uint64_t steps, double smallest_j) {
  if (settings_.terminal) {
    draw(time, steps, smallest_j);
    *out_ << '\n' << std::flush;
  } else if (static_cast<int>(20 * time / settings_.until * (1 + 1e-12)) > twentieths_) {
    draw(time, steps, smallest_j);
  }
}

void Progress::draw(double time, std::uint64_t steps, double smallest_j) {
  const double seconds = std::max(1e-9, clock_() - began_);
  const double share = std::clamp(time / settings_.until, 0., 1.);
  const double left = time > settings_.start ? seconds * (settings_.until - time) / (time - settings_.start) : 1e9;
  const double rate = static_cast<double>(steps) * static_cast<double>(settings_.particles) / seconds;
  const std::string numbers = format("%5.3f s  %sparticle-steps/s  %s left  J > %.3f", time, with_prefix(rate).c_str(),
                                     duration(left).c_str(), smallest_j);
  if (!settings_.terminal) {
    // In one piece, because other cases may be writing their lines.
    *out_ << settings_.name + ' ' + format("%3.0f %%  ", 100 * share) + numbers + '\n' << std::flush;
    return;
  }
  const int room = std::clamp(settings_.width - static_cast<int>(settings_.name.size() + numbers.size()) - 12, 0, 40);
  std::string bar;
  const int eighths = static_cast<int>(share * room * 8);
  static constexpr const char* parts[] = {" ", "▏", "▎", "▍", "▌", "▋", "▊", "▉"};
  for (int i = 0; i < room; ++i) bar += i < eighths / 8 ? "█" : i == eighths / 8 ? parts[eighths % 8] : " ";
  *out_ << "\r\033[K" << settings_.name << " ▕" << bar << "▏" << format("%3.0f %%  ", 100 * share) << numbers
        << std::flush;
}

}  // namespace swallowing
