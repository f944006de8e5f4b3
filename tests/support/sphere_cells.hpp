// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/support/cell_fixture.hpp"

namespace polargrain::test {

/// Tests run in the root of the project.
inline CellDefinition spheres(const char* script_file, const char* packing) {
  CellDefinition definition;
  definition.name = "spheres";
  definition.script_file = script_file;
  definition.script = file_text(definition.script_file);
  definition.packing = read_packing(packing);
  return definition;
}

/// The spheres of cases/spheres under their script.
inline CellDefinition linear_spheres() {
  return spheres("liggghts_inputs/cells/spheres_hooke_radii.in", "cases/spheres/packing1000.csv");
}

inline CellDefinition hertz_spheres() {
  return spheres("liggghts_inputs/cells/spheres_hertz.in", "tests/data/packing500_hertz.csv");
}

/// Their contacts with springs that turn with them, and resistance to bending and torsion: li_chu in full.
inline CellDefinition rolling_spheres(CellDefinition definition, double stiffness_ratio, double friction,
                                      bool torsion = true) {
  const std::string stock = "tangential history";
  const auto place = definition.script.find("pair_style");
  if (place == std::string::npos || definition.script.find(stock, place) == std::string::npos)
    throw std::logic_error("a script of spheres has changed");
  definition.script.replace(
      definition.script.find(stock, place), stock.size(),
      std::string("tangential li_chu rolling_friction li_chu torsionTorque ") + (torsion ? "on" : "off"));
  definition.script.insert(
      place, "fix rolling_friction all property/global coefficientRollingFriction peratomtypepair 1 " +
                 std::to_string(friction) +
                 "\nfix rolling_stiffness all property/global rollingStiffnessRatio peratomtypepair 1 " +
                 std::to_string(stiffness_ratio) + "\n");
  return definition;
}

/// A row of a path of the independent code (tests/data/README.md).
struct SpacePathRow {
  std::string path;
  int row = 0;
  Eigen::Matrix3d gradient;  ///< increment of L of the row
  Eigen::Matrix3d stress;    ///< after it, Pa
};

inline std::vector<SpacePathRow> space_paths(const std::string& file) {
  std::istringstream lines(file_text(file));
  std::string line;
  std::getline(lines, line);
  std::vector<SpacePathRow> rows;
  while (std::getline(lines, line)) {
    for (char& letter : line)
      if (letter == ',') letter = ' ';
    std::istringstream values(line);
    SpacePathRow row;
    values >> row.path >> row.row;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) values >> row.gradient(i, j);
    Eigen::Matrix3d& s = row.stress;
    values >> s(0, 0) >> s(1, 1) >> s(2, 2) >> s(0, 1) >> s(1, 0) >> s(0, 2) >> s(2, 0) >> s(1, 2) >> s(2, 1);
    rows.push_back(row);
  }
  return rows;
}

}  // namespace polargrain::test
