// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <numbers>

#include "common/cell.hpp"

namespace polargrain::test {

inline constexpr double kNormal = 1e6;      // N/m
inline constexpr double kTangential = 4e5;  // N/m
inline constexpr double kRolling = 2.0;     // N m
inline constexpr double kDiameter = 0.01;   // m
inline constexpr double kThickness = 0.1;   // m
inline constexpr double kOverlap = 2e-4;    // of the diameter
inline constexpr double kDensity = 2650.0;  // kg/m^3

/// Columns x rows of discs (rows even), pressed together by a small isotropic strain.
inline CellDefinition lattice(int columns, int rows, CellRotations rotations) {
  CellDefinition definition;
  definition.name = "lattice";
  definition.script_file = "lattice.in";
  definition.script =
      "units si\ndimension 2\natom_style granular\natom_modify map array\nboundary p p p\nnewton off\n"
      "communicate single vel yes\nread_data ${packing}\nneighbor 0.001 bin\nneigh_modify delay 0\n"
      "fix kn all property/global kn peratomtypepair 1 1e6\nfix kt all property/global kt peratomtypepair 1 "
      "4e5\n"
      "fix gn all property/global gamman_abs peratomtypepair 1 0\n"
      "fix gt all property/global gammat_abs peratomtypepair 1 0\n"
      "fix mu all property/global coefficientFriction peratomtypepair 1 1e3\n"
      // k_th = ratio * k_t R*^2, R* a quarter of the diameter.
      "fix fr all property/global coefficientRollingFriction peratomtypepair 1 1e3\n"
      "fix kr all property/global rollingStiffnessRatio peratomtypepair 1 0.8\n"
      "pair_style gran model hooke/stiffness tangential history rolling_friction li_chu absolute_damping on\n"
      "pair_coeff * *\n"
      "fix integrate all nve/sphere\nfix plane all enforce2d\n";
  const double spacing = kDiameter * (1.0 - kOverlap);
  const double row_height = spacing * std::sqrt(3.0) / 2.0;
  definition.packing.box << columns * spacing, 0.0, 0.0, rows * row_height;
  definition.packing.thickness = kThickness;
  for (int row = 0; row < rows; ++row)
    for (int column = 0; column < columns; ++column) {
      Grain grain;
      grain.id = row * columns + column;
      grain.position = {(column + 0.5 * (row % 2) + 0.25) * spacing, (row + 0.25) * row_height};
      grain.radius = 0.5 * kDiameter;
      grain.mass = kDensity * std::numbers::pi * grain.radius * grain.radius * kThickness;
      grain.moment_of_inertia = 0.5 * grain.mass * grain.radius * grain.radius;
      definition.packing.grains.push_back(grain);
    }
  definition.control.inertial_number = 2.4e-4;
  definition.control.unbalanced_force_ratio = 1e-7;
  definition.control.unbalanced_moment_ratio = 1e-7;
  definition.control.damping = 0.5;
  definition.control.rotations = rotations;
  return definition;
}

}  // namespace polargrain::test
