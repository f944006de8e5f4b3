// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/cells/cell_calls.hpp"

#include <fmt/format.h>

#include <sstream>
#include <string>
#include <utility>

#include "common/error.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

CellCalls calls_of(Pool& pool, std::uint32_t definition) {
  return {[&pool, definition] { return in_plane(pool.initial(definition)); },
          [&pool, definition](std::span<const PlaneRequest> cells, std::span<const std::size_t> points) {
            std::vector<PoolRequest> requests;
            for (std::size_t k = 0; k < cells.size(); ++k)
              requests.push_back({definition, in_space(cells[k]), points[k]});
            std::vector<PlaneReply> replies;
            for (CellReply& reply : pool.evaluate(requests)) replies.push_back(in_plane(std::move(reply)));
            return replies;
          },
          [&pool](std::span<const StatePointer> states) { return pool.collect(states); }};
}

PlaneReply packing_at_rest(const CellCalls& calls, std::vector<std::string>& notes) {
  PlaneReply packing = calls.initial();
  if (packing.response.quality == Quality::failed)
    throw RunError(
        fmt::format("the packing of a cell cannot be brought to rest: {}", packing.response.message));
  std::istringstream remarks(std::exchange(packing.response.message, {}));
  for (std::string remark; std::getline(remarks, remark);) notes.push_back(remark);
  return packing;
}

void collect(const CellCalls& calls, std::span<StatePointer* const> states) {
  if (!calls.collect) return;
  std::vector<StatePointer> wanted;
  for (const StatePointer* const state : states) wanted.push_back(*state);
  const std::vector<StatePointer> here = calls.collect(wanted);
  for (std::size_t s = 0; s < states.size(); ++s) *states[s] = here[s];
}

}  // namespace polargrain::coupler
