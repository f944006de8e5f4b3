// SPDX-License-Identifier: GPL-2.0-or-later
// One contact at a time: the plain twin of the other kernels.
#include "dem/sphere_loop/sphere_kernels.hpp"

namespace polargrain::dem {

const SphereKernels& plain_sphere_kernels() {
  static const SphereKernels kernels = kernels_of_lanes<1>();
  return kernels;
}

}  // namespace polargrain::dem
