// SPDX-License-Identifier: MIT
#include "report/study.hpp"

#include <cstdio>
#include <exception>
#include <hmps/output/file_replacement.hpp>

#include "common/files.hpp"
#include "common/streams.hpp"
#include "report/page.hpp"

namespace report {

namespace fs = std::filesystem;

Study::Study(const std::string& name, const std::string& description, const std::string& quick_words)
    : app(description, name), out("results/" + name) {
  app.add_flag("--quick", quick, quick_words);
  app.add_option("--out", out, "folder of the tables (CSV)")->type_name("DIR")->capture_default_str()->take_last();
  app.add_option("--document", document, "page whose sections are replaced; its pictures go to images beside it")
      ->type_name("FILE")
      ->take_last();
}

int Study::run(int argc, char** argv, const std::function<void()>& measure) {
  examples::check_standard_streams(app.get_name().c_str());
  CLI11_PARSE(app, argc, argv);
  try {
    examples::prepare_folder(out);
    measure();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", app.get_name().c_str(), error.what());
    return 2;
  }
  return whole_ ? 0 : 1;
}

void Study::publish(const Table& table, const Picture& picture) {
  std::string text = '\n' + table.markdown() + '\n';
  for (const std::string& words : table.broken) text += "Failed check: " + words + ".\n";
  whole_ = whole_ && table.broken.empty();
  std::printf("%s\n%s\n", table.name.c_str(), text.c_str());
  std::fflush(stdout);
  hmps::replace_file(out / (table.name + ".csv"), table.csv());
  if (!picture.file.empty()) text += "![" + picture.words + "](images/" + picture.file + ")\n\n";
  draw(picture);
  publish(table.name, text);
}
void Study::publish(const std::string& section, const std::string& text) {
  if (!document.empty()) save(with_section(page(), section, text));
}
std::string Study::page() const {
  return document.empty() || !fs::exists(document) ? "" : examples::read_file(document);
}
void Study::save(const std::string& page) const {
  if (document.empty()) return;
  examples::prepare_folder(fs::absolute(document).parent_path());
  hmps::replace_file(document, page);
}
void Study::draw(const Picture& picture) const {
  if (document.empty() || picture.file.empty()) return;
  const fs::path images = fs::path(document).parent_path() / "images";
  examples::prepare_folder(images);
  picture.draw(images / picture.file);
}

}  // namespace report
