// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <msgpack.hpp>
#include <span>
#include <string>

#include "common/state.hpp"

namespace polargrain::coupler {

/// Collects members and finishes them as one msgpack array.
class ArrayWriter {
 public:
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
  ArrayWriter& state(const StatePointer& value) {
    if (value) return block(value->bytes());
    member().pack_nil();
    return *this;
  }
  ArrayWriter& name(const ContentName& value) { return whole(value.high).whole(value.low); }
  ArrayWriter& part(const ArrayWriter& other) {
    ++members_;
    buffer_.bytes += other.finish();
    return *this;
  }

  [[nodiscard]] std::string finish() const {
    Buffer array;
    msgpack::packer<Buffer>(array).pack_array(members_);
    return array.bytes + buffer_.bytes;
  }

 private:
  struct Buffer {
    std::string bytes;
    void write(const char* data, std::size_t size) { bytes.append(data, size); }
  };

  msgpack::packer<Buffer> member() {
    ++members_;
    return msgpack::packer<Buffer>(buffer_);
  }

  Buffer buffer_;
  std::uint32_t members_ = 0;
};

}  // namespace polargrain::coupler
