// SPDX-License-Identifier: GPL-2.0-or-later
// A worker around the fake engine: fake_worker [--cache BYTES] --connect URL
#include <cstdio>
#include <exception>
#include <string>

#include "coupler/pool/worker.hpp"
#include "tests/integration/fake_engine.hpp"

int main(int count, char** arguments) try {
  std::string url;
  std::size_t cache = polargrain::coupler::kWorkerCacheBytes;
  for (int i = 1; i + 1 < count; i += 2) {
    if (std::string(arguments[i]) == "--connect") url = arguments[i + 1];
    if (std::string(arguments[i]) == "--cache") cache = std::stoul(arguments[i + 1]);
  }
  polargrain::coupler::serve(url, polargrain::testing::make_fake_engine, cache);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "ERROR: %s\n", error.what());
  return 1;
}
