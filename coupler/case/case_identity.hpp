// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "coupler/case/document.hpp"

namespace polargrain::coupler {

/// Follows the key of a script in the key of the springs of its contacts (springs_of_script).
inline constexpr const char* kSprings = ".springs of contacts";

/// The identity of a case: every value as it was written, with --set, and the content of every file
/// that a value names. Comments, the order of keys and where the files lie do not matter.
struct CaseIdentity {
  std::map<std::string, std::string> values;  ///< by key: "steps.count", "boundary.2.move.u2"; kSprings too
  std::map<std::string, std::string> files;   ///< key of the value that names the file: name of its content
};

/// @param directory where the files of the case are looked for (data_files.hpp)
CaseIdentity identity_of(const Entry& document, const std::filesystem::path& directory);

/// The files that a document is read with: those that its values name, files that a script includes, and what is measured of a
/// packing, beside it, which need not exist. @param directory as above
std::vector<std::filesystem::path> files_named_in(const Entry& document,
                                                  const std::filesystem::path& directory);

/// Names of the regions of a case, in their order.
std::vector<std::string> regions_of(const CaseIdentity& identity);

/// The differences, one line each, keys by name; empty when a run of one case may go on as the other. Values
/// that no result depends on (title, columns of the table, how often checkpoints are written) may differ.
std::vector<std::string> differences(const CaseIdentity& before, const CaseIdentity& now);

}  // namespace polargrain::coupler
