// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/result_directory.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain::coupler {
namespace fs = std::filesystem;

fs::path default_result_directory(const fs::path& case_file) {
  const fs::path name =
      case_file.stem() == "case" ? fs::absolute(case_file).parent_path().filename() : case_file.stem();
  return fs::path("results") / name;
}

void prepare_result_directory(const fs::path& directory) try {
  const std::string name = directory.string();
  if (fs::exists(directory) && !fs::is_directory(directory)) {
    throw InputError({name, 0, "is a file, so no result directory; give another with -o DIR"});
  }
  const bool is_result = fs::exists(directory / "summary.json") || fs::exists(directory / "run.log");
  if (fs::exists(directory) && !fs::is_empty(directory) && !is_result) {
    throw InputError(
        {name, 0,
         "exists and holds no former result; give an empty or new directory with -o DIR, so that no "
         "file of yours is mixed with results"});
  }
  fs::create_directories(directory);
  for (const char* file :
       {"history.csv", "costs.csv", "fields.pvd", "summary.json", "run.log", "fields", "logs", "replay"}) {
    fs::remove_all(directory / file);
  }
} catch (const fs::filesystem_error& error) {
  throw RunError(fmt::format("the result directory {} cannot be made ready: {}", directory.string(),
                             error.code().message()));
}

}  // namespace polargrain::coupler
