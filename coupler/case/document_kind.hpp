// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "coupler/case/document.hpp"

namespace polargrain::coupler {

/// The kinds of YAML files of users.
enum class DocumentKind { problem, packing, element_test, calibration };

/// Tells a user who has named a file of another kind so, in place of every key that is missing and unknown then. Kinds
/// are known by keys that no other has; a file that is of no known kind is let through.
/// @throws InputError when `document` is of another kind and not of `expected`
void require_kind(const Entry& document, DocumentKind expected);

/// Reads the file of a user with the values set by its options (apply_setting).
/// @throws InputError as load_document, apply_setting and require_kind do
Entry load_document_of(DocumentKind kind, const std::filesystem::path& file,
                       const std::vector<std::string>& settings);

}  // namespace polargrain::coupler
