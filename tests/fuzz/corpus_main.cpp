// SPDX-License-Identifier: GPL-2.0-or-later
// Runs a fuzz target without a fuzzer:   TARGET CORPUS MUTATIONS
// First all files of the corpus, then so many mutations of them, the same ones every time. For continuous
// integration; tests/fuzz/fuzz.sh searches for new inputs with coverage.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <filesystem>
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
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(arguments[1])) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::vector<std::string> corpus;
  for (const auto& file : files) {
    std::ifstream in(file, std::ios::binary);
    corpus.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    run(corpus.back());
  }
  if (corpus.empty()) return 3;
  std::mt19937_64 generator(20250104);
  const long mutations = std::stol(arguments[2]);
  for (long k = 0; k < mutations; ++k) {
    const std::string& input = corpus[generator() % corpus.size()];
    run(mutated(input, corpus[generator() % corpus.size()], generator));
  }
  std::printf("[figure] %zu files of the corpus and %ld mutations: no crash\n", corpus.size(), mutations);
  return 0;
}
