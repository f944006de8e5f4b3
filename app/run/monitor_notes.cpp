// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/monitor_notes.hpp"

#include <algorithm>
#include <map>
#include <string>

#include "app/remarks/formula_units.hpp"

namespace polargrain::app {
namespace {

using Json = nlohmann::ordered_json;
using coupler::Monitor;

/// Forces of a plane problem are per metre of thickness.
std::string unit_of(const Monitor& monitor, const std::map<std::string, std::string>& formulas,
                    int dimension) {
  const bool turns = fem::is_rotation(monitor.dof);
  switch (monitor.kind) {
    case Monitor::Kind::reaction:
      if (dimension == 3) return turns ? "N m" : "N";
      return turns ? "N" : "N/m";
    case Monitor::Kind::displacement:
      return turns ? "rad" : "m";
    case Monitor::Kind::water:
    case Monitor::Kind::structure: {
      const Powers powers = powers_of(monitor, dimension);
      return powers == Powers{} ? "" : text_of(powers);
    }
    case Monitor::Kind::place:
      return monitor.component.unit;
    case Monitor::Kind::formula:
      break;
  }
  const auto found = formulas.find(monitor.name);
  return found == formulas.end() ? "" : found->second;
}

std::string kind_of(const Monitor& monitor) {
  switch (monitor.kind) {
    case Monitor::Kind::reaction:
      return "reaction";
    case Monitor::Kind::displacement:
      return "displacement";
    case Monitor::Kind::structure:
      return "structure";
    case Monitor::Kind::place:
      return monitor.component.is_stress ? "stress" : "displacement";
    case Monitor::Kind::water:
      return "water";
    case Monitor::Kind::formula:
      break;
  }
  return "formula";
}

/// Units of the formulas whose numbers all have one.
std::map<std::string, std::string> units_of_formulas(const coupler::Case& the_case) {
  std::map<std::string, Powers> known{{"time", {}}, {"volume_strain", {}}};
  std::map<std::string, std::string> units;
  for (const Monitor& monitor : the_case.monitors) {
    if (monitor.kind != Monitor::Kind::formula) {
      known[monitor.name] = powers_of(monitor, the_case.dimension());
      continue;
    }
    const auto is_known = [&](const std::string& name) { return known.contains(name); };
    if (!std::ranges::all_of(monitor.formula->names(), is_known)) continue;
    const FormulaUnits found =
        units_of_formula(monitor.formula->text(), [&](const std::string& name) { return known[name]; });
    if (!found.clash.empty() || !std::ranges::all_of(found.numbers, &FormulaNumber::has_unit)) continue;
    known[monitor.name] = found.result;
    if (found.result != Powers{}) units[monitor.name] = text_of(found.result);
  }
  return units;
}

std::string unit_of_built_in(const std::string& name, int dimension) {
  if (!name.ends_with("_work")) return "";
  return dimension == 3 ? "J" : "J/m";
}

}  // namespace

Json monitor_notes(const coupler::Case& the_case) {
  Json notes = Json::object();
  const std::map<std::string, std::string> formulas = units_of_formulas(the_case);
  const auto add = [&](const std::string& name, bool in_table) {
    if (notes.contains(name)) return;
    const auto monitor = std::ranges::find(the_case.monitors, name, &Monitor::name);
    const bool own = monitor != the_case.monitors.end();
    notes[name] = {{"kind", own ? kind_of(*monitor) : "built-in"},
                   {"unit", own ? unit_of(*monitor, formulas, the_case.dimension())
                                : unit_of_built_in(name, the_case.dimension())},
                   {"table", in_table}};
  };
  for (const std::string& name : the_case.table) add(name, true);
  for (const Monitor& monitor : the_case.monitors) add(monitor.name, false);
  for (const std::string& name : coupler::built_in_values()) add(name, false);
  return notes;
}

}  // namespace polargrain::app
