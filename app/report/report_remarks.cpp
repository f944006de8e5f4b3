// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/report_remarks.hpp"

#include <fmt/format.h>

#include "app/page/page.hpp"

namespace polargrain::app {

std::string remarks_section(const std::vector<RunResult>& results) {
  using Json = nlohmann::ordered_json;
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
      rows.push_back({{result.name, word(remark, "rank"), fmt::format("{}:{}", word(remark, "file"), line),
                       word(remark, "text"), word(remark, "remedy")}});
    }
  }
  if (rows.empty()) return {};
  return "<h2>Remarks on the case</h2>\n" +
         table({"run", "rank", "where", "finding before the run", "remedy"}, rows, TableOf::text);
}

}  // namespace polargrain::app
