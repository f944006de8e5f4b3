// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string_view>

namespace polargrain::dem {

/// The instruction sets that kernels are compiled for: the set of every processor (SSE2), AVX2, and AVX-512 with F, DQ and VL.
enum class InstructionSet { baseline, avx2, avx512 };

/// Whether this processor can run kernels of that instruction set.
bool is_supported(InstructionSet set);

/// The best one supported.
InstructionSet best_instruction_set();

/// As users know it: "AVX-512".
std::string_view name_of(InstructionSet set);

}  // namespace polargrain::dem
