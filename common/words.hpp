// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <iterator>
#include <sstream>
#include <string>
#include <vector>

namespace polargrain {

/// The words of a line, parted by blanks.
inline std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  return {std::istream_iterator<std::string>(in), {}};
}

}  // namespace polargrain
