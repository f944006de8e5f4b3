// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/proof.hpp"

#include <algorithm>
#include <span>

#include "common/state.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

std::string name_of_text(const std::string& text) {
  return name_of(std::as_bytes(std::span(text))).text();
}

/// One name for all files of a folder: that of the list of their names and contents.
std::string name_of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::string list;
  for (const fs::path& file : files) list += file.filename().string() + ' ' + name_of_file(file) + '\n';
  return name_of_text(list);
}

}  // namespace

std::string name_of_file(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) ? name_of_text(coupler::content_of(file)) : std::string();
}

std::map<std::string, std::string> names_of_results(const fs::path& directory) {
  std::map<std::string, std::string> names;
  for (const char* const file : {"history.csv", "fields.pvd", "points.pvd", kSampleFile}) {
    if (std::string name = name_of_file(directory / file); !name.empty()) names[file] = std::move(name);
  }
  std::error_code error;
  if (fs::is_directory(directory / "fields", error)) names["fields"] = name_of_folder(directory / "fields");
  return names;
}

}  // namespace polargrain::app
