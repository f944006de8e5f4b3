// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "band/profile.hpp"

namespace polargrain::band {

/// The samples of a body, column by column: lines of a band in the plane and planes in space are searched for alike.
template <int dim>
struct SampleColumns {
  using Vector = Eigen::Matrix<double, dim, 1>;

  std::vector<Vector> positions;  ///< m
  std::vector<double> sizes;      ///< areas (m^2) or volumes (m^3) that they stand for
  std::vector<double> shears;
  Scales scales;

  /// Sets the scales from the rest. @param reason of a fault: a sample without size or strain, or all of them at one place
  /// @returns false with a fault
  bool scale(std::string& reason);
  /// Of the samples from the origin, along a normal of length one, m.
  [[nodiscard]] std::vector<double> distances_along(const Vector& normal) const;
};

/// A layer of greatest shear, of one normal. The members are those of Band and Plane.
template <int dim>
struct Layer {
  using Vector = Eigen::Matrix<double, dim, 1>;

  Vector centre, normal;
  double thickness = 0.0, peak = 0.0, background = 0.0, resolution = 0.0;
};

/// A layer, or the reason why there is no band.
template <int dim>
struct LayerSearch {
  std::optional<Layer<dim>> layer;
  std::string reason;  ///< empty when there is a layer
};

/// How far the peak of the profile along a normal stands out (Profile::prominence); minus infinity without a valid value.
double prominence_of(const Profile& profile);

/// Measures the layer of one normal from its profile.
template <int dim>
LayerSearch<dim> measure_layer(const SampleColumns<dim>& samples,
                               const Eigen::Matrix<double, dim, 1>& normal);

/// Why a layer is no band: no sample on a side of its edge, a faint peak, or one within the scatter. Empty when it is one.
/// @param distances of the samples from its middle, m @param contrast least peak over background
std::string doubt_of_band(const std::vector<double>& distances, const std::vector<double>& shears,
                          double thickness, double resolution, double peak, double background,
                          double contrast);

/// Means of a value inside and outside of a band.
struct InsideOutside {
  double inside = 0.0;
  double outside = 0.0;
};

/// Inside: within half the thickness of the middle; outside: farther from it than the thickness.
/// @param distances of the samples from the middle, m @param sizes that they stand for @param values to be averaged
/// @throws std::invalid_argument when one side is empty
InsideOutside means_beside(const std::vector<double>& distances, const std::vector<double>& sizes,
                           const std::vector<double>& values, double thickness);

/// Of the shear: inside over outside; 1 where nothing deforms.
double localisation_of(const InsideOutside& shear);

}  // namespace polargrain::band
