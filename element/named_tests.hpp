// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "element/stage.hpp"

namespace polargrain::element {

/// The drive of a test: a strain or a stress, to a value or to and fro.
struct Drive {
  bool is_stress = false;
  double amount = 0.0;  ///< where it goes, or how far to each side; strain 1, stress Pa, compression positive
  int cycles = 0;       ///< 0: it goes there and stays
};

/// A named test with its parameters; those that the test does not have are not looked at.
struct NamedTest {
  std::string name;
  Drive drive;
  bool undrained = false;  ///< the volume is kept
  double ratio = 0.0;      ///< b = (s2 - s3) / (s1 - s3) of `true_triaxial`
  double pressure = 0.0;   ///< of `isotropic`, Pa
  double share = 0.0;      ///< of `radial_unloading`: the stress that is left, over that at its start
  int rows = 100;
};

/// The driven quantity of a named test, for those who read parameters.
enum class Driven { axial, shear, pressure, share };

/// A test as its name says it.
struct TestKind {
  std::string name;
  std::string summary;  ///< for the help
  Driven driven;
  bool can_be_undrained;
};

/// All named tests, in the order of the help.
const std::vector<TestKind>& test_kinds();

/// Why a material of this kind cannot undergo a test; nothing when it can.
std::optional<std::string> refusal(const std::string& name, Room room);

/// The stage of a named test; refusal() must be empty.
Stage stage_of(const NamedTest& test, Room room);

/// b of an angle of Lode in rad, 0 (compression, b = 0) to pi/3 (extension, b = 1): tan = sqrt(3) b / (2 - b).
double ratio_of_lode_angle(double angle);

}  // namespace polargrain::element
