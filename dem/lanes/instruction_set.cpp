// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/lanes/instruction_set.hpp"

namespace polargrain::dem {

bool is_supported(InstructionSet set) {
#if defined(__x86_64__)
  __builtin_cpu_init();
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512dq") != 0 &&
           __builtin_cpu_supports("avx512vl") != 0;
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2") != 0;
#endif
  return set == InstructionSet::baseline;
}

InstructionSet best_instruction_set() {
  static const InstructionSet best = is_supported(InstructionSet::avx512) ? InstructionSet::avx512
                                     : is_supported(InstructionSet::avx2) ? InstructionSet::avx2
                                                                          : InstructionSet::baseline;
  return best;
}

std::string_view name_of(InstructionSet set) {
  if (set == InstructionSet::avx512) return "AVX-512";
  if (set == InstructionSet::avx2) return "AVX2";
#if defined(__x86_64__)
  return "SSE2";
#else
  return "two numbers at a time";
#endif
}

}  // namespace polargrain::dem
