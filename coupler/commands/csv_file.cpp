// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/csv_file.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain::coupler {

CsvFile::CsvFile(std::filesystem::path file, const std::vector<std::string>& columns)
    : file_(std::move(file)), out_(file_, std::ios::trunc) {
  row(columns);
}

void CsvFile::row(const std::vector<std::string>& cells) {
  out_ << fmt::format("{}\n", fmt::join(cells, ",")) << std::flush;
  if (!out_) throw RunError(fmt::format("{} cannot be written; is the disk full?", file_.string()));
}

std::string exact(double value) {
  return fmt::format("{:.17g}", value);
}

}  // namespace polargrain::coupler
