// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/scheme_section.hpp"

#include <fmt/format.h>

namespace polargrain::coupler {
namespace {

const Entry& map_of(Section& material, const std::string& scheme) {
  static const Entry nothing = [] {
    Entry empty;
    empty.kind = Entry::Kind::map;
    return empty;
  }();
  const Entry* const map = material.find(scheme);
  return map == nullptr ? nothing : *map;
}

}  // namespace

SchemeSection::SchemeSection(Section& material, const std::string& scheme, Faults& faults)
    : material_(material),
      keys_(map_of(material, scheme), fmt::format("{}: {}", material.name(), scheme), faults),
      scheme_(scheme) {}

void SchemeSection::finish() {
  keys_.finish();
  for (const std::string& key : keys_.asked())
    if (const Entry* const entry = material_.find(key))
      material_.fault(key, fmt::format("{0}: is a key of the scheme '{1}'; write {1}: {{{0}: {2}}}", key,
                                       scheme_, entry->kind == Entry::Kind::scalar ? entry->text : "..."));
}

}  // namespace polargrain::coupler
