// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/record.hpp"

namespace polargrain {

/// A library of contact laws of the user's own that a script needs (docs/own_contact_law). Not sent with the cells: it
/// is a program, and lies on every machine that computes.
struct ContactLibraryFile {
  std::string path;  ///< absolute, the same on every machine; empty: no library
  std::string
      content;  ///< name of the bytes that the coordinator found there (common/state.hpp); empty: whatever is there
};

template <RecordOf<ContactLibraryFile> Record, class Visit>
void describe(Record& library, Visit&& visit) {
  visit(FieldNotes{"path", "", "absolute path on every machine, or empty"}, library.path);
  visit(FieldNotes{"content", "", "name of its bytes, which is the same on every machine"}, library.content);
}

}  // namespace polargrain
