// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Pages that programs write: an opening, then sections between the lines `<!-- begin NAME -->` and `<!-- end NAME
/// -->`. What stands between sections is written by hand and stays.
namespace report {

/// `page` with `section` in place of what stands between the marks of that name; at its end, where there are none.
/// Throws `InputError` where only the first mark stands.
[[nodiscard]] std::string with_section(std::string page, const std::string& name, const std::string& section);
/// `page` with `opening` in place of what stands before its first section.
[[nodiscard]] std::string with_opening(const std::string& page, const std::string& opening);

}  // namespace report
