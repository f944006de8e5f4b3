// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

namespace polargrain {

/// A file that ends with a mark and the hash (XXH3, 128 bits) of all that stands before: damage by a crash, a full
/// disk or a bad sector is known before anybody tries to read it. Libraries that read the file do
/// not mind the 32 bytes behind its end.

/// Mark and hash: they stand behind the bytes.
std::string seal_of(std::string_view bytes);

/// @throws RunError with the reason when the file has no mark at its end or does not match its hash
void check_seal(const std::filesystem::path& file);

}  // namespace polargrain
