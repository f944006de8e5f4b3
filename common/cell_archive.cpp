// SPDX-License-Identifier: GPL-2.0-or-later
#include "common/cell_archive.hpp"

#include <fmt/format.h>

#include "common/error.hpp"
#include "common/packed_values.hpp"

namespace polargrain {
namespace {
constexpr std::size_t kValues = 13;
constexpr std::size_t kCounts = 2;
}  // namespace

void write_cell_replies(ArchiveWriter& archive, const std::string& name, std::span<const CellReply> replies) {
  std::vector<StatePointer> states;
  std::vector<Response> responses;
  std::vector<double> values;
  std::vector<std::int64_t> counts;
  for (const CellReply& reply : replies) {
    const CellDiagnostics& d = reply.diagnostics;
    states.push_back(reply.state);
    responses.push_back(reply.response);
    values.insert(values.end(),
                  {d.unbalanced_force_ratio, d.unbalanced_moment_ratio, d.void_ratio, d.coordination_number,
                   d.sliding_fraction, d.multiplier, d.rolling_fraction, d.rattlers, d.mean_rotation,
                   d.rotation_spread, d.fabric[0], d.fabric[1], d.fabric[2]});
    counts.insert(counts.end(), {d.contacts, d.dem_steps});
  }
  archive.write(name + "/states", std::span<const StatePointer>(states));
  write_responses(archive, name + "/responses", responses);
  archive.write(name + "/values", std::span<const double>(values));
  archive.write(name + "/counts", std::span<const std::int64_t>(counts));
}

std::vector<CellReply> read_cell_replies(ArchiveReader& archive, const std::string& name, std::size_t count) {
  std::vector<StatePointer> states = archive.states(name + "/states");
  std::vector<Response> responses = read_responses(archive, name + "/responses", count);
  const std::vector<double> values = read_lists(archive, name + "/values", count, kValues);
  const std::vector<std::int64_t> counts = archive.integers(name + "/counts");
  if (states.size() != count || counts.size() != kCounts * count) {
    throw RunError(fmt::format("'{}' does not hold the answers of {} cells", name, count));
  }
  std::vector<CellReply> replies(count);
  for (std::size_t i = 0; i < count; ++i) {
    const double* const v = &values[kValues * i];
    replies[i].state = std::move(states[i]);
    replies[i].response = std::move(responses[i]);
    replies[i].diagnostics = {v[0],
                              v[1],
                              v[2],
                              v[3],
                              v[4],
                              v[5],
                              counts[kCounts * i],
                              counts[kCounts * i + 1],
                              0.0,
                              v[6],
                              v[7],
                              v[8],
                              v[9],
                              {v[10], v[11], v[12]}};
  }
  return replies;
}

}  // namespace polargrain
