// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::app {

/// Elastic strain under the loads of a case: with more, or less, E is most likely in another unit.
inline constexpr double kMostElasticStrain = 0.05;
inline constexpr double kLeastElasticStrain = 1e-7;
/// Of the stresses that are reached: with more the ground stays elastic.
inline constexpr double kMostCohesion = 10.0;
/// Of soils but peat: with more it is most likely in per cent.
inline constexpr double kMostVoidRatio = 5.0;

}  // namespace polargrain::app
