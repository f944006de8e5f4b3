// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fstream>
#include <sstream>
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

}  // namespace polargrain::test
