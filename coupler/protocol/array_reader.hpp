// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <cstdint>
#include <msgpack.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/state.hpp"
#include "coupler/protocol/messages.hpp"
#include "coupler/protocol/numbers.hpp"

namespace polargrain::coupler {

/// Walks the members of one msgpack array in order. Every getter checks the type of what it finds.
/// @throws ProtocolError (all getters) naming the member and what was expected of it
class ArrayReader {
 public:
  ArrayReader(const msgpack::object& object, const char* what) : what_(what) {
    if (object.type != msgpack::type::ARRAY) throw ProtocolError(fmt::format("{} is not an array", what));
    members_ = std::span(object.via.array.ptr, object.via.array.size);
  }

  std::uint64_t whole() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::POSITIVE_INTEGER) wrong("a whole number");
    return member.via.u64;
  }
  std::uint32_t whole32() {
    const std::uint64_t value = whole();
    if (value > UINT32_MAX) wrong("a whole number of 32 bits");
    return static_cast<std::uint32_t>(value);
  }
  std::int64_t whole_signed() {
    const msgpack::object& member = next();
    if (member.type == msgpack::type::NEGATIVE_INTEGER) return member.via.i64;
    if (member.type != msgpack::type::POSITIVE_INTEGER || member.via.u64 > INT64_MAX) wrong("a whole number");
    return static_cast<std::int64_t>(member.via.u64);
  }
  bool truth() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::BOOLEAN) wrong("true or false");
    return member.via.boolean;
  }
  std::string text() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::STR) wrong("a text");
    return {member.via.str.ptr, member.via.str.size};
  }
  std::span<const std::byte> block() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::BIN) wrong("a block of bytes");
    return std::as_bytes(std::span(member.via.bin.ptr, member.via.bin.size));
  }
  std::vector<double> numbers(std::size_t count) {
    const std::span<const std::byte> bytes = block();
    if (bytes.size() != count * sizeof(double)) wrong(fmt::format("{} doubles", count));
    return numbers_of(bytes);
  }
  std::vector<double> finite_numbers(std::size_t count) {
    std::vector<double> values = numbers(count);
    require_finite(values, what_);
    return values;
  }
  StatePointer state() {
    if (at_ < members_.size() && members_[at_].type == msgpack::type::NIL) {
      ++at_;
      return nullptr;
    }
    const std::span<const std::byte> bytes = block();
    return std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  ContentName name() {
    ContentName value;
    value.high = whole();
    value.low = whole();
    return value;
  }
  const msgpack::object& part() { return next(); }
  void end() const {
    if (at_ != members_.size()) {
      throw ProtocolError(fmt::format("{} has {} members, {} expected", what_, members_.size(), at_));
    }
  }

 private:
  const msgpack::object& next() {
    if (at_ == members_.size()) throw ProtocolError(fmt::format("{} ends after {} members", what_, at_));
    return members_[at_++];
  }
  [[noreturn]] void wrong(const std::string& expected) const {
    throw ProtocolError(fmt::format("member {} of {} is not {}", at_, what_, expected));
  }

  const char* what_;
  std::span<const msgpack::object> members_;
  std::size_t at_ = 0;
};

}  // namespace polargrain::coupler
