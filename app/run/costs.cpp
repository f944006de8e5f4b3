// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/costs.hpp"

#include <algorithm>
#include <array>

#include "common/error.hpp"
#include "common/packed_values.hpp"

namespace polargrain::app {

Costs costs_between(const coupler::PoolCounts& before, const coupler::PoolCounts& after, int workers,
                    double total, double finite_elements, double materials) {
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

namespace {

/// The members of the counts, so that nothing done with all of them forgets one.
constexpr std::array kWhole{&coupler::PoolCounts::evaluations,        &coupler::PoolCounts::dem_steps,
                            &coupler::PoolCounts::states_sent,        &coupler::PoolCounts::bytes_sent,
                            &coupler::PoolCounts::bytes_received,     &coupler::PoolCounts::workers_lost,
                            &coupler::PoolCounts::states_fetched,     &coupler::PoolCounts::evaluations_again,
                            &coupler::PoolCounts::evaluations_checked};
constexpr std::array kSeconds{&coupler::PoolCounts::engine_seconds, &coupler::PoolCounts::busy_seconds,
                              &coupler::PoolCounts::wall_seconds, &coupler::PoolCounts::member_seconds};
constexpr std::array kCosts{&Costs::total,   &Costs::grains,          &Costs::messages,
                            &Costs::waiting, &Costs::finite_elements, &Costs::rest};

}  // namespace

coupler::PoolCounts operator+(const coupler::PoolCounts& a, const coupler::PoolCounts& b) {
  coupler::PoolCounts sum = a;
  for (const auto member : kWhole) sum.*member += b.*member;
  for (const auto member : kSeconds) sum.*member += b.*member;
  return sum;
}

coupler::PoolCounts operator-(const coupler::PoolCounts& after, const coupler::PoolCounts& before) {
  coupler::PoolCounts difference = after;
  for (const auto member : kWhole) difference.*member -= before.*member;
  for (const auto member : kSeconds) difference.*member -= before.*member;
  return difference;
}

void save(ArchiveWriter& archive, const Costs& costs, const coupler::PoolCounts& counts) {
  std::vector<double> seconds;
  std::vector<std::int64_t> whole;
  for (const auto member : kCosts) seconds.push_back(costs.*member);
  for (const auto member : kSeconds) seconds.push_back(counts.*member);
  for (const auto member : kWhole) whole.push_back(counts.*member);
  archive.write("seconds", std::span<const double>(seconds));
  archive.write("counts", std::span<const std::int64_t>(whole));
}

void restore(ArchiveReader& archive, Costs& costs, coupler::PoolCounts& counts) {
  const std::vector<double> seconds = read_lists(archive, "seconds", 1, kCosts.size() + kSeconds.size());
  const std::vector<std::int64_t> whole = archive.integers("counts");
  // Those that were written before the last ones were counted have less.
  if (whole.size() > kWhole.size()) throw RunError("'counts' does not hold the costs of a run");
  for (std::size_t i = 0; i < kCosts.size(); ++i) costs.*kCosts[i] = seconds[i];
  for (std::size_t i = 0; i < kSeconds.size(); ++i) counts.*kSeconds[i] = seconds[kCosts.size() + i];
  for (std::size_t i = 0; i < whole.size(); ++i) counts.*kWhole[i] = whole[i];
}

}  // namespace polargrain::app
