// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cell_calls.hpp"

#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

CellCalls calls_of(Pool& pool, std::uint32_t definition) {
  return {[&pool, definition] { return pool.initial(definition); },
          [&pool, definition](std::span<const CellRequest> cells, std::span<const std::size_t> points) {
            std::vector<PoolRequest> requests;
            for (std::size_t k = 0; k < cells.size(); ++k)
              requests.push_back({definition, cells[k], points[k]});
            return pool.evaluate(requests);
          }};
}

}  // namespace polargrain::coupler
