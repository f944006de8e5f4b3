// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <random>
#include <vector>

#include "common/plane_in_space.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::testing {

/// Requests for the first definition with random increments up to 1e-3, the same in every call.
/// @param from replies whose states they go on from; none: from the packing
inline std::vector<coupler::PoolRequest> random_requests(std::size_t count,
                                                         const std::vector<CellReply>& from = {}) {
  std::mt19937_64 generator(20240917);
  std::uniform_real_distribution<double> entry(-1e-3, 1e-3);
  std::vector<coupler::PoolRequest> requests(count);
  for (std::size_t r = 0; r < count; ++r) {
    Increment<2> increment;
    for (double& value : increment.displacement_gradient.reshaped()) value = entry(generator);
    requests[r].cell.increment = in_space(increment);
    if (!from.empty()) requests[r].cell.state = from[r].state;
    requests[r].point = r;
  }
  return requests;
}

/// A step of such cells: an evaluation from the states of the last, and its commit.
inline std::vector<CellReply> step(coupler::Pool& pool, std::size_t count,
                                   const std::vector<CellReply>& from) {
  std::vector<CellReply> replies = pool.evaluate(random_requests(count, from));
  std::vector<StatePointer> states;
  for (const CellReply& reply : replies) states.push_back(reply.state);
  states = pool.collect(states);
  for (std::size_t r = 0; r < replies.size(); ++r) replies[r].state = states[r];
  return replies;
}

}  // namespace polargrain::testing
