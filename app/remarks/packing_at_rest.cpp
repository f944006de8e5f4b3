// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/packing_at_rest.hpp"

#include <vector>

#include "coupler/cells/cell_calls.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/private_directory.hpp"

namespace polargrain::app {
namespace {

PackingAtRest ask(coupler::Pool& pool, CellDefinition definition) {
  definition.control.tangent = CellTangent::cosserat;
  std::vector<std::string> notes;  // a run's own cells make them too
  const coupler::PlaneReply reply =
      coupler::packing_at_rest(coupler::calls_of<2>(pool, pool.define(std::move(definition))), notes);
  return {reply.response.stress, coupler::network_moduli(reply.response.tangent),
          reply.diagnostics.mean_overlap};
}

PackingsAtRest ask_for(const std::map<std::string, const CellDefinition*>& cells,
                       const coupler::PatienceLimits& patience, bool trust_scripts, LogsOfFailure of_failure,
                       const std::function<void()>& heed) {
  PackingsAtRest found;
  if (cells.empty()) return found;
  coupler::PrivateDirectory logs;
  if (of_failure == LogsOfFailure::kept)
    logs.keep();  // until the end is known: a dead worker's log must be there to be read
  {
    coupler::PoolOptions options;
    options.directory = logs.path();
    options.trust_scripts = trust_scripts;
    options.patience = patience;
    options.heed = heed;
    coupler::Pool pool(options);
    for (const auto& [name, cell] : cells) found[name] = ask(pool, *cell);
  }
  logs.keep(false);
  return found;
}

}  // namespace

PackingsAtRest packings_at_rest(const coupler::Case& the_case, bool trust_scripts, LogsOfFailure logs,
                                const std::function<void()>& heed) {
  std::map<std::string, const CellDefinition*> cells;
  for (const auto& [name, material] : the_case.materials)
    if (material->needs_workers()) cells[name] = material->grains();
  return ask_for(cells, the_case.patience, trust_scripts, logs, heed);
}

PackingAtRest packing_at_rest(const CellDefinition& cell, bool trust_scripts) {
  return ask_for({{cell.name, &cell}}, {}, trust_scripts, LogsOfFailure::kept, {}).at(cell.name);
}

}  // namespace polargrain::app
