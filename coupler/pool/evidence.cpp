// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/pool/evidence.hpp"

#include <span>
#include <vector>

namespace polargrain::coupler {

ContentName name_of_answer(const CellReply& reply) {
  const Response& response = reply.response;
  const CellDiagnostics& d = reply.diagnostics;
  std::vector<double> numbers(response.stress.begin(), response.stress.end());
  numbers.insert(numbers.end(), response.tangent.data(), response.tangent.data() + response.tangent.size());
  // The seconds are left out: they are no result.
  numbers.insert(numbers.end(),
                 {static_cast<double>(response.quality), response.step_factor, d.unbalanced_force_ratio,
                  d.unbalanced_moment_ratio, d.void_ratio, d.coordination_number, d.sliding_fraction,
                  d.multiplier, static_cast<double>(d.contacts), static_cast<double>(d.dem_steps),
                  d.rolling_fraction, d.rattlers, d.mean_rotation, d.rotation_spread, d.fabric[0],
                  d.fabric[1], d.fabric[2]});
  return name_of(std::as_bytes(std::span(numbers)));
}

}  // namespace polargrain::coupler
