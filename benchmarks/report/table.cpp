// SPDX-License-Identifier: MIT
#include "report/table.hpp"

#include <charconv>
#include <utility>

#include "common/csv_writer.hpp"
#include "common/error.hpp"

namespace report {
namespace {

std::string joined(const Cells& cells, const char* between) {
  std::string text;
  for (std::size_t c = 0; c < cells.size(); ++c) text += (c > 0 ? between : "") + cells[c];
  return text;
}

}  // namespace

void Table::check(bool holds, const std::string& what) {
  if (!holds) broken.push_back((name.empty() ? "" : name + ": ") + what);
}
std::string Table::markdown() const {
  std::string text = "| " + joined(header, " | ") + " |\n|";
  for (std::size_t c = 0; c < header.size(); ++c) text += "---|";
  text += '\n';
  for (const Cells& row : rows) text += "| " + joined(row, " | ") + " |\n";
  return text;
}
std::string Table::csv() const {
  const auto line = [](Cells cells) {
    for (std::string& cell : cells)
      if (cell.find_first_of(",\"\n") != std::string::npos) cell = in_quotes(cell);
    return csv_line(cells);
  };
  std::string text = line(header);
  for (const Cells& row : rows) text += line(row);
  return text;
}

std::string spanning(std::string text, std::size_t columns) {
  for (; columns > 0; --columns) text += " |";
  return text;
}

std::string csv_line(const Cells& cells) { return joined(cells, ",") + '\n'; }
std::string in_quotes(std::string_view text) {
  std::string out = "\"";
  for (const char c : text) (out += c) += c == '"' ? "\"" : "";
  return out + '"';
}
std::string in_full(double value) { return examples::to_text(value); }

std::vector<Cells> read_csv(std::string_view text) {
  std::vector<Cells> lines;
  Cells line(1);
  bool within = false;  // inside quotes
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (within && c == '"' && i + 1 < text.size() && text[i + 1] == '"')
      line.back() += text[++i];
    else if (c == '"')
      within = !within;
    else if (c == ',' && !within)
      line.emplace_back();
    else if (c == '\n' && !within)
      lines.push_back(std::exchange(line, Cells(1)));
    else
      line.back() += c;
  }
  return lines;
}
double number(const std::string& cell) {
  double value = 0;
  const auto [end, problem] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  examples::require(problem == std::errc() && end == cell.data() + cell.size(), "a table has '", cell,
                    "' where a number should stand; run the study again");
  return value;
}

}  // namespace report
