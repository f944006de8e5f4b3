// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/status_of_run.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "common/regular_file.hpp"

namespace polargrain::app {

std::string status_of_run(const std::filesystem::path& directory) {
  const std::filesystem::path file = directory / "summary.json";
  if (!why_no_input(file).empty()) return {};
  std::ifstream stream(file);
  const nlohmann::json summary = nlohmann::json::parse(stream, nullptr, false);
  const auto found = summary.find("status");  // anybody may have written the file
  return found != summary.end() && found->is_string() ? found->get<std::string>() : std::string();
}

}  // namespace polargrain::app
