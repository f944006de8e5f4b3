// SPDX-License-Identifier: GPL-2.0-or-later
// Runs a fuzz target without a fuzzer:   TARGET CORPUS MUTATIONS
// First all inputs of the corpus (one file: corpus.py), then so many mutations of them, the same ones every time. For
// continuous integration; tests/fuzz/fuzz.sh searches for new inputs with coverage.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

void run(const std::string& input) {
  LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(input.data()), input.size());
}

/// The inputs of a corpus: of each its size in four bytes, the lowest first, and its bytes.
std::vector<std::string> unpacked(const std::string& packed) {
  std::vector<std::string> inputs;
  for (std::size_t place = 0; place + 4 <= packed.size();) {
    std::size_t size = 0;
    for (std::size_t byte = 0; byte < 4; ++byte)
      size |= static_cast<std::size_t>(static_cast<unsigned char>(packed[place + byte])) << (8 * byte);
    inputs.push_back(packed.substr(place + 4, size));
    place += 4 + size;
  }
  return inputs;
}

/// One to four changes: a bit, a byte, a cut, a doubled or removed stretch, a stretch of another input.
std::string mutated(std::string input, const std::string& other, std::mt19937_64& generator) {
  const auto below = [&](std::size_t limit) {
    return static_cast<std::size_t>(generator() % std::max<std::size_t>(limit, 1));
  };
  for (std::size_t change = 1 + below(4); change > 0; --change) {
    const std::size_t at = below(input.size());
    const std::size_t length = std::min(below(16) + 1, input.size() - at);
    switch (input.empty() ? 5 : below(6)) {
      case 0:
        input[at] = static_cast<char>(input[at] ^ (1 << below(8)));
        break;
      case 1:
        input[at] = static_cast<char>(generator());
        break;
      case 2:
        input.resize(at);
        break;
      case 3:
        input.insert(at, input.substr(at, length));
        break;
      case 4:
        input.erase(at, length);
        break;
      default:
        input.insert(at, other.substr(below(other.size()), length + 1));
    }
  }
  return input;
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 3) return 2;
  std::ifstream in(arguments[1], std::ios::binary);
  const std::string packed{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  const std::vector<std::string> corpus = unpacked(packed);
  if (corpus.empty()) return 3;
  for (const std::string& input : corpus) run(input);
  std::mt19937_64 generator(20250104);
  const long mutations = std::stol(arguments[2]);
  for (long k = 0; k < mutations; ++k) {
    const std::string& input = corpus[generator() % corpus.size()];
    run(mutated(input, corpus[generator() % corpus.size()], generator));
  }
  std::printf("[figure] %zu inputs of the corpus and %ld mutations: no crash\n", corpus.size(), mutations);
  return 0;
}
