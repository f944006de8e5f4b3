// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <string_view>

namespace polargrain::testing {

/// The kinds of file a user may hand to the program. `sealed` is a checkpoint whose hash is made right, so
/// that what lies behind that check is reached.
enum class FileKind : unsigned char {
  case_file,
  packing_csv,
  packing_hdf5,
  path,
  specification,
  checkpoint,
  sealed
};
constexpr unsigned kFileKinds = 7;

/// Reads bytes as a file of a kind. Every answer is fine but a crash, a hang, or an exception that is no
/// InputError. @returns whether the file was accepted
bool read_as(FileKind kind, std::string_view bytes);

}  // namespace polargrain::testing
