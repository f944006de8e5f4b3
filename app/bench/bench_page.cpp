// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/bench/bench_page.hpp"

#include <fmt/format.h>

#include "app/bench/bench_plot.hpp"

namespace polargrain::app {
namespace {

std::string introduction(const BenchAxes& axes, const std::vector<BenchResult>& results,
                         const std::vector<SizeScatter>& sizes) {
  std::string text = fmt::format(
      "<p>Reference: {}. Errors are the largest difference from its curve over {}, as a share of the curve's "
      "range. Red: no other run is both faster and closer. White: stopped before its end.</p>\n",
      escaped(results.front().setting.label), escaped(axes.x));
  if (sizes.empty()) return text;
  return text + fmt::format(
                    "<p>Squares: packings that differ in size and seed, compared with {}; the large one is "
                    "the mean of a size. Broken lines: standard deviation between the packings of a size, "
                    "where it is largest along the curve. An error below the line of the case's own number "
                    "of grains is less than what another packing would change.</p>\n",
                    escaped(reference_of_sizes(sizes)));
}

std::string table_of(const BenchTable& table) {
  std::string text = "<table>\n<tr>";
  for (const std::string& title : titles_of(table)) text += "<th>" + escaped(title) + "</th>";
  text += "</tr>\n";
  for (const BenchRow& row : table.rows) {
    text += row.on_front ? "<tr class='front'>" : "<tr>";
    for (const std::string& cell : cells_of(table, row)) text += "<td>" + escaped(cell) + "</td>";
    text += "</tr>\n";
  }
  return text + "</table>\n";
}

}  // namespace

std::string bench_page(const std::string& title, const BenchAxes& axes,
                       const std::vector<BenchResult>& results, const std::vector<SizeScatter>& sizes,
                       const BenchTable& table) {
  std::string page = fmt::format(
      "<!DOCTYPE html>\n<html lang='en'><head><meta charset='utf-8'><title>{0}</title>\n"
      "<style>body{{font-family:sans-serif;margin:2em}}table{{border-collapse:collapse}}"
      "td,th{{border:1px solid #ccc;padding:.2em .6em;text-align:left}}tr.front{{background:#fdd}}"
      "</style></head><body>\n<h1>{0}</h1>\n",
      escaped("Speed against error: " + title));
  page += introduction(axes, results, sizes);
  for (std::size_t y = 0; y < axes.y.size(); ++y) {
    const std::string plot = bench_plot(y, results, sizes);
    if (!plot.empty()) page += "<h2>" + escaped(axes.y[y]) + "</h2>\n" + plot;
  }
  page += table_of(table);
  for (const BenchRow& row : table.rows) {
    const std::string name = row.what + (row.setting.empty() ? "" : ", " + row.setting);
    if (row.steps && row.status != "done")
      page += fmt::format("<p>{}: {}</p>\n", escaped(name), escaped(row.status));
    if (!row.no_band.empty())
      page += fmt::format("<p>{}: no band: {}</p>\n", escaped(name), escaped(row.no_band));
  }
  return page + "</body></html>\n";
}

}  // namespace polargrain::app
