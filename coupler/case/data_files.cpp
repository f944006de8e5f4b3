// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/data_files.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

#include "common/regular_file.hpp"

namespace polargrain::coupler {

std::vector<std::filesystem::path> data_places(const std::filesystem::path& case_directory) {
  std::vector<std::filesystem::path> places{case_directory};
  if (const char* data = std::getenv("POLARGRAIN_DATA"); data != nullptr && *data != '\0')
    places.emplace_back(data);
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) places.push_back(program.parent_path().parent_path() / "share" / "polargrain");
  return places;
}

std::optional<std::filesystem::path> find_data_file(const std::string& name,
                                                    const std::filesystem::path& case_directory) {
  if (name.find('\0') != std::string::npos)
    return std::nullopt;  // the system would look for what stands before it
  std::error_code error;
  for (const std::filesystem::path& place : data_places(case_directory)) {
    for (const std::filesystem::path& file : {place / name, place / "liggghts_inputs" / name}) {
      if (std::filesystem::is_regular_file(file, error)) return file;
    }
  }
  return std::nullopt;
}

std::string content_of(const std::filesystem::path& file) {
  if (!why_no_input(file).empty()) return {};
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

}  // namespace polargrain::coupler
