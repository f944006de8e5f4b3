// SPDX-License-Identifier: GPL-2.0-or-later
// A worker around LineService: resident_worker [--key FILE] --connect URL
#include <cstdio>
#include <exception>
#include <string>

#include "coupler/pool/worker.hpp"
#include "tests/unit/resident_service.hpp"

int main(int count, char** arguments) try {
  std::string url;
  polargrain::coupler::ServeOptions options;
  for (int i = 1; i + 1 < count; i += 2) {
    if (std::string(arguments[i]) == "--connect") url = arguments[i + 1];
    if (std::string(arguments[i]) == "--key")
      options.key = polargrain::coupler::read_worker_key(arguments[i + 1]);
  }
  const auto make_service = [](const polargrain::CellDefinition& definition) {
    return std::make_unique<polargrain::testing::LineService>(definition);
  };
  polargrain::coupler::serve(url, make_service, options);
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "ERROR: %s\n", error.what());
  return 1;
}
