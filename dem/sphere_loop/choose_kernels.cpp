// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/sphere_loop/sphere_box.hpp"

namespace polargrain::dem {

const SphereKernels& sphere_kernels(InstructionSet set, bool plain) {
  if (plain) return plain_sphere_kernels();
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return sphere_kernels_of_eight_lanes();
  if (set == InstructionSet::avx2) return sphere_kernels_of_four_lanes();
#endif
  static_cast<void>(set);
  return sphere_kernels_of_two_lanes();
}

}  // namespace polargrain::dem
