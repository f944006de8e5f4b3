// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "common/grain_view.hpp"

namespace polargrain::app {

/// Folder of a result directory where grains are written, unless told otherwise.
constexpr const char* kGrainsFolder = "grains";

/// Writes the grains of a cell as a VTK file: grains are points with a vertex each, contacts and edges of the box are
/// lines (docs/file_formats.md, grains). @throws RunError when it cannot be written
void write_grains(const std::filesystem::path& file, const GrainView& view);

/// point-12/step-00005.vtu and point-12.pvd, in the folder of the files.
std::filesystem::path grains_file(std::size_t point, int step);
std::filesystem::path grains_collection(std::size_t point);

/// Lists all files of a point that are in the folder over the time of their steps. @param history history.csv of the run
/// @throws RunError when it cannot be written, InputError when the history has no such step
void write_grains_collection(const std::filesystem::path& folder, std::size_t point,
                             const std::filesystem::path& history);

}  // namespace polargrain::app
