// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/state.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <utility>

#include "common/error.hpp"

namespace polargrain {

std::string ContentName::text() const {
  return fmt::format("{:016x}{:016x}", high, low);
}

ContentName name_of(std::span<const std::byte> bytes) {
  const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
  return {hash.high64, hash.low64};
}

State::State(std::vector<std::byte> bytes)
    : bytes_(std::move(bytes)), size_(bytes_.size()), name_(name_of(bytes_)) {}

std::span<const std::byte> State::bytes() const {
  if (!is_here_) throw RunError("the bytes of a state are asked for before they were collected");
  return bytes_;
}

}  // namespace polargrain
