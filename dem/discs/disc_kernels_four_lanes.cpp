// SPDX-License-Identifier: GPL-2.0-or-later
// AVX2.
#include "dem/discs/disc_kernels.hpp"

namespace polargrain::dem {

const DiscKernels& disc_kernels_of_four_lanes() {
  static const DiscKernels kernels = disc_kernels_of_lanes<4>();
  return kernels;
}

}  // namespace polargrain::dem
