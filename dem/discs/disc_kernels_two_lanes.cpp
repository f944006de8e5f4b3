// SPDX-License-Identifier: GPL-2.0-or-later
// For every processor that this program is compiled for: SSE2, or NEON.
#include "dem/discs/disc_kernels.hpp"

namespace polargrain::dem {

const DiscKernels& disc_kernels_of_two_lanes() {
  static const DiscKernels kernels = disc_kernels_of_lanes<2>();
  return kernels;
}

}  // namespace polargrain::dem
