// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "dem/laws/combination.hpp"
#include "dem/sphere_loop/sphere_list.hpp"

namespace polargrain::dem {

/// The part of the spheres of a box that never changes.
struct Spheres {
  LawCombination combination;
  std::vector<double> radii;     ///< m
  std::vector<double> masses;    ///< kg
  std::vector<double> inertias;  ///< kg m^2
  std::vector<int> types;        ///< from 0
};

/// kg m^2
constexpr double sphere_inertia(double mass, double radius) {
  return 0.4 * mass * radius * radius;
}

/// Springs of a contact that mean something, the first ones of SphereSpring.
int sphere_spring_count(const LawCombination& combination);

/// Springs of a candidate that the kernel of a combination may touch.
int springs_in_pass(const LawCombination& combination);

/// The kernel for the contacts of a combination.
SphereKernels::Pass kernel_of(const SphereKernels& kernels, const LawCombination& combination);

/// A pass over the candidates of a list; grains, forces, images, step and reach are the caller's.
SpherePass pass_over(SphereList& list, const LawCombination& combination);

/// The constants of the candidates of a list (SphereConstant).
void fill_constants(const Spheres& spheres, SphereList& list);

}  // namespace polargrain::dem
