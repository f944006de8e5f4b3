// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/discs/disc_box.hpp"

namespace polargrain::dem {

const DiscKernels& disc_kernels(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return disc_kernels_of_eight_lanes();
  if (set == InstructionSet::avx2) return disc_kernels_of_four_lanes();
#endif
  static_cast<void>(set);
  return disc_kernels_of_two_lanes();
}

}  // namespace polargrain::dem
