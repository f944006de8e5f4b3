// SPDX-License-Identifier: GPL-2.0-or-later
// Prints the bits of some of the system's elementary functions, folded into one number: another number shows
// that the environment made the system take another version of them, as on another type of processor.
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <initializer_list>

int main() {
  std::uint64_t folded = 0;
  for (int k = 1; k <= 100000; ++k) {
    const double x = 1e-4 * k;
    for (const double value : {std::sin(x), std::exp(x), std::atan2(x, 3.0), std::log(x), std::pow(x, 0.2)})
      folded = (folded ^ std::bit_cast<std::uint64_t>(value)) * 0x100000001b3;
  }
  std::printf("%016llx\n", static_cast<unsigned long long>(folded));
  return 0;
}
