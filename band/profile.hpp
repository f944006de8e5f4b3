// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace polargrain::band {

inline constexpr double kHalfMaximumWidth = 2.354820045;  // of a Gaussian, in standard deviations
/// Of a profile. A profile with more values has its samples in few places far from each other.
inline constexpr double kMostValues = 1e5;

/// Sizes that the search goes by.
struct Scales {
  double spacing = 0.0;  ///< mean distance of the samples
  double kernel = 0.0;   ///< standard deviation of the smoothing across
  double chord = 0.0;    ///< shortest line (m) of a valid profile value; in space smallest section, m^2
  double mean_shear = 0.0;
  double extent = 0.0;  ///< of all samples, corner to corner
};

/// Mean shear along lines (in space: planes) of one orientation, over their distance from the origin of the samples.
struct Profile {
  double first = 0.0;  ///< distance of the first value, m
  double step = 0.0;
  std::vector<double> values;
  std::vector<double>
      chords;  ///< area a width: length of the line within the body, m; in space the section, m^2
  double least_chord = 0.0;
  double mean = 0.0;  ///< of all samples

  [[nodiscard]] bool valid(std::size_t i) const { return chords[i] >= least_chord; }
  /// How far a value stands out from the mean, in units of its own scatter: a mean over a longer line
  /// scatters less.
  [[nodiscard]] double prominence(std::size_t i) const { return (values[i] - mean) * std::sqrt(chords[i]); }
  [[nodiscard]] double distance(double place) const { return first + step * place; }
};

/// @param distances of the samples, m @param sizes areas or volumes that they stand for @param shears of them
Profile profile_of(const std::vector<double>& distances, const std::vector<double>& sizes,
                   const std::vector<double>& shears, const Scales& scales);

/// The same a spacing apart, each sample shared by its two nearest values: for a search among many orientations.
Profile rough_profile_of(const std::vector<double>& distances, const std::vector<double>& sizes,
                         const std::vector<double>& shears, const Scales& scales);

/// Place of the most prominent valid value. @returns nothing when no value is valid
std::optional<std::size_t> peak_of(const Profile& profile);

/// Lowest quartile of the valid values.
double background_of(const Profile& profile);

/// Distance where the profile falls below a level, from the peak towards one side.
std::optional<double> crossing(const Profile& profile, std::size_t peak, double level, int direction);

/// Standard error of a profile value: scatter of the samples outside over the root of their number in a kernel.
/// @param distances of the samples from the middle of the band @param resolution, thickness of the band
double standard_error(const std::vector<double>& distances, const std::vector<double>& shears,
                      double thickness, double resolution);

}  // namespace polargrain::band
