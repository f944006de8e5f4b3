// SPDX-License-Identifier: GPL-2.0-or-later
// Packings as users hand them over, by the bits of the first byte: text (0); HDF5 (1); HDF5 with the hash that belongs
// to it, as a forger makes it (3); a packing of the numbers that follow, all hashes right (5). Refused with an
// InputError or read.
#include <unistd.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <string_view>

#include "common/error.hpp"
#include "common/packing.hpp"
#include "common/packing_file.hpp"
#include "common/sealed_file.hpp"

namespace {

using namespace polargrain;

/// Takes values off the front of bytes; zeros behind their end.
class Bytes {
 public:
  explicit Bytes(std::string_view bytes) : left_(bytes) {}
  template <class Value>
  Value take() {
    Value value{};
    std::memcpy(&value, left_.data(), std::min(sizeof value, left_.size()));
    left_.remove_prefix(std::min(sizeof value, left_.size()));
    return value;
  }
  [[nodiscard]] std::string_view left() const { return left_; }

 private:
  std::string_view left_;
};

void write_made_up(const std::string& file, std::string_view content) {
  Bytes bytes(content);
  PreparedPacking prepared;
  Packing& packing = prepared.packing;
  packing.dimension = bytes.take<std::uint8_t>() % 2 == 0 ? 2 : 3;
  for (double& value : packing.box.reshaped()) value = bytes.take<double>();
  packing.thickness = bytes.take<double>();
  packing.lean << bytes.take<double>(), bytes.take<double>();
  prepared.reached.pressure = bytes.take<double>();
  for (int grains = bytes.take<std::uint8_t>() % 16; grains > 0; --grains) {
    Grain& grain = packing.grains.emplace_back();
    grain.id = bytes.take<std::int64_t>();
    grain.position << bytes.take<double>(), bytes.take<double>();
    for (double* value : {&grain.radius, &grain.mass, &grain.moment_of_inertia, &grain.height})
      *value = bytes.take<double>();
  }
  const auto state = std::as_bytes(std::span(bytes.left()));
  if (!state.empty())
    packing.state = std::make_shared<const State>(std::vector<std::byte>(state.begin(), state.end()));
  write_packing_file(file, prepared);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  static const std::string place = "/dev/shm/polargrain_fuzz_packing_" + std::to_string(getpid());
  const std::string file = place + (data[0] % 2 == 1 ? ".h5" : ".csv");
  std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] % 8 == 5) {
    write_made_up(file, bytes);
  } else {
    if (data[0] % 4 == 3) bytes += seal_of(bytes);
    std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
  }
  try {
    (void)read_packing(file);
  } catch (const InputError&) {  // refused, as it should be
  }
  unlink(file.c_str());
  return 0;
}
