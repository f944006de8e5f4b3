// SPDX-License-Identifier: GPL-2.0-or-later
// A worker around the fake engine: fake_worker [--cache BYTES] [--key FILE] [--patience SECONDS] --connect
// URL
#include <cstdio>
#include <exception>
#include <string>

#include "coupler/pool/worker.hpp"
#include "tests/integration/fake_engine.hpp"

int main(int count, char** arguments) try {
  std::string url;
  polargrain::coupler::ServeOptions options;
  for (int i = 1; i + 1 < count; i += 2) {
    if (std::string(arguments[i]) == "--connect") url = arguments[i + 1];
    if (std::string(arguments[i]) == "--cache") options.cache_bytes = std::stoul(arguments[i + 1]);
    if (std::string(arguments[i]) == "--key")
      options.key = polargrain::coupler::read_worker_key(arguments[i + 1]);
    if (std::string(arguments[i]) == "--patience") options.patience_seconds = std::stod(arguments[i + 1]);
  }
  polargrain::coupler::serve(url, polargrain::testing::make_fake_engine, options);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "ERROR: %s\n", error.what());
  return 1;
}
