// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <vector>

#include "dem/discs/combination.hpp"
#include "dem/sphere_loop/sphere_list.hpp"

namespace polargrain::dem {

/// The part of the spheres of a box that never changes.
struct Spheres {
  DiscCombination combination;
  std::vector<double> radii;   ///< m
  std::vector<double> masses;  ///< kg
  std::vector<int> types;      ///< from 0
};

/// Of a sphere, over m r^2.
inline constexpr double kSphereInertia = 0.4;

/// Whether the law of a combination is one of the bare kernels: no dashpots, no limit of normal forces, no rolling
/// friction force.
bool is_bare(const DiscCombination& combination);

/// Springs of a contact that mean something, the first ones of SphereSpring.
int sphere_spring_count(const DiscCombination& combination);

/// Springs of a candidate that the kernel of a combination may touch.
int springs_in_pass(const DiscCombination& combination);

/// The kernel for the contacts of a combination.
SphereKernels::Pass kernel_of(const SphereKernels& kernels, const DiscCombination& combination);

/// A pass over the candidates of a list; grains, forces, images, step and reach are the caller's.
SpherePass pass_over(SphereList& list, const DiscCombination& combination);

/// The constants of the candidates of a list (SphereConstant).
void fill_constants(const Spheres& spheres, SphereList& list);

}  // namespace polargrain::dem
