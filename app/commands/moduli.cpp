// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/moduli.hpp"

#include "coupler/cells/network_moduli.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {

std::vector<std::string> moduli_of(std::span<const CellDefinition* const> cells, bool trust_scripts) {
  std::vector<std::string> lines;
  if (cells.empty()) return lines;
  coupler::PrivateDirectory logs;
  logs.keep();  // until the end is known: a dead worker's log must be there to be read
  {
    coupler::PoolOptions options;
    options.directory = logs.path();
    options.trust_scripts = trust_scripts;
    coupler::Pool pool(options);
    for (const CellDefinition* const cell : cells)
      lines.push_back("moduli of the packing at rest: " + coupler::network_moduli(pool, *cell).text());
  }
  logs.keep(false);
  return lines;
}

}  // namespace polargrain::app
