// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/profiles.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <map>

#include "app/page/page.hpp"
#include "coupler/case/place_values.hpp"

namespace polargrain::app {
namespace {

constexpr std::size_t kMostSteps = 5;  ///< lines of a chart

/// Step and file of all tables of each profile, in the order of the steps.
std::map<std::string, std::map<int, std::filesystem::path>> tables_of(
    const std::filesystem::path& directory) {
  std::map<std::string, std::map<int, std::filesystem::path>> tables;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(directory, error)) {
    const std::string name = entry.path().stem().string();
    const std::size_t dash = name.rfind('-');
    if (entry.path().extension() != ".csv" || dash == std::string::npos) continue;
    int step = 0;
    const auto [end, fault] = std::from_chars(name.data() + dash + 1, name.data() + name.size(), step);
    if (fault == std::errc() && end == name.data() + name.size())
      tables[name.substr(0, dash)][step] = entry.path();
  }
  return tables;
}

/// The steps that are drawn: evenly spread, the last one among them.
std::vector<int> steps_of(const std::map<int, std::filesystem::path>& tables) {
  std::vector<int> all;
  for (const auto& [step, file] : tables) all.push_back(step);
  if (all.size() <= kMostSteps) return all;
  std::vector<int> some;
  for (std::size_t k = 0; k < kMostSteps; ++k) some.push_back(all[k * (all.size() - 1) / (kMostSteps - 1)]);
  return some;
}

}  // namespace

std::string profiles_section(const RunResult& result) {
  constexpr std::string_view kPlaces[] = {"distance", "x1", "x2", "x3"};
  const int dimension = result.is_in_space() ? 3 : 2;
  std::string text;
  for (const auto& [name, tables] : tables_of(result.directory / "profiles")) {
    std::map<std::string, std::vector<ChartSeries>> charts;
    std::vector<std::string> order;
    for (const int step : steps_of(tables)) {
      const CsvTable table(tables.at(step));
      for (const std::string& value : table.names()) {
        if (std::ranges::find(kPlaces, value) != std::end(kPlaces)) continue;
        if (!charts.contains(value)) order.push_back(value);
        ChartSeries line;
        line.name = fmt::format("step {}", step);
        line.line = true;
        for (std::size_t row = 0; row < table.rows(); ++row)
          line.points.emplace_back(table.figure(row, table.column("distance")),
                                   table.figure(row, table.column(value)));
        charts[value].push_back(std::move(line));
      }
    }
    for (const std::string& value : order) {
      const coupler::PlaceValue* const known = coupler::place_value(value, dimension);
      text += chart({.title = "distance along " + name, .unit = "m"},
                    {.title = value, .unit = known == nullptr ? "" : known->unit}, charts[value], true);
    }
  }
  return text.empty() ? text : "<div class='grid'>\n" + text + "</div>\n";
}

}  // namespace polargrain::app
