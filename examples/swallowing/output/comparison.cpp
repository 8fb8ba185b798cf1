// SPDX-License-Identifier: MIT
#include "output/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <hmps/output/file_replacement.hpp>

#include "../../common/canvas.hpp"
#include "options.hpp"

namespace swallowing {

namespace {

using examples::Anchor;
using examples::Canvas;
using examples::Colour;

template <class... Values>
[[nodiscard]] std::string format(const char* pattern, Values... values) {
  char text[160];
  std::snprintf(text, sizeof(text), pattern, values...);
  return text;
}

[[nodiscard]] const char* motion(const Case& paper) { return paper.model == Model::X ? "X" : "Y"; }

/// Our result in words: a time, that it did not fold, or why there is no result.
[[nodiscard]] std::string ours(const CaseResult& result) {
  if (!result.left_out.empty()) return "other settings";
  if (!result.summary) return "not run";
  if (result.summary->fold_time) return format("%.3f s", *result.summary->fold_time);
  if (result.summary->failure) return "stopped";
  return result.summary->time > end_of_swallow - 1e-4 ? "did not fold"
                                                      : format("not until %.4g s", result.summary->time);
}
[[nodiscard]] std::string papers(const Case& paper) {
  return paper.fold_time ? format("%.2f s", *paper.fold_time) : "did not fold";
}
[[nodiscard]] std::string difference(const Case& paper, const CaseResult& result) {
  if (!paper.fold_time || !result.summary || !result.summary->fold_time) return "–";
  return format("%+.0f ms", 1e3 * (*result.summary->fold_time - *paper.fold_time));
}

/// The contacts at `path`, with the columns that its scene had; nothing if there is no file.
[[nodiscard]] ContactTable read_contacts(const std::filesystem::path& path) {
  ContactTable table;
  if (!std::filesystem::exists(path)) return table;
  const std::string text = examples::read_file(path);
  const std::string header = text.substr(0, text.find('\n'));
  table.rows = parse_table(text, header, path);
  for (std::size_t begin = 0; begin <= header.size();) {
    const std::size_t end = std::min(header.find(',', begin), header.size());
    table.names.push_back(header.substr(begin, end - begin));
    begin = end + 1;
  }
  return table;
}

constexpr Colour ink = Colour::hex(0x1d2430);
constexpr Colour faint = Colour::hex(0x6b7480);
constexpr Colour grid = Colour::hex(0xe3e7ec);
/// X in warm and Y in cold colours; low friction dark, high friction light.
constexpr std::array<Colour, 4> colours{Colour::hex(0xc01c28), Colour::hex(0xf08c2e), Colour::hex(0x1a5fb4),
                                        Colour::hex(0x33b1a6)};

}  // namespace

std::array<CaseResult, 4> read_results(const std::filesystem::path& out, const RunSettings& settings) {
  std::array<CaseResult, 4> results;
  for (std::size_t i = 0; i < 4; ++i) {
    const std::filesystem::path folder = out / cases[i].name;
    const auto summary = read_summary(folder / "summary.json");
    if (!summary) continue;
    if (const auto difference = first_difference(summary->settings, settings))
      results[i].left_out = *difference;
    else
      results[i] = {summary, read_series(folder / "series.csv"), read_contacts(folder / "contacts.csv")};
  }
  return results;
}

void write_table2(const std::filesystem::path& path, const std::array<CaseResult, 4>& results) {
  std::string text =
      "# Time of epiglottic downfolding below the horizontal\n\n"
      "| case | motion model | friction | paper, Table 2 | this program | difference | base to tip | smallest tip "
      "angle |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (std::size_t i = 0; i < 4; ++i) {
    const Case& paper = cases[i];
    const auto& summary = results[i].summary;
    text += format("| %s | %s | %g | %s | %s | %s | %s | %s |\n", std::string(paper.name).c_str(), motion(paper),
                   summary ? summary->friction : paper.friction, papers(paper).c_str(), ours(results[i]).c_str(),
                   difference(paper, results[i]).c_str(),
                   summary && summary->fold_time_base ? format("%.3f s", *summary->fold_time_base).c_str() : "–",
                   summary ? format("%.1f°", summary->tip_angle_min).c_str() : "–");
  }
  text +=
      "\nThe time is that at which the line from the centre of the epiglottis (the level of region F) to its tip\n"
      "first passes below the horizontal; \"base to tip\" reads the line from its base to its tip instead. The\n"
      "motion was calibrated on X1, X3 and Y1 on the lattice at 2.4 mm, with an eye on 1.8 mm; Y3 is a prediction.\n";
  for (const CaseResult& result : results)
    if (result.summary && result.summary->paper_contact) {
      text +=
          "Contact is that of the paper (--contact paper): its metaball and friction law, k~ = 0.3 unless given, and\n"
          "the lattice's own surface.\n";
      break;
    }
  std::string runs;
  for (std::size_t i = 0; i < 4; ++i)
    if (const auto& s = results[i].summary)
      runs +=
          format("| %s | %.3g mm | %.4g s | %s | %llu | %llu | %.1f s |\n", std::string(cases[i].name).c_str(),
                 1e3 * s->spacing, s->time_step, s->scalar.c_str(), static_cast<unsigned long long>(s->particles_free),
                 static_cast<unsigned long long>(s->particles_control), s->wall_seconds);
  if (!runs.empty())
    text +=
        "\n| case | spacing | mean time step | scalar | free particles | control particles | wall clock |\n"
        "|---|---|---|---|---|---|---|\n" +
        runs;
  for (std::size_t i = 0; i < 4; ++i)
    if (const auto& s = results[i].summary; s && s->failure)
      text += "\nCase " + std::string(cases[i].name) + " stopped: " + *s->failure + "\n";
  for (std::size_t i = 0; i < 4; ++i)
    if (const auto& reason = results[i].left_out; !reason.empty())
      text += "\nCase " + std::string(cases[i].name) + " was run with other settings: " + reason + ".\n";
  hmps::replace_file(path, text);
}

void draw_fold(const std::filesystem::path& path, const std::array<CaseResult, 4>& results) {
  constexpr double left = 92, top = 84, width = 1000, height = 600, table = left + width + 56;
  Canvas canvas(1640, 790);
  double begin = 1.3, end = end_of_swallow, low = -60, high = 90;
  for (const CaseResult& result : results)
    for (const Sample& sample : result.samples)
      if (sample.time >= begin && std::isfinite(sample.tip_angle)) {
        low = std::max(-180., std::min(low, 30 * std::floor(sample.tip_angle / 30)));
        high = std::min(180., std::max(high, 30 * std::ceil(sample.tip_angle / 30)));
      }
  const auto px = [&](double t) { return left + (t - begin) / (end - begin) * width; };
  const auto py = [&](double angle) { return top + (high - angle) / (high - low) * height; };

  canvas.text(left, 44, "Epiglottic downfolding: angle of the tip above the horizontal", 25, ink, Anchor::left, true);
  for (double angle = low; angle <= high; angle += 30) {
    canvas.line(left, py(angle), left + width, py(angle), grid, 1);
    canvas.text(left - 12, py(angle) + 6, format("%.0f°", angle), 16, faint, Anchor::right);
  }
  for (int i = 0; i <= 15; ++i) {
    const double t = begin + 0.05 * i;
    canvas.line(px(t), top, px(t), top + height, grid, 1);
    if (i % 2 == 0) canvas.text(px(t), top + height + 26, format("%.1f", t), 16, faint, Anchor::middle);
  }
  canvas.text(left + width / 2, top + height + 62, "time (s)", 18, ink, Anchor::middle);
  canvas.text_upward(28, top + height / 2, "centre to tip (degrees)", 18, ink);
  canvas.rectangle(left, py(0), width, top + height - py(0), Colour::hex(0x3584e4).opacity(0.06));
  canvas.line(left, py(0), left + width, py(0), ink, 1.6);
  canvas.text(left + 12, py(0) + 24, "below the horizontal: folded", 15, faint);

  // The paper's times; marks that share one time stand side by side.
  double last_time = 0;
  int level = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (!cases[i].fold_time) continue;
    const double t = *cases[i].fold_time;
    level = t == last_time ? level + 1 : 0;
    last_time = t;
    const double x = px(t) + 3 * level;
    canvas.line(x, top, x, top + height, colours[i].opacity(0.85), 1.8, {3, 6});
    const bool leftward = i == 0;
    canvas.text_with_halo(leftward ? x - 7 : x + 7, top + 20 + 20 * level, "paper " + std::string(cases[i].name), 15,
                          colours[i], {1, 1, 1}, leftward ? Anchor::right : Anchor::left, true);
  }

  cairo_save(canvas.cairo());
  cairo_rectangle(canvas.cairo(), left, top, width, height);
  cairo_clip(canvas.cairo());
  for (std::size_t i = 0; i < 4; ++i) {
    std::vector<std::pair<double, double>> points;
    for (const Sample& s : results[i].samples)
      if (std::isfinite(s.tip_angle)) points.emplace_back(px(s.time), py(s.tip_angle));
    canvas.line(points, Colour{1, 1, 1, 0.8}, 5.5);
    canvas.line(points, colours[i], 3, i % 2 == 0 ? std::vector<double>{} : std::vector<double>{11, 6});
  }
  for (std::size_t i = 0; i < 4; ++i)
    if (const auto& s = results[i].summary; s && s->fold_time) {
      canvas.disc(px(*s->fold_time), py(0), 8, {1, 1, 1});
      canvas.disc(px(*s->fold_time), py(0), 6, colours[i]);
    }
  cairo_restore(canvas.cairo());
  canvas.frame(left, top, width, height, faint, 1);

  double y = top + 24;
  canvas.text(table, y, "Fold time", 21, ink, Anchor::left, true);
  y += 44;
  const double column[] = {table + 52, table + 172, table + 304};
  canvas.text(column[0], y, "case", 16, faint);
  canvas.text(column[1], y, "paper", 16, faint, Anchor::middle);
  canvas.text(column[2], y, "here", 16, faint, Anchor::middle);
  canvas.line(table, y + 14, table + 380, y + 14, faint, 1);
  for (std::size_t i = 0; i < 4; ++i) {
    y += 50;
    canvas.line(table, y - 6, table + 38, y - 6, colours[i], 3.4,
                i % 2 == 0 ? std::vector<double>{} : std::vector<double>{11, 6});
    canvas.text(column[0], y, std::string(cases[i].name), 19, ink, Anchor::left, true);
    canvas.text(column[1], y, papers(cases[i]), 17, ink, Anchor::middle);
    canvas.text(column[2], y, ours(results[i]), 17, results[i].summary ? ink : faint, Anchor::middle,
                results[i].summary.has_value());
    const std::string note = format("model %s, friction %g", motion(cases[i]),
                                    results[i].summary ? results[i].summary->friction : cases[i].friction);
    canvas.text(column[0], y + 20, note, 13, faint);
  }
  y += 44;
  canvas.line(table, y, table + 380, y, faint, 1);
  y += 34;
  for (const auto& result : results)
    if (result.summary) {
      const Summary& s = *result.summary;
      canvas.text(table, y,
                  format("spacing %.3g mm, mean step %.3g s, %s", 1e3 * s.spacing, s.time_step, s.scalar.c_str()), 14,
                  faint);
      canvas.text(table, y + 22,
                  format("%llu free and %llu control particles", static_cast<unsigned long long>(s.particles_free),
                         static_cast<unsigned long long>(s.particles_control)),
                  14, faint);
      y += 44;
      break;
    }
  canvas.line(table, y + 8, table + 38, y + 8, faint, 1.8, {3, 6});
  canvas.text(table + 52, y + 13, "time in the paper's Table 2", 14, faint);
  canvas.disc(table + 19, y + 32, 6, faint);
  canvas.text(table + 52, y + 37, "time in this run", 14, faint);
  canvas.text(table, y + 66, "Calibrated on X1, X3 and Y1, lattice of 2.4 mm.", 14, faint);
  canvas.save(path);
}

}  // namespace swallowing
