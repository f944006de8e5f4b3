// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/resume.hpp"

#include <fmt/format.h>

#include "common/error.hpp"

namespace polargrain::app {

std::string resume_command(const RunOptions& options, const std::filesystem::path& directory) {
  std::string command =
      fmt::format("polargrain run {} -o {}", options.case_file.string(), directory.string());
  for (const std::string& setting : options.settings) command += fmt::format(" --set '{}'", setting);
  if (options.scripts.trusted) command += " --trust-scripts";
  return command + " --resume";
}

std::unique_ptr<coupler::Checkpoint> checkpoint_for(const coupler::Case& the_case,
                                                    const std::filesystem::path& file) {
  constexpr std::size_t kMostShown = 10;
  auto checkpoint = std::make_unique<coupler::Checkpoint>(coupler::read_checkpoint(file));
  std::vector<std::string> lines = differences(checkpoint->identity, the_case.identity);
  if (lines.empty()) return checkpoint;
  if (lines.size() > kMostShown) {
    const std::size_t more = lines.size() - kMostShown;
    lines.resize(kMostShown);
    lines.push_back(fmt::format("and {} more", more));
  }
  throw InputError(
      {file.string(), 0,
       fmt::format("this checkpoint is of another case than {}:\n  {}\nundo these changes, or run without "
                   "--resume",
                   the_case.file.string(), fmt::join(lines, "\n  "))});
}

}  // namespace polargrain::app
