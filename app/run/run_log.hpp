// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <spdlog/sinks/sink.h>

#include <filesystem>
#include <memory>

namespace polargrain::app {

/// The lines of run.log: time, "run", level, text. The text may hold words of users and engines: it
/// steers no terminal that shows the log, and no line of it is taken for one of the log's own, which begin with '['.
/// @param anew whether to empty the file first @throws RunError when the file cannot be written
std::shared_ptr<spdlog::sinks::sink> run_log_sink(const std::filesystem::path& file, bool anew);

}  // namespace polargrain::app
