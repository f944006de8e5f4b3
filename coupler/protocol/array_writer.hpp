// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <msgpack.hpp>
#include <span>
#include <string>

#include "common/state.hpp"

namespace polargrain::coupler {

/// Appends one msgpack array to a text of bytes, member by member; how many there are is written into its
/// head as they come. Parts are written into the same bytes, so that nothing is copied twice.
class ArrayWriter {
 public:
  explicit ArrayWriter(std::string& bytes) : out_{bytes}, head_(bytes.size()) {
    bytes.append({kArray16, '\0', '\0'});
  }
  ArrayWriter(const ArrayWriter&) = delete;
  ArrayWriter& operator=(const ArrayWriter&) = delete;

  ArrayWriter& whole(std::uint64_t value) {
    member().pack_uint64(value);
    return *this;
  }
  ArrayWriter& whole_signed(std::int64_t value) {
    member().pack_int64(value);
    return *this;
  }
  ArrayWriter& truth(bool value) {
    value ? member().pack_true() : member().pack_false();
    return *this;
  }
  ArrayWriter& text(const std::string& value) {
    const auto size = static_cast<std::uint32_t>(value.size());
    member().pack_str(size).pack_str_body(value.data(), size);
    return *this;
  }
  ArrayWriter& block(std::span<const std::byte> bytes) {
    const auto size = static_cast<std::uint32_t>(bytes.size());
    member().pack_bin(size).pack_bin_body(reinterpret_cast<const char*>(bytes.data()), size);
    return *this;
  }
  ArrayWriter& numbers(std::span<const double> values) { return block(std::as_bytes(values)); }
  /// Nil, its bytes, or its name and size when they are elsewhere.
  ArrayWriter& state(const StatePointer& value) {
    if (!value) {
      member().pack_nil();
    } else if (value->is_here()) {
      block(value->bytes());
    } else {
      part().name(value->name()).whole(value->size());
    }
    return *this;
  }
  ArrayWriter& name(const ContentName& value) { return whole(value.high).whole(value.low); }
  ArrayWriter& names(std::span<const ContentName> values) { return block(std::as_bytes(values)); }
  /// An array as the next member. To be finished before this one goes on.
  ArrayWriter part() {
    count();
    return ArrayWriter(out_.bytes);
  }

 private:
  static constexpr char kArray16 = '\xdc';  ///< followed by the number of members in two bytes

  struct Buffer {
    std::string& bytes;
    void write(const char* data, std::size_t size) { bytes.append(data, size); }
  };

  void count() {
    ++members_;
    out_.bytes[head_ + 1] = static_cast<char>(members_ >> 8);
    out_.bytes[head_ + 2] = static_cast<char>(members_ & 0xff);
  }
  msgpack::packer<Buffer> member() {
    count();
    return msgpack::packer<Buffer>(out_);
  }

  Buffer out_;
  std::size_t head_;  ///< where the array begins
  std::uint32_t members_ = 0;
};

}  // namespace polargrain::coupler
