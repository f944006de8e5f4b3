// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <vector>

#include "fem/material/stress_subspaces.hpp"

namespace polargrain::fem {

/// A quantity that depends on the accumulated plastic shear gamma_p: straight between given values, constant
/// before the first and after the last of them. One value is a constant, two are linear hardening or
/// softening with a floor, more are a table.
///
/// At a given gamma_p itself the slope is that of the piece to its right, because loading enters that piece:
/// the tangent is then the one-sided derivative for further loading. Newton's method stays safe across such
/// kinks because the return mapping keeps a bracket.
class PiecewiseLinear {
 public:
  struct Knot {
    double gamma_p = 0.0;  ///< accumulated plastic shear, dimensionless
    double value = 0.0;
  };

  /// Implicit, so that a plain number stands for a constant.
  PiecewiseLinear(double constant = 0.0) : knots_{{0.0, constant}} {}  // NOLINT(google-explicit-constructor)

  /// @param knots in strictly rising gamma_p, not empty.
  /// @throws InputError when they are not, or when a number is not finite.
  explicit PiecewiseLinear(std::vector<Knot> knots);

  /// From `start` at gamma_p = 0 to `end` at `range`, constant afterwards.
  /// @throws InputError when range is not positive.
  static PiecewiseLinear ramp(double start, double end, double range);

  [[nodiscard]] const std::vector<Knot>& knots() const { return knots_; }

  template <class Scalar>
  struct Point {
    Scalar value;
    double slope;  ///< d value / d gamma_p, right-sided at a knot
  };

  template <class Scalar>
  [[nodiscard]] Point<Scalar> at(const Scalar& gamma_p) const {
    const double position = real_part(gamma_p);
    if (position < knots_.front().gamma_p) {
      return {Scalar(knots_.front().value), 0.0};
    }
    for (std::size_t i = 1; i < knots_.size(); ++i) {
      const Knot& left = knots_[i - 1];
      const Knot& right = knots_[i];
      if (position < right.gamma_p) {
        const double slope = (right.value - left.value) / (right.gamma_p - left.gamma_p);
        return {left.value + slope * (gamma_p - left.gamma_p), slope};
      }
    }
    return {Scalar(knots_.back().value), 0.0};
  }

 private:
  std::vector<Knot> knots_;
};

/// The gamma_p of all knots of all given functions, rising, each once.
std::vector<double> merged_knots(const std::vector<const PiecewiseLinear*>& functions);

}  // namespace polargrain::fem
