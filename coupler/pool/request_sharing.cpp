// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/request_sharing.hpp"

#include <array>
#include <bit>
#include <map>

namespace polargrain::coupler {
namespace {

/// All that an answer depends on, in an order that maps can use.
using Key = std::array<std::uint64_t, 11>;

Key key_of(const PoolRequest& request) {
  const ContentName name = request.cell.state ? request.cell.state->name() : ContentName{};
  const Increment& increment = request.cell.increment;
  Key key{request.definition, request.cell.state ? 1u : 0u, name.high, name.low};
  std::size_t place = 4;
  for (int entry = 0; entry < 4; ++entry) {
    key[place++] = std::bit_cast<std::uint64_t>(increment.displacement_gradient.data()[entry]);
  }
  key[place++] = std::bit_cast<std::uint64_t>(increment.micro_rotation);
  key[place++] = std::bit_cast<std::uint64_t>(increment.curvature(0));
  key[place++] = std::bit_cast<std::uint64_t>(increment.curvature(1));
  return key;
}

}  // namespace

std::vector<std::size_t> first_alike(std::span<const PoolRequest> requests) {
  std::map<Key, std::size_t> seen;
  std::vector<std::size_t> first;
  first.reserve(requests.size());
  for (std::size_t r = 0; r < requests.size(); ++r)
    first.push_back(seen.emplace(key_of(requests[r]), r).first->second);
  return first;
}

}  // namespace polargrain::coupler
