// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "common/contact_library_file.hpp"
#include "coupler/case/cell_script.hpp"

namespace polargrain::coupler {

/// The key `contact_library` of a material or a packing's specification: a library of contact laws of the user's own,
/// named as other files are. A library is a program: with a fault unless scripts are trusted (docs/trust.md), wherever it
/// lies and whoever names it. @returns the file for the workers to load; empty when the key is not given, or, with a fault,
/// when there is no such library
ContactLibraryFile read_contact_library(Section& section, const CaseFiles& files);

}  // namespace polargrain::coupler
