// SPDX-License-Identifier: MIT
#include "report/page.hpp"

#include "common/error.hpp"

namespace report {

std::string with_section(std::string page, const std::string& name, const std::string& section) {
  const std::string begin = "<!-- begin " + name + " -->\n", end = "<!-- end " + name + " -->\n";
  const std::string marked = begin + section + end;
  const auto from = page.find(begin), to = page.find(end);
  if (from == std::string::npos) return page + '\n' + marked;
  examples::require(to != std::string::npos && to > from, "the page has the mark ", begin.substr(0, begin.size() - 1),
                    " but not its end; remove the mark or restore the end");
  return page.replace(from, to + end.size() - from, marked);
}

std::string with_opening(const std::string& page, const std::string& opening) {
  const auto first = page.find("<!-- begin ");
  return first == std::string::npos ? opening : opening + '\n' + page.substr(first);
}

}  // namespace report
