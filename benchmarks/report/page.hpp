// SPDX-License-Identifier: MIT
#pragma once

#include <string>

/// Pages that programs write: an opening, then sections between the lines `<!-- begin NAME -->` and `<!-- end NAME
/// -->`. Text between sections is written by hand and is kept.
namespace report {

/// `page` with `section` in place of the text between the marks of that name, or at the end if there are no such marks.
/// Throws `InputError` if only the first mark exists.
[[nodiscard]] std::string with_section(std::string page, const std::string& name, const std::string& section);
/// `page` with `opening` in place of the text before its first section.
[[nodiscard]] std::string with_opening(const std::string& page, const std::string& opening);

}  // namespace report
