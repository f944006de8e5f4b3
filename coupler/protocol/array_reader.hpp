// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <cstring>
#include <msgpack.hpp>
#include <span>
#include <string>
#include <vector>

#include "common/plain_text.hpp"
#include "common/state.hpp"
#include "coupler/protocol/messages.hpp"
#include "coupler/protocol/numbers.hpp"

namespace polargrain::coupler {

/// Walks the members of one msgpack array in order. Every getter checks the type of the member it finds.
/// @throws ProtocolError (all getters) naming the member and the type expected
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
  /// A text for the user.
  std::string words() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::STR) wrong("a text");
    return plain_text({member.via.str.ptr, member.via.str.size});
  }
  std::span<const std::byte> block() {
    const msgpack::object& member = next();
    if (member.type != msgpack::type::BIN) wrong("a block of bytes");
    return std::as_bytes(std::span(member.via.bin.ptr, member.via.bin.size));
  }
  template <std::size_t count>
  std::array<double, count> numbers() {
    std::array<double, count> values;
    const std::span<const std::byte> bytes = block();
    if (bytes.size() != sizeof values) wrong(fmt::format("{} doubles", count));
    std::memcpy(values.data(), bytes.data(), sizeof values);
    return values;
  }
  template <std::size_t count>
  std::array<double, count> finite_numbers() {
    const std::array<double, count> values = numbers<count>();
    require_finite(values, what_);
    return values;
  }
  std::vector<double> all_numbers() { return numbers_of(block()); }
  std::vector<std::int64_t> all_integers() {
    const std::span<const std::byte> bytes = block();
    if (bytes.size() % sizeof(std::int64_t) != 0) wrong("a block of whole numbers");
    std::vector<std::int64_t> values(bytes.size() / sizeof(std::int64_t));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  [[nodiscard]] bool text_follows() const { return is_next(msgpack::type::STR); }
  /// A state with its bytes, or null.
  StatePointer state() {
    if (is_next(msgpack::type::NIL)) {
      ++at_;
      return nullptr;
    }
    const std::span<const std::byte> bytes = block();
    return std::make_shared<const State>(std::vector<std::byte>(bytes.begin(), bytes.end()));
  }
  /// A state with its bytes or by its name alone, or null.
  StatePointer state_or_name() {
    if (!is_next(msgpack::type::ARRAY)) return state();
    ArrayReader reader(next(), "a state");
    const ContentName name = reader.name();
    const std::uint64_t size = reader.whole();
    reader.end();
    if (size > kLongestMessage) throw ProtocolError("a state is larger than any message");
    return std::make_shared<const State>(name, static_cast<std::size_t>(size));
  }
  ContentName name() {
    ContentName value;
    value.high = whole();
    value.low = whole();
    return value;
  }
  std::vector<ContentName> names() {
    const std::span<const std::byte> bytes = block();
    if (bytes.size() % sizeof(ContentName) != 0) wrong("a list of names");
    std::vector<ContentName> values(bytes.size() / sizeof(ContentName));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
  }
  const msgpack::object& part() { return next(); }
  [[nodiscard]] bool at_end() const { return at_ == members_.size(); }
  void end() const {
    if (at_ != members_.size()) {
      throw ProtocolError(fmt::format("{} has {} members, {} expected", what_, members_.size(), at_));
    }
  }

 private:
  [[nodiscard]] bool is_next(msgpack::type::object_type type) const {
    return at_ < members_.size() && members_[at_].type == type;
  }
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
