// SPDX-License-Identifier: GPL-2.0-or-later
// polargrain examples: the ready cases that come along, listed and copied.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <sstream>

#include "app/commands/command.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::app {
namespace {

struct ExamplesOptions {
  std::string name;
  std::filesystem::path directory;
};

/// "Biaxial compression of boxes of grains": the heading of the README of an example.
std::string heading_of(const std::filesystem::path& readme) {
  std::istringstream text(coupler::content_of(readme));
  std::string line;
  std::getline(text, line);
  return line.starts_with("# ") ? line.substr(2) : "";
}

/// Folders of what comes along that have a README, by name.
std::map<std::string, std::filesystem::path> examples_there_are() {
  std::map<std::string, std::filesystem::path> examples;
  const std::vector<std::filesystem::path> places = coupler::data_places({});
  std::error_code error;
  for (auto place = places.begin() + 1; place != places.end(); ++place) {  // the first is the present folder
    for (const auto& entry : std::filesystem::directory_iterator(*place / "cases", error))
      if (std::filesystem::is_regular_file(entry.path() / "README.md", error))
        examples.try_emplace(entry.path().filename().string(), entry.path());
  }
  if (examples.empty())
    throw RunError(
        "the examples, which come with the program, are not found: set POLARGRAIN_DATA to the folder that has "
        "liggghts_inputs/ and cases/");
  return examples;
}

int list() {
  for (const auto& [name, folder] : examples_there_are())
    tell(stdout, "  {:<14} {}\n", name, heading_of(folder / "README.md"));
  tell(stdout, "To copy one into a new folder of yours: polargrain examples NAME -o DIR\n");
  return 0;
}

int copy(const ExamplesOptions& options) {
  const auto examples = examples_there_are();
  const auto found = examples.find(options.name);
  if (found == examples.end()) {
    std::vector<std::string> names;
    for (const auto& [name, folder] : examples) names.push_back(name);
    const std::string guess = coupler::nearest(options.name, names);
    throw InputError({"", 0,
                      fmt::format("examples: there is no '{}'; {}", options.name,
                                  guess.empty() ? "there are " + coupler::listed(names)
                                                : "did you mean '" + guess + "'?")});
  }
  const std::filesystem::path to =
      options.directory.empty() ? std::filesystem::path(options.name) : options.directory;
  std::error_code error;
  if (std::filesystem::exists(to, error) &&
      (!std::filesystem::is_directory(to, error) || !std::filesystem::is_empty(to, error)))
    throw InputError(
        {"", 0, fmt::format("-o {}: is there already, and left alone; name a new folder", to.string())});
  std::filesystem::copy(found->second, to, std::filesystem::copy_options::recursive);
  // Installed files may be for reading alone; the copy is the user's.
  for (const auto& entry : std::filesystem::recursive_directory_iterator(to))
    std::filesystem::permissions(entry.path(), std::filesystem::perms::owner_write,
                                 std::filesystem::perm_options::add);
  tell(stdout, "{}: {}\nRead {} first\n", to.string(), heading_of(to / "README.md"),
       (to / "README.md").string());
  if (std::filesystem::exists(to / "case.yaml"))
    tell(stdout, "  polargrain check {0}\n  polargrain run {0}\n", (to / "case.yaml").string());
  return 0;
}

}  // namespace

Command add_examples(CLI::App& program, const Grains&) {
  const auto options = std::make_shared<ExamplesOptions>();
  CLI::App& command = *program.add_subcommand("examples", "List the examples that come along, or copy one");
  command.add_option("NAME", options->name, "The example to copy; without it all are listed");
  command.add_option("-o,--output", options->directory, "New folder [NAME]")->type_name("DIR");
  return {&command, [options] { return options->name.empty() ? list() : copy(*options); }};
}

}  // namespace polargrain::app
