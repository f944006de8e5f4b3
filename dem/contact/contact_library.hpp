// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>

namespace polargrain {
struct ContactLibraryFile;
}

namespace polargrain::dem {

/// The description of a library of contact laws for the program that loads it; exported under kContactLibraryName.
struct ContactLibrary {
  const char* version = nullptr;  ///< of the package whose headers it was compiled with
  std::size_t contact_bytes = 0;  ///< sizeof(Contact) in those headers
  /// Makes its laws known to the engine of this process, by name. @returns why it cannot; empty when it did
  std::string (*add_models)() = nullptr;
};

inline constexpr const char* kContactLibraryName = "polargrain_contact_library";

/// Loads a library of contact laws of the user's own (docs/own_contact_law) and makes them usable in
/// `pair_style gran` and in walls, together with all other models. To be called after every creation of an
/// engine whose script is to know them. The library stays loaded for the life of the process.
/// @param file empty: nothing is to be loaded
/// @throws RunError when the file is missing, has another content than it should, is no such library, was compiled for
/// another version, or names a law as another one is named
void add_contact_library(const ContactLibraryFile& file);

}  // namespace polargrain::dem
