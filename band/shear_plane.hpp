// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "band/shear_band.hpp"

namespace polargrain::band {

/// The change at one place of a body in space in an increment.
struct SpaceSample {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< m
  double volume = 0.0;                                 ///< that the place stands for, m^3, > 0
  double shear = 0.0;  ///< difference of the largest and the smallest principal strain of the increment, >= 0
  double volume_strain = 0.0;                          ///< of the increment, dilation positive
  Eigen::Vector3d rotation = Eigen::Vector3d::Zero();  ///< micro-rotation in the increment, rad
};

using SpaceSamples = std::vector<SpaceSample>;

/// Difference of the extreme principal strains. @param gradient hij = d u_i / d x_j
double shear_strain(const Eigen::Matrix3d& gradient);

/// The plane band of greatest shear in an increment.
struct Plane {
  Eigen::Vector3d centre = Eigen::Vector3d::Zero();   ///< a point of the middle plane, m
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  ///< of length one, upward
  double thickness = 0.0;  ///< full width at half maximum of the profile above the background, m
  double peak = 0.0;  ///< greatest value of the profile: mean shear strain along planes parallel to the band
  double background = 0.0;  ///< lowest quartile of the profile
  double resolution = 0.0;  ///< as Band::resolution

  [[nodiscard]] double distance(const Eigen::Vector3d& position) const {
    return normal.dot(position - centre);
  }
  /// Angle of the plane with the horizontal one, rad, in [0, pi/2].
  [[nodiscard]] double dip() const;
  /// Direction in which the plane goes down, about x3 from x1 towards x2, rad, in (-pi, pi]; 0 where it is horizontal.
  [[nodiscard]] double dip_direction() const;
};

/// A plane, or the reason why there is no band.
struct PlaneSearch {
  std::optional<Plane> plane;
  std::string reason;  ///< empty when there is a plane
};

/// Looks for the band as find_band does in the plane: profiles for normals all over the half sphere, some six degrees apart,
/// then a Gaussian band fitted to the shear of all samples by least squares. A missing plane has the same reasons.
/// @param samples at least 50, else there is no band
PlaneSearch find_plane(const SpaceSamples& samples, const BandOptions& options = {});

/// As localisation() and means() of a band in the plane. @throws std::invalid_argument when one side is empty
double localisation(const SpaceSamples& samples, const Plane& plane);
InsideOutside means(const SpaceSamples& samples, const Plane& plane, double SpaceSample::*value);

}  // namespace polargrain::band
