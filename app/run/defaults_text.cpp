// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/defaults_text.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::app {

std::vector<std::string> lines_of_defaults(std::span<const coupler::KeyLeft> left) {
  std::vector<std::string> lines;
  std::vector<std::string> sections;
  for (const coupler::KeyLeft& key : left) {
    const auto place = std::ranges::find(sections, key.section) - sections.begin();
    if (place == std::ssize(sections)) {
      sections.push_back(key.section);
      lines.push_back(fmt::format("not given in {}:", key.section));
    }
    std::string& line = lines[static_cast<std::size_t>(place)];
    line += fmt::format("{} {} {}", line.ends_with(':') ? "" : ",", key.key, key.value);
  }
  return lines;
}

}  // namespace polargrain::app
