// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// An element may be so many internal lengths wide where a band is to be resolved (docs/settings.md).
inline constexpr double kMostElementOverLength = 2.5;
inline constexpr double kMostLengthOverBody = 0.25;
/// An element may be half as wide as slips are spread (tests/verification/spread_band_test.cpp).
inline constexpr double kMostElementOverSpread = 0.5;
/// Boundaries are mirrors: in a body of less than two spreads a band and its images overlap.
inline constexpr double kMostSpreadOverBody = 0.5;
inline constexpr double kMostPlasticOverLength = 10.0;
/// Of the mean diameter of grains.
inline constexpr double kLeastLengthOverGrain = 0.05;
inline constexpr double kMostLengthOverGrain = 50.0;

/// Square root of the area of an element of a region, m: the median, so that a mesh which is fine where most of its elements are
/// counts as fine.
double usual_element(const Scene& scene, const SceneRegion& region);

/// From the lowest to the highest node of elements, along the last axis, m.
template <int dim>
double height_of(const fem::Mesh<dim>& mesh, const std::vector<int>& elements);

/// The sides of the body, m; of half a cylinder, or a quarter, those of the whole.
std::vector<double> whole_sides(const Scene& scene);
double smaller_whole_side(const Scene& scene);

/// Whether a material has a strength, so that bands may form in it.
bool is_strong(const Scene& scene, const SceneRegion& region);

/// Whether the strength of a region falls behind a peak: of grains, and of laws whose tables fall.
bool softens(const Scene& scene, const SceneRegion& region);

}  // namespace polargrain::app
