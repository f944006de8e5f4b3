// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/processor.hpp"

#include <fstream>

namespace polargrain {

std::string processor_model() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    const std::size_t colon = line.find(": ");
    if (line.rfind("model name", 0) == 0 && colon != std::string::npos) return line.substr(colon + 2);
  }
  return "unknown";
}

}  // namespace polargrain
