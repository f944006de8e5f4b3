// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/hosts/mgis/packed_state.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "common/error.hpp"

namespace polargrain::coupler::mgis {
namespace {

constexpr std::size_t kHead = 2;  ///< number of bytes; the end of their name
constexpr std::size_t kBytes = 6;
constexpr std::uint64_t kLimit = std::uint64_t{1} << 48U;

double mark_of(const State& state) {
  return static_cast<double>(state.name().low % kLimit);
}

[[noreturn]] void throw_changed() {
  throw RunError(
      "the internal variables of a point are not a state of a cell: they must reach the behaviour as it left them, "
      "neither interpolated nor averaged");
}

}  // namespace

std::size_t doubles_for(std::size_t bytes) {
  return kHead + (bytes + kBytes - 1) / kBytes;
}

void pack_state(const State& state, std::span<double> values) {
  const std::span<const std::byte> bytes = state.bytes();
  if (doubles_for(bytes.size()) > values.size())
    throw RunError(
        fmt::format("the state of the cell has {} bytes, for which the host has no room; set state_bytes "
                    "to more than that in the file of the cell",
                    bytes.size()));
  std::ranges::fill(values, 0.0);
  values[0] = static_cast<double>(bytes.size());
  values[1] = mark_of(state);
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBytes) {
    std::uint64_t number = 0;
    for (std::size_t k = std::min(begin + kBytes, bytes.size()); k > begin; --k)
      number = number << 8U | std::to_integer<std::uint64_t>(bytes[k - 1]);
    values[kHead + begin / kBytes] = static_cast<double>(number);
  }
}

StatePointer unpack_state(std::span<const double> values) {
  if (values[0] == 0.0) return nullptr;
  if (!(values[0] > 0.0 && values[0] <= static_cast<double>((values.size() - kHead) * kBytes)))
    throw_changed();
  std::vector<std::byte> bytes(static_cast<std::size_t>(values[0]));
  for (std::size_t begin = 0; begin < bytes.size(); begin += kBytes) {
    const double value = values[kHead + begin / kBytes];
    if (!(value >= 0.0 && value < static_cast<double>(kLimit))) throw_changed();
    auto number = static_cast<std::uint64_t>(value);
    for (std::size_t k = begin; k < std::min(begin + kBytes, bytes.size()); ++k, number >>= 8U)
      bytes[k] = static_cast<std::byte>(number & 0xffU);
  }
  auto state = std::make_shared<const State>(std::move(bytes));
  if (mark_of(*state) != values[1]) throw_changed();
  return state;
}

}  // namespace polargrain::coupler::mgis
