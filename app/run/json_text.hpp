// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace polargrain::app {

/// JSON for a file, two spaces a level, with a line end. Numbers have the digits that give the same bits back; infinity
/// and NaN become null. Bytes that are not UTF-8 (names of files) become question marks in a lozenge.
inline std::string json_text(const nlohmann::ordered_json& value) {
  return value.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace polargrain::app
