// SPDX-License-Identifier: GPL-2.0-or-later
// AVX-512 with its parts F, DQ and VL.
#include "dem/sphere_loop/sphere_kernels.hpp"

namespace polargrain::dem {

const SphereKernels& sphere_kernels_of_eight_lanes() {
  static const SphereKernels kernels = kernels_of_lanes<8>();
  return kernels;
}

}  // namespace polargrain::dem
