// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_page.hpp"

#include <fmt/format.h>

#include "app/bench/bench_charts.hpp"
#include "app/page/page.hpp"

namespace polargrain::app {
namespace {

std::string introduction(const BenchAxes& axes, const std::vector<BenchResult>& results,
                         const std::vector<SizeScatter>& sizes) {
  std::string text = fmt::format(
      "<p>Reference: {}. Errors are the largest difference from its curve over {}, as a share of the curve's "
      "range. Red, the Pareto front: no other run is both faster and closer. White: stopped before its end. Drawing a "
      "rectangle with the mouse enlarges it, a double click shows all again.</p>\n",
      escaped(results.front().setting.label), escaped(axes.x));
  if (sizes.empty()) return text;
  return text + fmt::format(
                    "<p>Squares: packings that differ in size and seed, compared with {}; the large one is "
                    "the mean of a size. Broken lines: standard deviation between the packings of a size, "
                    "where it is largest along the curve. An error below the line of the case's own number "
                    "of grains is smaller than the change by another packing.</p>\n",
                    escaped(reference_of_sizes(sizes)));
}

std::string table_of(const BenchTable& bench) {
  std::vector<TableRow> rows;
  for (const BenchRow& row : bench.rows) {
    rows.push_back({cells_of(bench, row), row.on_front ? "front" : ""});
    if (row.on_front) rows.back().cells.back() = "yes";
  }
  // Alone, as on a narrow page, the short titles of the text table say too little.
  std::vector<std::string> titles = titles_of(bench);
  for (std::string& title : titles)
    title = title == "what"    ? "varied"
            : title == "s"     ? "wall time, s"
            : title == "front" ? "Pareto front"
                               : title;
  return table(titles, rows, TableOf::text);
}

}  // namespace

std::string bench_page(const std::string& title, const BenchAxes& axes,
                       const std::vector<BenchResult>& results, const std::vector<SizeScatter>& sizes,
                       const BenchTable& bench) {
  std::string body = introduction(axes, results, sizes);
  for (std::size_t y = 0; y < axes.y.size(); ++y) {
    const std::string errors = error_chart(y, results, sizes);
    const std::string curves = curve_chart(y, axes, results);
    if (errors.empty() && curves.empty()) continue;
    body += "<h2>" + escaped(axes.y[y]) + "</h2>\n" + errors + curves;
  }
  body += table_of(bench);
  for (const BenchRow& row : bench.rows) {
    const std::string name = row.what + (row.setting.empty() ? "" : ", " + row.setting);
    if (row.steps && row.status != "done")
      body += fmt::format("<p>{}: {}</p>\n", escaped(name), escaped(row.status));
    if (!row.no_band.empty())
      body += fmt::format("<p>{}: no band: {}</p>\n", escaped(name), escaped(row.no_band));
  }
  return page("Speed against error: " + title, body);
}

}  // namespace polargrain::app
