// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/evidence.hpp"

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "common/record_values.hpp"

namespace polargrain::coupler {

ContentName name_of_answer(const CellReply& reply) {
  RecordValues values;
  append(values, reply.response, false);
  append(values, reply.diagnostics, false);
  // One array of 64 bits a value: a name is made of bytes that lie together.
  std::vector<std::uint64_t> bits;
  for (const double number : values.numbers) bits.push_back(std::bit_cast<std::uint64_t>(number));
  for (const std::int64_t whole : values.integers) bits.push_back(std::bit_cast<std::uint64_t>(whole));
  return name_of(std::as_bytes(std::span(bits)));
}

}  // namespace polargrain::coupler
