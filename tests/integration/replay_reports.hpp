// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <sstream>
#include <string>
#include <vector>

namespace polargrain::testing {

/// Of each increment that a replay prints, or that its README.md expects, the part that must not differ: increment, stress and
/// couple stress.
inline std::vector<std::string> replay_reports(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (const auto at = line.find("cell: increment ");
        at != std::string::npos && line.find(" stress ") != std::string::npos)
      lines.push_back(line.substr(at, line.find(" unbalanced") - at));
  return lines;
}

}  // namespace polargrain::testing
