// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/keys.hpp"

#include <fmt/format.h>

namespace polargrain::coupler {

std::string row_of_key(const Key& key, const std::string& otherwise) {
  const bool has_more = *key.also != '\0';
  return fmt::format("| `{}` | {}{}{} | {} |\n", key.name, otherwise, has_more ? "; " : "", key.also,
                     key.meaning);
}

}  // namespace polargrain::coupler
