// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "common/cell.hpp"

namespace polargrain::test {

inline std::string file_text(const std::string& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

/// The material of cases/biaxial with the settings of its case; tests run in the root of the project.
inline CellDefinition demo_cell() {
  CellDefinition definition;
  definition.name = "sand";
  definition.script_file = "liggghts_inputs/cells/hooke_radii.in";
  definition.script = file_text(definition.script_file);
  definition.packing = read_packing("cases/biaxial/packing400.csv");
  return definition;
}

/// The same with rolling resistance (li_chu): spring `stiffness_ratio` k_t R*^2, limit `friction` R* f_n.
inline CellDefinition rolling_cell(double stiffness_ratio, double friction) {
  CellDefinition definition = demo_cell();
  std::string& script = definition.script;
  const std::string style = "pair_style      gran model hooke/radii tangential history";
  const auto place = script.find(style);
  if (place == std::string::npos) throw std::logic_error("the script of the demonstration has changed");
  script.replace(place, style.size(),
                 "fix rolling_friction all property/global coefficientRollingFriction peratomtypepair 1 " +
                     std::to_string(friction) +
                     "\nfix rolling_stiffness all property/global rollingStiffnessRatio peratomtypepair 1 " +
                     std::to_string(stiffness_ratio) + "\n" + style + " rolling_friction li_chu");
  return definition;
}

}  // namespace polargrain::test
