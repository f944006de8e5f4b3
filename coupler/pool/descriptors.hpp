// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>

namespace polargrain::coupler {

/// Raises the limit of open files as far as the user may: the usual one of 1024 is meant for programs that use select.
void allow_many_descriptors();

/// A process that has no descriptor left for a connection is not told so: the library of the messages tries again, silently,
/// for ever. @param more descriptors that are needed beside those in use @param purpose of them, for the message
/// @throws RunError when the limit of open files leaves fewer
void require_descriptors(std::size_t more, const std::string& purpose);

}  // namespace polargrain::coupler
