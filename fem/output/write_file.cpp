// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/output/write_file.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

#include "common/error.hpp"

namespace polargrain::fem {

void write_file(const std::filesystem::path& file, const std::string& content) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream << content;
  stream.close();
  if (!stream)
    throw RunError(fmt::format("cannot write {}: is there room, and may you write there?", file.string()));
  std::error_code error;
  std::filesystem::rename(temporary, file, error);
  if (error) throw RunError(fmt::format("cannot put {} in place: {}", file.string(), error.message()));
}

}  // namespace polargrain::fem
