// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>

namespace polargrain::dem {

/// Grains of a fast loop are so far away, or nowhere, that no box can be told. @throws RunError
[[noreturn]] void lose_grains();

/// Which copy of the box a place lies in along a base vector. @param boxes its share in that vector
/// @throws RunError when it is so large, or no number, that this cannot be told
std::int32_t copy_of(double boxes);

}  // namespace polargrain::dem
