// SPDX-License-Identifier: GPL-2.0-or-later
// Packings as users hand them over: text, or HDF5 when the first byte is odd. Refused with an InputError or
// read.
#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <string>

#include "common/error.hpp"
#include "common/packing.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polargrain;
  if (size == 0) return 0;
  static const std::string place = "/dev/shm/polargrain_fuzz_packing_" + std::to_string(getpid());
  const std::string file = place + (data[0] % 2 == 1 ? ".h5" : ".csv");
  std::ofstream(file, std::ios::binary | std::ios::trunc)
      .write(reinterpret_cast<const char*>(data) + 1, static_cast<std::streamsize>(size - 1));
  try {
    (void)read_packing(file);
  } catch (const InputError&) {  // refused, as it should be
  }
  unlink(file.c_str());
  return 0;
}
