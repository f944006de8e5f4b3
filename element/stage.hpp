// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "element/material_point.hpp"

namespace polargrain::element {

/// One quantity that is prescribed over a stage: a sum of stresses, a sum of strains, or the volume. Tension is positive,
/// as everywhere; strains are those of the stage's zero: e_ii the lengthening over the length, e_12 = d u_1 / d x_2.
struct Constraint {
  enum class Kind { stress, strain, volume };
  /// The course of it over the stage, from the value that it has at the start.
  enum class Way {
    hold,   ///< it stays
    reach,  ///< it goes straight to `amount`
    cycle,  ///< it goes by +amount, then by -amount, then back, as often as the stage has cycles
    scale   ///< it goes straight to the value of the start times `amount`
  };
  Kind kind = Kind::strain;
  Way way = Way::hold;
  /// Which component it prescribes (Place); -1: several at once, so that one of the normal components is left to it.
  int place = -1;
  Vector6 weights = Vector6::Zero();  ///< of the six components; unused of the volume
  double amount = 0.0;
  std::string name;  ///< for messages: "s11", "p", ...
};

/// Stress or strain of one component.
Constraint component(Constraint::Kind kind, int place, Constraint::Way way, double amount = 0.0);
/// A sum of stresses. @param weights in the order of Place
Constraint sum_of_stresses(const std::string& name, const Vector6& weights, Constraint::Way way,
                           double amount = 0.0);
Constraint constant_volume();

/// A part of a test with rules of its own.
struct Stage {
  std::string name;
  std::vector<Constraint> constraints;
  int rows = 100;     ///< recorded, equally spaced over the stage
  int cycles = 0;     ///< of the cycled conditions; 0: nothing is cycled
  bool zero = false;  ///< strains are counted anew from its start
  /// Where the volume is kept: the normal component whose total stress stays, so that the water carries its change; -1:
  /// drained, without pore pressure.
  int pore = -1;
};

/// The weights of minus the mean stress p, compression positive: over the normal stresses that there are.
Vector6 weights_of_pressure(Room room);
/// Axial stress less the mean of the lateral ones, compression positive.
Vector6 weights_of_deviator(Room room);

/// The faults of a stage for a material: a component given twice, one that the material does not have, more or fewer
/// conditions than there are components. Empty: no fault.
std::vector<std::string> faults(const Stage& stage, Room room);

/// The stage with a condition for each strain that the material has: a component without one keeps its strain.
/// faults() must be empty.
Stage completed(Stage stage, Room room);

/// Whether the axial stress (axis 2) is the least behind the stage. @param before the same, before it
bool extends(const Stage& stage, bool before);

/// Whether the stage drives a shear strain or a shear stress away from zero.
bool drives_shear(const Stage& stage);

/// The value that a constraint asks for at stage time t in [0, 1]. @param start its value at the start of the stage
double target(const Constraint& constraint, int cycles, double start, double t);

}  // namespace polargrain::element
