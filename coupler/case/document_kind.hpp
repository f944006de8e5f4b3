// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/document.hpp"

namespace polargrain::coupler {

/// What the YAML files of users are for.
enum class DocumentKind { problem, packing, element_test, calibration };

/// Tells a user who has named a file of another kind so, in place of every key that is missing and unknown then. Kinds
/// are known by keys that no other has; a file that is of no known kind is let through.
/// @throws InputError when `document` is of another kind and not of `expected`
void require_kind(const Entry& document, DocumentKind expected);

}  // namespace polargrain::coupler
