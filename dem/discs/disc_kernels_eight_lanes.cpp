// SPDX-License-Identifier: GPL-2.0-or-later
// AVX-512 with its parts F, DQ and VL.
#include "dem/discs/disc_kernels.hpp"

namespace polargrain::dem {

const DiscKernels& disc_kernels_of_eight_lanes() {
  static const DiscKernels kernels = disc_kernels_of_lanes<8>();
  return kernels;
}

}  // namespace polargrain::dem
