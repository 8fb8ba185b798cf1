// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hmps/core/abi.hpp"
#include "hmps/core/detail/text_file.hpp"
#include "hmps/output/detail/xml_text.hpp"

namespace hmps::inline HMPS_ABI {

/// The text of a ParaView collection (.pvd): the time in s and the file of each frame, with its name relative to the
/// collection's folder.
[[nodiscard]] inline std::string pvd_text(std::span<const std::pair<double, std::string>> frames) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  for (const auto& [time, file] : frames)
    text += "<DataSet timestep=\"" + detail::shortest(time) + "\" group=\"\" part=\"0\" file=\"" + detail::xml(file) +
            "\"/>\n";
  return text + "</Collection>\n</VTKFile>\n";
}

namespace detail {

/// The times in s of the frames of a collection that `pvd_text` wrote; of any other text, anything. Compare `text` with
/// the `pvd_text` of these times and the names that the frames should have.
[[nodiscard]] inline std::vector<double> pvd_times(std::string_view text) {
  constexpr std::string_view before = "<DataSet timestep=\"";
  std::vector<double> times;
  for (std::size_t at = text.find(before); at != std::string_view::npos; at = text.find(before)) {
    text.remove_prefix(at + before.size());
    double time = 0;
    if (!parse_number(text.substr(0, text.find('"')), time)) time = 0;
    times.push_back(time);
  }
  return times;
}

}  // namespace detail

}  // namespace hmps::inline HMPS_ABI
