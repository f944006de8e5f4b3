// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/request_sharing.hpp"

#include <array>
#include <bit>
#include <unordered_map>

namespace polargrain::coupler {
namespace {

/// All that an answer depends on.
using Key = std::array<std::uint64_t, 25>;

struct KeyHash {
  std::size_t operator()(const Key& key) const {
    std::uint64_t hash = 0;
    for (const std::uint64_t word : key) hash = (hash ^ (hash >> 32) ^ word) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 32);
  }
};

Key key_of(const PoolRequest& request) {
  const ContentName name = request.cell.state ? request.cell.state->name() : ContentName{};
  const CellIncrement& increment = request.cell.increment;
  Key key{request.definition, request.cell.state ? 1u : 0u, name.high, name.low};
  std::size_t place = 4;
  for (const double value : increment.displacement_gradient.reshaped())
    key[place++] = std::bit_cast<std::uint64_t>(value);
  for (const double value : increment.rotation) key[place++] = std::bit_cast<std::uint64_t>(value);
  for (const double value : increment.curvature.reshaped())
    key[place++] = std::bit_cast<std::uint64_t>(value);
  return key;
}

}  // namespace

std::vector<std::size_t> first_alike(std::span<const PoolRequest> requests) {
  std::unordered_map<Key, std::size_t, KeyHash> seen;
  seen.reserve(requests.size());
  std::vector<std::size_t> first;
  first.reserve(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r)
    first.push_back(seen.emplace(key_of(requests[r]), r).first->second);
  return first;
}

}  // namespace polargrain::coupler
