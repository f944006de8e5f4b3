// SPDX-License-Identifier: GPL-2.0-or-later
// Entry of libFuzzer: the first byte chooses the kind of file.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/files.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace polargrain::testing;
  if (size == 0) return 0;
  (void)read_as(static_cast<FileKind>(data[0] % kFileKinds),
                {reinterpret_cast<const char*>(data) + 1, size - 1});
  return 0;
}
