// SPDX-License-Identifier: GPL-2.0-or-later
// A run to start from that has not come to its end: its last checkpoint lies before its last step and its last load.
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {

void end_of_run_before(const Scene& scene, Remarks& remarks) {
  const std::filesystem::path& directory = scene.the_case().start_from;
  if (directory.empty()) return;
  // Without a summary the run was ended from outside, or is at work.
  std::ifstream file(directory / "summary.json");
  const nlohmann::json summary = nlohmann::json::parse(file, nullptr, false);
  const auto found = summary.find("status");  // anybody may have written the file
  const std::string status =
      found != summary.end() && found->is_string() ? found->get<std::string>() : std::string();
  if (status == "done") return;
  remarks.push_back(
      {Rank::doubtful, 1.0,
       scene.place({"start_from"})
           .fault(fmt::format("start_from: the run in '{}' has not come to its end{}: this one starts "
                              "from its last checkpoint, where its loads may be others",
                              directory.filename().string(),
                              status.empty() ? "" : fmt::format(" (status '{}')", status))),
       "go on with that run (--resume), or see in run.log below 'starting from' which step this is"});
}

}  // namespace polargrain::app
