// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/packed_values.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain {

std::vector<double> read_lists(ArchiveReader& archive, const std::string& name, std::size_t count,
                               std::size_t length) {
  std::vector<double> values = archive.doubles(name);
  if (values.size() != count * length) {
    throw RunError(
        fmt::format("'{}' holds {} values; {} times {} were expected", name, values.size(), count, length));
  }
  return values;
}

}  // namespace polargrain
