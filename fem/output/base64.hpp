// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <span>
#include <string>

namespace polargrain::fem {

/// RFC 4648, with padding.
std::string base64(std::span<const std::byte> bytes);

}  // namespace polargrain::fem
