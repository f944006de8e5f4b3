// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/state.hpp"

#include <fmt/format.h>
#include <xxhash.h>

namespace polargrain {

std::string ContentName::text() const {
  return fmt::format("{:016x}{:016x}", high, low);
}

ContentName name_of(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

}  // namespace polargrain
