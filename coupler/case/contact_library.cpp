// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/contact_library.hpp"

#include <fmt/format.h>

#include <span>

#include "common/state.hpp"
#include "coupler/case/data_files.hpp"

namespace polargrain::coupler {

ContactLibraryFile read_contact_library(Section& section, const CaseFiles& files) {
  const char* const key = "contact_library";
  const std::string name = section.text_or(key, "");
  if (name.empty()) return {};
  if (!files.scripts.trusted) {
    section.fault(
        key,
        fmt::format("{}: '{}' is a program, and would run with your rights; say --trust-scripts when you "
                    "trust it, or remove the key",
                    key, name));
    return {};
  }
  const auto file = find_data_file(name, files.directory);
  if (!file) {
    section.fault(
        key, fmt::format("{}: there is no file '{}'; give the path of a library of contact laws from here, "
                         "built as docs/own_contact_law says",
                         key, name));
    return {};
  }
  const std::string content = content_of(*file);
  if (!content.starts_with("\x7f"
                           "ELF")) {
    section.fault(key, fmt::format("{}: {} is no shared library; build one as docs/own_contact_law says", key,
                                   file->string()));
    return {};
  }
  return {std::filesystem::absolute(*file).lexically_normal().string(),
          name_of(std::as_bytes(std::span(content))).text()};
}

}  // namespace polargrain::coupler
