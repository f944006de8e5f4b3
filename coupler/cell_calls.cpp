// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cell_calls.hpp"

#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

CellCalls calls_of(Pool& pool, std::uint32_t definition) {
  return {[&pool, definition] { return pool.initial(definition); },
          [&pool, definition](std::span<const CellRequest> cells) {
            std::vector<PoolRequest> requests;
            for (const CellRequest& cell : cells) requests.push_back({definition, cell});
            return pool.evaluate(requests);
          }};
}

}  // namespace polargrain::coupler
