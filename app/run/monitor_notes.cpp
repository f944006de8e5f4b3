// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/monitor_notes.hpp"

#include <algorithm>
#include <string>

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;
using coupler::Monitor;

/// Of a plane problem: forces are those of a metre of thickness.
std::string unit_of(const Monitor& monitor) {
  const bool turns = monitor.dof == fem::Dof::w;
  switch (monitor.kind) {
    case Monitor::Kind::reaction:
      return turns ? "N" : "N/m";
    case Monitor::Kind::displacement:
      return turns ? "rad" : "m";
    case Monitor::Kind::formula:
      break;
  }
  return "";
}

std::string kind_of(const Monitor& monitor) {
  switch (monitor.kind) {
    case Monitor::Kind::reaction:
      return "reaction";
    case Monitor::Kind::displacement:
      return "displacement";
    case Monitor::Kind::formula:
      break;
  }
  return "formula";
}

std::string unit_of_built_in(const std::string& name) {
  return name.ends_with("_work") ? "J/m" : "";
}

}  // namespace

Json monitor_notes(const coupler::Case& the_case) {
  Json notes = Json::object();
  const auto add = [&](const std::string& name, bool in_table) {
    if (notes.contains(name)) return;
    const auto monitor = std::ranges::find(the_case.monitors, name, &Monitor::name);
    const bool own = monitor != the_case.monitors.end();
    notes[name] = {{"kind", own ? kind_of(*monitor) : "built-in"},
                   {"unit", own ? unit_of(*monitor) : unit_of_built_in(name)},
                   {"table", in_table}};
  };
  for (const std::string& name : the_case.table) add(name, true);
  for (const Monitor& monitor : the_case.monitors) add(monitor.name, false);
  for (const std::string& name : coupler::built_in_values()) add(name, false);
  return notes;
}

}  // namespace polargrain::app
