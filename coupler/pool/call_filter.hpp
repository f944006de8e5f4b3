// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once

namespace polargrain::coupler {

/// From now on this process and its threads may start no program, trace, read or signal no other process, mount
/// nothing, make no namespaces, load nothing into the kernel; those calls fail with EPERM.
/// @param may_use_network else only sockets of the machine itself (AF_UNIX) can be made
/// @returns false with errno when the system has no such filters
bool install_call_filter(bool may_use_network);

}  // namespace polargrain::coupler
