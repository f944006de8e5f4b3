// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>

namespace polargrain::app {

/// The band in a sheared layer, by one ruler for layers of grains and columns of elements: a straight line and a tanh,
///
///     u(y) = u0 + s y + a tanh((y - place) / length)
///
/// least squares over all places that moved; nothing is smoothed before. The shear rate of the tanh has its full width at
/// half maximum over 2 acosh(sqrt 2) lengths.
struct Band {
  double thickness = 0.0;  ///< full width at half maximum of the shear rate, m
  double place = 0.0;      ///< height of its middle, m
  double share = 0.0;      ///< of the variance of the displacements that the fit explains
};

/// @param heights m, at least five, not all equal @param displacements along the layer, m
/// @throws RunError where there is nothing to fit
Band band_of(const Eigen::VectorXd& heights, const Eigen::VectorXd& displacements);

/// The mean rotation in that band: of the places within half a thickness from its middle. NaN where there is no place.
double rotation_in(const Band& band, const Eigen::VectorXd& heights, const Eigen::VectorXd& rotations);

}  // namespace polargrain::app
