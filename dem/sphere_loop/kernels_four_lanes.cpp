// SPDX-License-Identifier: GPL-2.0-or-later
// AVX2.
#include "dem/sphere_loop/sphere_kernels.hpp"

namespace polargrain::dem {

const SphereKernels& sphere_kernels_of_four_lanes() {
  static const SphereKernels kernels = kernels_of_lanes<4>();
  return kernels;
}

}  // namespace polargrain::dem
