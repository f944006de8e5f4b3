// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "element/material_point.hpp"
#include "element/stage.hpp"

namespace polargrain::element {

/// How exactly a test is followed.
struct Accuracy {
  double pressure = 0.0;  ///< the reference of tolerances, Pa: the confining pressure
  double tolerance =
      1e-3;  ///< of prescribed stresses, over that pressure, at every recorded row; in small changes 2 % of them
  /// The largest component of a displacement gradient of one step; a row may take several steps.
  double largest_increment = 1e-3;
  int iterations = 12;  ///< of Newton's method in a step
  int cuts = 8;         ///< a step may be halved so often
  /// How often in a test a step may end outside of the tolerance because the stress jumps there (grains that give way):
  /// the closest answer is then taken, counted, and brought back within the tolerance before a row is recorded.
  int jumps = 20;
};

/// The state of a point at the end of a row.
struct Row {
  int stage = 0;                     ///< from 0
  int number = 0;                    ///< in its stage, from 1; 0: the start of the test
  Vector6 strain = Vector6::Zero();  ///< in the order of Place, from the last zero (Constraint)
  double volume = 1.0;               ///< over that at the last zero
  double total_volume = 1.0;         ///< over that at the start of the test
  Vector6 stress = Vector6::Zero();  ///< effective, Pa; zero where the material does not tell
  double pore_pressure = 0.0;        ///< Pa, of the undrained stages up to here; 0 in a drained one
  double residual = 0.0;             ///< largest error of a prescribed stress, over the confining pressure
  int steps = 0;                     ///< that the row took
  int evaluations = 0;               ///< of the material
  int jumps = 0;                     ///< since the start of the test
  std::vector<double> fields;
};

/// The outcome of a test.
struct Outcome {
  std::vector<Row> rows;
  std::string failure;  ///< why it ended before its end, and where; empty: it did not
};

/// Leads a point through the stages of a test, with Newton's method on the components that are not given as strains, by
/// the tangent that the material tells; steps that do not converge or strain too much at once are cut, and grow again.
/// @param stages completed() for the material
/// @param on_row called with each row as soon as it is there; may be empty
Outcome follow(MaterialPoint& point, std::span<const Stage> stages, const Accuracy& accuracy,
               const std::function<void(const Row&)>& on_row = {});

}  // namespace polargrain::element
