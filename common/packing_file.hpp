// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>

#include "common/packing_specification.hpp"

namespace polargrain {

/// Writes a packing as HDF5 (docs/file_formats.md); complete or not at all. Equal packings give equal bytes.
/// @throws RunError when the file cannot be written.
void write_packing_file(const std::filesystem::path& file, const PreparedPacking& packing);

/// Reads a file of write_packing_file. A hash over the content finds damage.
/// @throws InputError naming the file when it is missing, not a packing, of an unknown version, or damaged.
PreparedPacking read_packing_file(const std::filesystem::path& file);

}  // namespace polargrain
