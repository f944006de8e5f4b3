// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string_view>

namespace polargrain::testing {

/// The kinds of file a user may hand to the program.
enum class FileKind : unsigned char {
  case_file,
  packing_csv,
  packing_hdf5,
  path,
  specification,
  checkpoint,
  forged_packing,    ///< without the hash at its end: read_as() puts the right one there, as a forger does
  forged_checkpoint  ///< the same
};
constexpr unsigned kFileKinds = 8;

/// Reads bytes as a file of a kind. Every answer is fine but a crash, a hang, or an exception that is no
/// InputError. @returns whether the file was accepted
bool read_as(FileKind kind, std::string_view bytes);

}  // namespace polargrain::testing
