// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <vector>

namespace polargrain::coupler {

/// Doubles travel as blocks of their own bytes, little-endian. msgpack's packer would turn a double with an
/// integer value into an integer and lose the sign of -0.0, and a result must arrive with the bits it left
/// with.
/// @returns the doubles in such a block
/// @throws ProtocolError when the length is not a multiple of 8 bytes
std::vector<double> numbers_of(std::span<const std::byte> bytes);

/// @throws FalseMessage "`what` holds a number that is not finite" when a number is not finite
void require_finite(std::span<const double> numbers, const char* what);

}  // namespace polargrain::coupler
