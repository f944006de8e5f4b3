// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "coupler/case/section.hpp"

namespace polargrain::coupler {

/// The keys that a scheme of cells has for itself, in a map of its name below the material: `adaptive: {tolerance: 1 %}`. Every
/// scheme reads the maps of all, so that one word changes the scheme and a wrong value never waits for that.
class SchemeSection {
 public:
  /// @param material with or without the map: without it every key has its default
  SchemeSection(Section& material, const std::string& scheme, Faults& faults);
  [[nodiscard]] Section& keys() { return keys_; }
  /// To be called when all keys have been asked for. Its faults are those of Section::finish(), and keys of the scheme that
  /// stand beside the map.
  void finish();

 private:
  Section& material_;
  Section keys_;
  std::string scheme_;
};

}  // namespace polargrain::coupler
