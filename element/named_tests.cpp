// SPDX-License-Identifier: GPL-2.0-or-later
#include "element/named_tests.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "common/elementary_functions.hpp"

namespace polargrain::element {
namespace {

using Kind = Constraint::Kind;
using Way = Constraint::Way;

/// s33 - s11 - b (s22 - s11): zero where s33 is at b between the lateral and the axial stress.
Vector6 weights_of_ratio(double b) {
  Vector6 weights = Vector6::Zero();
  weights(k33) = 1.0;
  weights(k22) = -b;
  weights(k11) = b - 1.0;
  return weights;
}

Constraint equal_lateral_stresses() {
  return sum_of_stresses("s33 = s11", weights_of_ratio(0.0), Way::reach, 0.0);
}

/// Where the drive goes: compression and shear are positive in it. @param sign of the component in which it is counted
void aim(Constraint& constraint, const Drive& drive, double sign) {
  constraint.way = drive.cycles > 0 ? Way::cycle : Way::reach;
  constraint.amount = sign * drive.amount;
}

/// The axial strain, or the axial stress less the lateral one.
Constraint axial(const NamedTest& test, Room room) {
  Constraint made = test.drive.is_stress ? sum_of_stresses("deviator", weights_of_deviator(room), Way::reach)
                                         : component(Kind::strain, k22, Way::reach);
  aim(made, test.drive, test.drive.is_stress ? 1.0 : -1.0);
  return made;
}

Constraint held(int place) {
  return component(Kind::stress, place, Way::hold);
}

/// Axial loading under lateral stresses that stay, or at constant volume.
void add_lateral_stresses(Stage& stage, const NamedTest& test, bool of_axis_three) {
  if (test.undrained) {
    stage.constraints.push_back(constant_volume());
    stage.pore = k11;
    if (of_axis_three) stage.constraints.push_back(equal_lateral_stresses());
  } else {
    stage.constraints.push_back(held(k11));
    if (of_axis_three) stage.constraints.push_back(held(k33));
  }
}

void isotropic(Stage& stage, const NamedTest& test, Room room) {
  for (const int place : {k11, k22, k33})
    if (can_strain(room, place))
      stage.constraints.push_back(component(Kind::stress, place, Way::reach, -test.pressure));
}

void triaxial(Stage& stage, const NamedTest& test, Room room) {
  stage.constraints.push_back(axial(test, room));
  add_lateral_stresses(stage, test, true);
}

void biaxial(Stage& stage, const NamedTest& test, Room room) {
  Constraint drive = axial(test, room);
  if (test.drive.is_stress && can_strain(room, k33)) {  // the lateral stress is that of the membrane alone
    drive.weights.setZero();
    drive.weights(k11) = 1.0;
    drive.weights(k22) = -1.0;
  }
  stage.constraints.push_back(drive);
  add_lateral_stresses(stage, test, false);
  if (can_strain(room, k33)) stage.constraints.push_back(component(Kind::strain, k33, Way::hold));
}

void true_triaxial(Stage& stage, const NamedTest& test, Room room) {
  Constraint drive = axial(test, room);
  if (test.drive.is_stress) {  // between the largest and the least stress
    drive.weights.setZero();
    drive.weights(k11) = 1.0;
    drive.weights(k22) = -1.0;
  }
  stage.constraints.push_back(drive);
  add_lateral_stresses(stage, test, false);
  // In extension the axial stress is the least.
  const double place = test.drive.amount < 0.0 ? 1.0 - test.ratio : test.ratio;
  stage.constraints.push_back(sum_of_stresses("b", weights_of_ratio(place), Way::reach, 0.0));
}

void oedometer(Stage& stage, const NamedTest& test, Room) {
  Constraint drive = component(test.drive.is_stress ? Kind::stress : Kind::strain, k22, Way::reach);
  aim(drive, test.drive, -1.0);
  stage.constraints.push_back(drive);
}

void constant_p(Stage& stage, const NamedTest& test, Room room) {
  stage.constraints.push_back(axial(test, room));
  stage.constraints.push_back(sum_of_stresses("p", weights_of_pressure(room), Way::hold));
  if (can_strain(room, k33)) stage.constraints.push_back(equal_lateral_stresses());
}

void simple_shear(Stage& stage, const NamedTest& test, Room) {
  Constraint drive = component(test.drive.is_stress ? Kind::stress : Kind::strain, k12, Way::reach);
  aim(drive, test.drive, 1.0);
  stage.constraints.push_back(drive);
  if (test.undrained)
    stage.pore = k22;  // no strain but the shear: the volume stays
  else
    stage.constraints.push_back(held(k22));
}

void radial_unloading(Stage& stage, const NamedTest& test, Room room) {
  for (int place = 0; place < 6; ++place)
    if (can_strain(room, place))
      stage.constraints.push_back(component(Kind::stress, place, Way::scale, test.share));
}

struct Test {
  TestKind kind;
  bool needs_axis_three;
  void (*fill)(Stage& stage, const NamedTest& test, Room room);
};

/// A new test is a function above and its line here.
const std::vector<Test>& tests() {
  static const std::vector<Test> all{
      {{"isotropic", "all normal stresses to the pressure `to`", Driven::pressure, false}, false, isotropic},
      {{"triaxial", "axial loading, both lateral stresses stay", Driven::axial, true}, true, triaxial},
      {{"biaxial", "axial loading in plane strain, the lateral stress stays", Driven::axial, true},
       false,
       biaxial},
      {{"true_triaxial", "axial loading, intermediate stress at `b` or `lode`", Driven::axial, true},
       true,
       true_triaxial},
      {{"oedometer", "axial loading without lateral strain", Driven::axial, false}, false, oedometer},
      {{"constant_p", "axial loading, the mean stress stays", Driven::axial, false}, false, constant_p},
      {{"simple_shear", "shear of layers, no strain along them, the normal stress (or the volume) stays",
        Driven::shear, true},
       false,
       simple_shear},
      {{"radial_unloading", "all stresses fall to the share `to` of their values", Driven::share, false},
       false,
       radial_unloading}};
  return all;
}

const Test& test_of(const std::string& name) {
  return *std::ranges::find_if(tests(), [&](const Test& test) { return test.kind.name == name; });
}

}  // namespace

const std::vector<TestKind>& test_kinds() {
  static const std::vector<TestKind> kinds = [] {
    std::vector<TestKind> all;
    for (const Test& test : tests()) all.push_back(test.kind);
    return all;
  }();
  return kinds;
}

std::optional<std::string> refusal(const std::string& name, Room room) {
  if (!test_of(name).needs_axis_three || can_strain(room, k33)) return {};
  if (room == Room::discs)
    return fmt::format(
        "{}: a cell of discs has no third direction to strain and no stress there; its test is biaxial. For {} take a "
        "packing of spheres (dimension: 3)",
        name, name);
  return fmt::format(
      "{}: the model is one of plane strain and cannot be strained across its plane; its test is biaxial",
      name);
}

Stage stage_of(const NamedTest& test, Room room) {
  Stage stage;
  stage.name = test.name;
  stage.rows = test.rows;
  stage.cycles = test.drive.cycles;
  test_of(test.name).fill(stage, test, room);
  return stage;
}

double ratio_of_lode_angle(double angle) {
  const double tangent = sine(angle) / cosine(angle);
  return 2.0 * tangent / (std::numbers::sqrt3 + tangent);
}

}  // namespace polargrain::element
