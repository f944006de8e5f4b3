// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/proof.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>
#include <utility>

#include "app/grains/cell_paths.hpp"
#include "app/run/result_directory.hpp"
#include "common/content_hash.hpp"
#include "common/error.hpp"
#include "common/regular_file.hpp"
#include "common/state.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

/// The files that a run leaves and nothing changes afterwards.
constexpr std::array kFiles{"history.csv", "costs.csv", "run.log",      "fields.pvd",
                            "points.pvd",  kSampleFile, kCheckpointFile};
constexpr std::array kFolders{"fields", "profiles", kCellPathsFolder};

/// The files that later commands write, or that belong to one machine and one day.
constexpr std::array kOthers{"report.html",         "band.json",        "band.csv", "grains",
                             kCheckpointBeforeFile, kOldCheckpointFile, "logs",     "replay"};

std::string name_of_text(const std::string& text) {
  return name_of(std::as_bytes(std::span(text))).text();
}

/// One name for all files of a folder: the name of the list of their names and contents.
std::string name_of_folder(const fs::path& folder) {
  std::vector<fs::path> files;
  std::error_code error;
  for (fs::recursive_directory_iterator file(folder, error), end; !error && file != end;
       file.increment(error))
    files.push_back(file->path());
  if (error) throw RunError(fmt::format("{} cannot be read: {}", folder.string(), error.message()));
  std::sort(files.begin(), files.end());
  std::string list;
  for (const fs::path& file : files)
    list += file.lexically_relative(folder).string() + ' ' + name_of_file(file) + '\n';
  return name_of_text(list);
}

}  // namespace

std::string name_of_file(const fs::path& file) {
  if (!why_no_input(file).empty()) return {};
  try {
    return content_hash(file).text();
  } catch (const RunError&) {
    return {};
  }
}

std::map<std::string, std::string> names_of_results(const fs::path& directory) {
  std::map<std::string, std::string> names;
  for (const char* const file : kFiles) {
    if (std::string name = name_of_file(directory / file); !name.empty()) names[file] = std::move(name);
  }
  std::error_code error;
  for (const char* const folder : kFolders) {
    if (fs::is_directory(directory / folder, error)) names[folder] = name_of_folder(directory / folder);
  }
  return names;
}

std::vector<std::string> without_proof(const fs::path& directory) {
  std::vector<std::string> names;
  std::error_code error;
  for (const char* const name : kOthers)
    if (fs::exists(directory / name, error)) names.emplace_back(name);
  return names;
}

std::string name_of_summary(const nlohmann::ordered_json& summary) {
  // As a reader of the file finds it: bytes that are no UTF-8 are other characters there.
  constexpr auto kReplaced = nlohmann::ordered_json::error_handler_t::replace;
  nlohmann::json content = nlohmann::json::parse(summary.dump(-1, ' ', false, kReplaced));
  if (content.is_object() && content.contains("proof") && content["proof"].is_object())
    content["proof"].erase("summary");
  return name_of_text(content.dump());
}

}  // namespace polargrain::app
