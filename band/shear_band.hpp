// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "band/layer_in_samples.hpp"
#include "band/sample.hpp"

namespace polargrain::band {

/// The straight band of greatest shear in an increment.
struct Band {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< a point of the middle line, m
  double inclination = 0.0;  ///< of the middle line against the x axis, rad, in (-pi/2, pi/2]
  double thickness = 0.0;    ///< full width at half maximum of the profile above the background, m
  double peak = 0.0;  ///< greatest value of the profile: mean shear strain along lines parallel to the band
  double background = 0.0;  ///< lowest quartile of the profile
  /// Width (at half maximum) of the kernel that the profile is smoothed with, m: `thickness` contains it, and
  /// a band whose thickness is near it is not resolved.
  double resolution = 0.0;

  [[nodiscard]] double distance(const Eigen::Vector2d& position) const;  ///< signed, from the middle line, m
};

struct BandOptions {
  /// A profile whose peak is less than this many times its background is no band.
  double contrast = 2.0;
};

/// A band, or the reason why there is no band.
struct BandSearch {
  std::optional<Band> band;
  std::string reason;  ///< empty when there is a band
};

/// Looks for the band. Profiles (mean shear along parallel lines, over their distance) are taken for all
/// inclinations in steps of a degree; the one whose peak stands out most is where the search starts. The
/// inclination then is that of the Gaussian band fitted to the shear of all samples by least squares; the
/// thickness is read from the profile at that inclination.
/// There is no band when peak / background is less than the contrast; when the peak is within five standard
/// errors of the background (scatter of the samples); when the profile does not fall below half its maximum
/// on both sides.
/// @param samples at least 20, else there is no band. Equal samples in another order give the same band to
/// round-off.
BandSearch find_band(const Samples& samples, const BandOptions& options = {});

/// Mean shear inside the band (within half its thickness of the middle line) over the mean outside (farther
/// than its thickness). 1 in homogeneous deformation, and where nothing deforms. @throws
/// std::invalid_argument when one side is empty
double localisation(const Samples& samples, const Band& band);

/// Means of a value inside and outside of a band, as localisation() takes them.
InsideOutside means(const Samples& samples, const Band& band, double Sample::*value);

/// The strain where a band begins: where the localisation of the increments rises above `threshold` for the
/// last time and stays above it; linear between increments.
/// @param strains axial strain in the middle of each increment, ascending
/// @param localisations of the same increments, for the band they end in
/// @returns nothing when the last increment is not localised
std::optional<double> onset_strain(const std::vector<double>& strains,
                                   const std::vector<double>& localisations, double threshold = 2.0);

}  // namespace polargrain::band
