// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/report_remarks.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "app/page/page.hpp"

namespace polargrain::app {

std::string remarks_section(const std::vector<RunResult>& results) {
  using Json = nlohmann::ordered_json;
  const bool several = results.size() > 1;
  std::vector<TableRow> rows;
  const auto word = [](const Json& of, const char* key) {
    return of.contains(key) && of[key].is_string() ? of[key].get<std::string>() : "";
  };
  for (const RunResult& result : results) {
    if (!result.summary.is_object() || !result.summary.contains("remarks") ||
        !result.summary["remarks"].is_array())
      continue;
    for (const Json& remark : result.summary["remarks"]) {
      if (!remark.is_object()) continue;
      const long line =
          remark.contains("line") && remark["line"].is_number_integer() ? remark["line"].get<long>() : 0;
      const std::string file = std::filesystem::path(word(remark, "file")).filename().string();
      rows.push_back({{word(remark, "rank"), fmt::format("{}:{}", file, line), word(remark, "text"),
                       word(remark, "remedy")}});
      if (several) rows.back().cells.insert(rows.back().cells.begin(), result.name);
    }
  }
  if (rows.empty()) return {};
  std::vector<std::string> titles{"rank", "where", "finding before the run", "remedy"};
  if (several) titles.insert(titles.begin(), "run");
  return "<h2>Remarks on the case</h2>\n" + table(titles, rows, TableOf::text);
}

}  // namespace polargrain::app
