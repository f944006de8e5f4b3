// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <memory>
#include <span>
#include <vector>

#include "common/cell.hpp"

namespace polargrain {

/// The motion that a resident box has besides its state: the affine motion of its grains in the step behind it, in the
/// frame of its box. A box that is moved in with it goes on as if it had never been moved.
struct ResidentMotion {
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();  ///< Hdot H^-1, 1/s
  Eigen::Vector3d spin = Eigen::Vector3d::Zero();      ///< counted from the frame, rad/s
};

/// The place where a resident box begins.
struct ResidentStart {
  StatePointer state;  ///< null: the packing at rest
  ResidentMotion motion;
};

/// The answer of a resident box at the end of a step, in the laboratory.
struct ResidentAnswer {
  Eigen::Matrix3d stress = Eigen::Matrix3d::Zero();         ///< Pa
  Eigen::Matrix3d couple_stress = Eigen::Matrix3d::Zero();  ///< N/m; zero where rotations are free
  double unbalanced_force_ratio = 0.0;                      ///< see CellDiagnostics
  double coordination_number = 0.0;                         ///< 2 contacts / grains
};

/// A resident box with everything about it, as it is when results are written.
struct ResidentReadOut {
  CellReply reply;  ///< without a tangent; its state is folded into its box
  ResidentMotion motion;
};

/// Boxes of grains of one definition that stay where they are and go on (docs/theory/explicit.md): no rest, no
/// tangent, no state between two steps. Each goes on for itself, so its bits depend on its own increments
/// alone.
class ResidentBoxes {
 public:
  virtual ~ResidentBoxes() = default;

  /// All boxes go.
  virtual void clear() = 0;
  /// Adds boxes behind those there are. @throws RunError when a state belongs to another definition
  virtual void move_in(std::span<const ResidentStart> starts) = 0;
  /// Carries each box along its increment in `dem_steps` DEM steps at an even rate; grains keep their velocities.
  /// @param increments one a box @param dem_steps at least 1
  /// @throws RunError when a box loses its volume or its grains leave it
  virtual std::vector<ResidentAnswer> go_on(int dem_steps, std::span<const CellIncrement> increments) = 0;
  /// Everything about `count` boxes from number `first` on. Folds each into its box, as a restart from the answer does: the
  /// boxes go on to the same bits as ones that are moved in with it.
  virtual std::vector<ResidentReadOut> read_out(std::size_t first, std::size_t count) = 0;
  [[nodiscard]] virtual std::size_t count() const = 0;
  /// Duration of a DEM step of the packing at rest, s; 0: these boxes know of no time.
  [[nodiscard]] virtual double time_step() const = 0;
};

}  // namespace polargrain
