// SPDX-License-Identifier: GPL-2.0-or-later
// A rough wall of 4 m in associated sand, against slip lines of weighty ground (superposed with the surcharge).
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iostream>

#include "coupler/case/case.hpp"
#include "coupler/case/structure_values.hpp"

namespace polargrain::coupler {
namespace {

/// Force on the wall over gamma H^2 / 2 + q H. @param elements along the height of the wall
double coefficient(int elements, const std::string& way, int steps) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("rough_wall." + std::to_string(getpid()) + ".yaml");
  std::ofstream(file)
      << "title: a rough wall\n"
         "continuum: cauchy\n"
         "mesh:\n  rectangle:\n    size: [14 m, 6 m]\n    elements: ["
      << 14 * elements / 4 << ", " << 6 * elements / 4
      << "]\n    lines: {face: [0, 2 m, 0, 6 m], below: [0, 0, 0, 2 m]}\n"
         "materials: {sand: {model: elastoplastic, E: 20 MPa, nu: 0.25, "
         "friction_angle: 30 deg, dilatancy_angle: 30 deg, cohesion: 0.1 kPa}}\n"
         "regions: {all: sand}\n"
         "interfaces:\n"
         "  wall: {on: face, friction: 20 deg, normal_stiffness: 1 GPa/m, shear_stiffness: 100 MPa/m}\n"
         "  base: {on: below, friction: 0 deg, normal_stiffness: 1 GPa/m, shear_stiffness: 1 MPa/m}\n"
         "boundary:\n"
         "  - {on: bottom, fix: [u1, u2]}\n"
         "  - {on: right, fix: [u1]}\n"
         "  - {on: base, fix: [u1, u2]}\n"
         "  - {on: wall, fix: [u2], move: {u1: "
      << way
      << "}}\n"
         "  - {on: top, pressure: 10 kPa}\n"
         "body: [{unit_weight: 18 kN/m3}]\n"
         "initial_stress: [{surface: 6 m, unit_weight: 18 kN/m3, K0: 0.5, surcharge: 10 kPa}]\n"
         "steps: {count: "
      << steps << ", tolerance: 1e-5}\n";
  Case the_case = read_case(file);
  std::filesystem::remove(file);
  for (auto& [region, material] : the_case.problem.materials)
    material = the_case.materials.at(the_case.regions.at(region))->make_for<2>(nullptr);
  fem::Solver<2> solver(the_case.problem, the_case.solver);
  fem::StepReport report = solver.equilibrate();
  EXPECT_TRUE(report.converged) << report.message;
  for (const StepTarget& target : the_case.plan) {
    report = solver.advance(target.amount);
    EXPECT_TRUE(report.converged) << report.message;
  }
  return value_of_structure(solver.problem(), "wall", "pressure") / (18e3 * 8.0 + 10e3 * 4.0);
}

// The foot is singular: the error falls about like the element, so two meshes give the value of none. Slip lines with the surcharge
// superposed have 0.2805 and 4.886; the cohesion takes 2 c sqrt(Ka) H, or adds as much with Kp. Superposition errs on the low side
// in passive pressure. In a micropolar continuum the same meshes give 0.274 and 5.12, 32 elements 4.98 drawn on.
TEST(RoughWall, ActivePressureMeetsSlipLines) {
  const double coarse = coefficient(8, "-40 mm", 12);
  const double fine = coefficient(16, "-40 mm", 12);
  const double drawn_on = 2.0 * fine - coarse;
  std::cout << "[figure] Ka of a rough wall: " << coarse << ", " << fine << ", drawn on " << drawn_on << '\n';
  EXPECT_NEAR(drawn_on, 0.2805 - 0.0024, 0.01 * 0.2805);
}

TEST(RoughWall, PassivePressureMeetsSlipLines) {
  const double coarse = coefficient(8, "300 mm", 12);
  const double fine = coefficient(16, "300 mm", 12);
  const double drawn_on = 2.0 * fine - coarse;
  std::cout << "[figure] Kp of a rough wall: " << coarse << ", " << fine << ", drawn on " << drawn_on << '\n';
  EXPECT_LT(fine, coarse);
  EXPECT_GT(drawn_on, 4.896);  // flow is associated, so the force is that of a mechanism: an upper bound
  EXPECT_NEAR(drawn_on, 4.896, 0.01 * 4.896);
}

}  // namespace
}  // namespace polargrain::coupler
