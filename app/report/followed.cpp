// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/report/followed.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string_view>

#include "coupler/case/case.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;

/// The monitors as the summary has them; empty where it is not there or of another form.
Json monitors_of(const RunResult& result) {
  if (!result.summary.is_object()) return Json::object();
  const auto found = result.summary.find("monitors");
  return found != result.summary.end() && found->is_object() ? *found : Json::object();
}

std::string text_of(const Json& note, const char* key) {
  if (!note.is_object()) return "";
  const auto found = note.find(key);
  return found != note.end() && found->is_string() ? found->get<std::string>() : "";
}

bool is_in_table(const Json& note) {
  if (!note.is_object()) return false;
  const auto found = note.find("table");
  return found != note.end() && found->is_boolean() && found->get<bool>();
}

/// A value that every run has, whatever its case.
bool is_built_in(const std::string& name) {
  return std::ranges::find(coupler::built_in_values(), name) != coupler::built_in_values().end();
}

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

/// All names of values, the listed ones first.
std::vector<std::string> in_order(const std::vector<RunResult>& results) {
  std::vector<std::string> names;
  for (const RunResult& result : results) {
    const Json notes = monitors_of(result);
    for (const auto& [name, note] : notes.items())
      if (is_in_table(note)) add_once(names, name);
  }
  for (const bool built_in : {false, true})
    for (const RunResult& result : results)
      for (const std::string& name : result.value_names())
        if (is_built_in(name) == built_in) add_once(names, name);
  return names;
}

bool has(const RunResult& result, const std::string& name) {
  const std::vector<std::string> names = result.value_names();
  return std::ranges::find(names, name) != names.end();
}

bool changes(const RunResult& result, const std::string& name) {
  const std::size_t column = result.history->column(name);
  std::optional<double> first;
  for (std::size_t row = 0; row < result.history->rows(); ++row) {
    const double value = result.history->figure(row, column);
    if (std::isnan(value)) continue;  // 0/0, as at the start of a ratio
    if (first && value != *first) return true;
    first = value;
  }
  return false;
}

bool is_strain(const std::string& name) {
  return name != "volume_strain" && name.find("strain") != std::string::npos;
}

bool is_displacement(const RunResult& result, const std::string& name) {
  const Json notes = monitors_of(result);
  const auto found = notes.find(name);
  return found != notes.end() && text_of(*found, "kind") == "displacement";
}

}  // namespace

FollowedNames followed_names(const std::vector<RunResult>& results, const std::string& x) {
  const auto is_listed = [&](const std::string& name) {
    return std::ranges::any_of(results, [&](const RunResult& result) {
      const Json notes = monitors_of(result);
      const auto found = notes.find(name);
      return found != notes.end() && is_in_table(*found);
    });
  };
  FollowedNames names;
  for (const std::string& name : in_order(results)) {
    const bool is_there =
        std::ranges::any_of(results, [&](const RunResult& result) { return has(result, name); });
    if (name == x || !is_there) continue;
    (is_listed(name) ? names.listed : names.others).push_back(name);
  }
  if (names.listed.empty()) names.listed.swap(names.others);
  return names;
}

std::string unit_of_value(const std::vector<RunResult>& results, const std::string& name) {
  std::string unit;
  for (const RunResult& result : results) {
    const Json notes = monitors_of(result);
    const auto found = notes.find(name);
    const std::string own = found == notes.end() ? "" : text_of(*found, "unit");
    if (&result != &results.front() && own != unit) return "";
    unit = own;
  }
  return unit;
}

std::string value_moved(const std::vector<RunResult>& results) {
  const auto suits = [&](const std::string& name) {
    return std::ranges::all_of(results, [&](const RunResult& result) {
      return !result.history || result.history->rows() == 0 || (has(result, name) && changes(result, name));
    });
  };
  const FollowedNames names = followed_names(results, "");
  for (const auto* const of : {&names.listed, &names.others}) {
    for (const std::string& name : *of)
      if (is_strain(name) && suits(name)) return name;
    for (const std::string& name : *of)
      if (is_displacement(results.front(), name) && suits(name)) return name;
  }
  return "time";
}

}  // namespace polargrain::app
