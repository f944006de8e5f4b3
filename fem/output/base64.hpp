// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace polargrain::fem {

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);
/// The bytes of such a text; other characters are skipped.
std::vector<std::byte> from_base64(std::string_view text);

}  // namespace polargrain::fem
