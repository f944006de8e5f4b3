// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

#include "common/response.hpp"

namespace polargrain::coupler {

/// What is known of how an answer of a cell bends away from its tangent (docs/adaptivity.md, 2).
struct Curvature {
  /// In-plane norm of stress (Pa) by which linearisation was wrong over an offset of size `length`. Unknown
  /// while length is 0: nothing has been learned of this cell or of those it comes from.
  double error = 0.0;
  double length = 0.0;
  /// Unit symmetric strain that the cell was last loaded along; zero for a packing at rest.
  Eigen::Matrix2d direction = Eigen::Matrix2d::Zero();
  [[nodiscard]] bool known() const { return length > 0.0; }
  /// The error (Pa) that the curvature seen makes over an offset of some size: it grows with the power 3/2 up
  /// to the length it was seen over, and with the square beyond.
  [[nodiscard]] double over(double size) const;
};

/// What counts of an offset: the norm of its deviatoric strain and its rotation, and a third of its volume
/// change, to which a packing answers with far less curvature.
double size_of(const Eigen::Matrix2d& offset);

/// Estimates errors of linearisation for the cells of one packing.
class ErrorEstimate {
 public:
  ErrorEstimate() = default;
  /// @param elastic symmetric tangent of the packing at rest
  /// @param noise_length what runs shorter than this have shown is mostly noise, and any longer one replaces
  /// it
  ErrorEstimate(const Matrix7& elastic, double noise_length)
      : elastic_(elastic), noise_length_(noise_length) {}

  /// Estimated error (Pa) of carrying `answer` by `offset`: what the curvature makes, and half of the stress
  /// that separates the answer's tangent from the elastic one along all of the offset that does not continue
  /// the last loading. Infinite where nothing is known.
  [[nodiscard]] double of(const Response& answer, const Curvature& curvature,
                          const Eigen::Matrix2d& offset) const;

  /// What a run from `start` to `end` over `offset` has shown about both ends.
  /// @param at_start updated: the largest error seen from there
  /// @returns the curvature of the answer at the end
  Curvature learn(const Response& start, const Response& end, const Eigen::Matrix2d& offset,
                  Curvature& at_start) const;

 private:
  Matrix7 elastic_ = Matrix7::Zero();
  double noise_length_ = 0.0;
};

}  // namespace polargrain::coupler
