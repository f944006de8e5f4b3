// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/document_kind.hpp"

#include <fmt/format.h>

#include <array>

namespace polargrain::coupler {
namespace {

struct Known {
  DocumentKind kind;
  const char* name;
  std::array<const char*, 2> keys;  ///< that no other kind has both
  const char* command;              ///< which reads it
};

constexpr std::array<Known, 4> kKnown{
    {{DocumentKind::problem, "a case", {"mesh", "materials"}, "polargrain run {}"},
     {DocumentKind::packing,
      "the specification of a packing",
      {"grains", "sizes"},
      "polargrain pack {} -o PACKING.h5"},
     {DocumentKind::element_test, "an element test", {"stages", "stages"}, "polargrain element {}"},
     {DocumentKind::calibration,
      "a calibration",
      {"parameters", "targets"},
      "polargrain calibrate LABORATORY.csv {}"}}};

bool is_of(const Entry& document, const Known& known) {
  return document.find(known.keys[0]) != nullptr && document.find(known.keys[1]) != nullptr;
}

}  // namespace

void require_kind(const Entry& document, DocumentKind expected) {
  const char* name = nullptr;
  for (const Known& known : kKnown) {
    if (known.kind != expected) continue;
    if (is_of(document, known)) return;
    name = known.name;
  }
  for (const Known& known : kKnown) {
    if (known.kind == expected || !is_of(document, known)) continue;
    throw InputError(
        document.fault(fmt::format("this is {}, and {} was expected; it is for {}", known.name, name,
                                   fmt::format(fmt::runtime(known.command), document.file))));
  }
}

Entry load_document_of(DocumentKind kind, const std::filesystem::path& file,
                       const std::vector<std::string>& settings) {
  Entry document = load_document(file);
  for (const std::string& setting : settings) apply_setting(document, setting);
  require_kind(document, kind);
  return document;
}

}  // namespace polargrain::coupler
