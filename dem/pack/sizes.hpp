// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "common/packing_specification.hpp"
#include "dem/pack/random_numbers.hpp"

namespace polargrain::dem {

/// The radius below which the fraction u of the grains lies, by number. @param u in [0, 1]
double radius_at(const SizeLaw& law, double u);

/// Radii of discs after a law, m, in random order. One is drawn from each of `count` equal parts of the law,
/// so that few grains follow it closely already.
std::vector<double> draw_radii(const SizeLaw& law, int count, RandomNumbers& random);

}  // namespace polargrain::dem
