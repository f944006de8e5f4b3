// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>

namespace polargrain::app {

/// Works in a process of its own, because an error of the engine ends its process.
/// @param log takes all that it and its engine print, the message of an exception too; it is left there
/// @param work what it writes must be files; told where progress is to be shown: a terminal, or negative for nowhere
/// @returns whether it ended well @throws RunError when there can be no log or no process
bool run_in_child(const std::filesystem::path& log, const std::function<void(int terminal)>& work,
                  bool shows_progress);

}  // namespace polargrain::app
