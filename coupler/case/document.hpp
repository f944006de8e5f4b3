// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/error.hpp"

namespace polargrain::coupler {

/// One value of a YAML file as it was written, with the place it stands at. Scalars stay text until somebody
/// who knows their type reads them; duplicate keys are all there, so that they can be reported.
struct Entry {
  enum class Kind { nothing, scalar, sequence, map };

  struct Member;

  Kind kind = Kind::nothing;
  std::string text;             ///< of a scalar
  std::vector<Entry> items;     ///< of a sequence
  std::vector<Member> members;  ///< of a map, in the order of the file
  std::string file;             ///< the user's file, or the option that set the value
  int line = 0;                 ///< first line is 1; 0 for options

  /// The last member of that name; null when there is no such member.
  [[nodiscard]] const Entry* find(const std::string& key) const;
  [[nodiscard]] Fault fault(std::string message) const { return {file, line, std::move(message)}; }
};

struct Entry::Member {
  std::string key;
  int line = 0;
  Entry value;
};

/// Reads a YAML file of one document.
/// @throws InputError when it cannot be read, is no YAML, or is larger than any case should be.
Entry load_document(const std::filesystem::path& file);

/// Puts `setting`, "steps.count=10" or "boundary.1.pressure=50 kPa", into a document: keys and numbers of
/// sequence items (from 0) down to the value, which is YAML itself. Missing maps on the way are made.
/// @throws InputError when it has no '=', the way leads through something that is no map or sequence, or a number has lost its unit.
void apply_setting(Entry& document, const std::string& setting);

}  // namespace polargrain::coupler
