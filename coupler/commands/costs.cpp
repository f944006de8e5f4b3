// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/commands/costs.hpp"

#include <algorithm>

namespace polargrain::coupler {

Costs costs_between(const PoolCounts& before, const PoolCounts& after, int workers, double total,
                    double finite_elements, double materials) {
  const double cells = after.wall_seconds - before.wall_seconds;
  const double present = after.member_seconds - before.member_seconds;
  const double members = cells > 0.0 && present > 0.0 ? present / cells : workers;  // they may come and go
  const double engine = (after.engine_seconds - before.engine_seconds) / members;
  const double busy = (after.busy_seconds - before.busy_seconds) / members;
  Costs costs;
  costs.total = total;
  costs.grains = engine;
  costs.messages = busy - engine;
  costs.waiting = cells - busy;
  costs.finite_elements = finite_elements + std::max(0.0, materials - cells);
  costs.rest = total - costs.grains - costs.messages - costs.waiting - costs.finite_elements;
  return costs;
}

Costs& operator+=(Costs& sum, const Costs& more) {
  sum.total += more.total;
  sum.grains += more.grains;
  sum.messages += more.messages;
  sum.waiting += more.waiting;
  sum.finite_elements += more.finite_elements;
  sum.rest += more.rest;
  return sum;
}

}  // namespace polargrain::coupler
