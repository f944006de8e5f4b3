// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <functional>

namespace polargrain {

/// Does a piece of work in a process of its own first, and drops its result: libraries that read files of
/// others (HDF5, Gmsh) end by a signal on many a broken one. Work that went well there goes well here, for a process and
/// its child begin with the same memory.
/// An exception is no failure: the work will throw it here too.
/// @throws RunError when a signal ended the process, ten minutes of processor time among them
void try_in_own_process(const std::function<void()>& work);

}  // namespace polargrain
