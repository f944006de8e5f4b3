// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/sample.hpp"

#include <bit>
#include <cstring>
#include <random>

#include "common/error.hpp"

namespace polargrain::app {
namespace {

constexpr std::size_t kMost = 16;
constexpr std::size_t kIncrementValues = 7;   ///< displacement gradient by rows, micro-rotation, curvature
constexpr std::size_t kResponseValues = 56;  ///< stress, then the tangent by rows

std::vector<double> values_of(const Increment& increment) {
  const auto& h = increment.displacement_gradient;
  return {h(0, 0), h(0, 1), h(1, 0), h(1, 1), increment.micro_rotation, increment.curvature(0), increment.curvature(1)};
}

Increment increment_of(const double* v) {
  Increment increment;
  increment.displacement_gradient << v[0], v[1], v[2], v[3];
  increment.micro_rotation = v[4];
  increment.curvature << v[5], v[6];
  return increment;
}

std::vector<double> values_of(const Response& response) {
  std::vector<double> values(response.stress.begin(), response.stress.end());
  for (int row = 0; row < 7; ++row)
    for (int column = 0; column < 7; ++column) values.push_back(response.tangent(row, column));
  return values;
}

Response response_of(const double* v) {
  Response response;
  for (int row = 0; row < 7; ++row) {
    response.stress(row) = v[row];
    for (int column = 0; column < 7; ++column) response.tangent(row, column) = v[7 + 7 * row + column];
  }
  return response;
}

}  // namespace

bool SampledAnswer::same_answer(const CellReply& reply) const {
  const std::vector<double> before = values_of(response);
  const std::vector<double> now = values_of(reply.response);
  return reply.state && reply.state->name() == state &&
         std::memcmp(before.data(), now.data(), sizeof(double) * before.size()) == 0;
}

void Sample::take(std::span<const coupler::PoolRequest> requests, std::span<const CellReply> replies) {
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (!replies[k].state || replies[k].response.quality == Quality::failed) continue;
    // Reservoir sampling; a generator of its own for each answer, so that nothing has to be remembered.
    ++seen_;
    const std::uint64_t drawn = std::mt19937_64(seen_)() % seen_;
    const bool is_full = answers_.size() == kMost;
    if (is_full && drawn >= kMost) continue;
    SampledAnswer answer{requests[k], replies[k].response, replies[k].state->name()};
    is_full ? void(answers_[drawn] = std::move(answer)) : answers_.push_back(std::move(answer));
  }
}

void write_sample(const std::filesystem::path& file, const coupler::CaseIdentity& identity,
                  const std::vector<SampledAnswer>& answers) {
  std::error_code error;
  if (answers.empty() && std::filesystem::exists(file, error)) return;
  coupler::Checkpoint sample;
  sample.program = POLARGRAIN_VERSION;
  sample.identity = identity;
  MemoryArchive& archive = sample.state;
  std::vector<double> increments;
  std::vector<double> responses;
  std::vector<std::int64_t> whole;
  std::vector<StatePointer> states;
  for (const SampledAnswer& answer : answers) {
    const std::vector<double> increment = values_of(answer.request.cell.increment);
    increments.insert(increments.end(), increment.begin(), increment.end());
    const std::vector<double> response = values_of(answer.response);
    responses.insert(responses.end(), response.begin(), response.end());
    whole.insert(whole.end(), {answer.request.definition, std::bit_cast<std::int64_t>(answer.state.high),
                               std::bit_cast<std::int64_t>(answer.state.low)});
    states.push_back(answer.request.cell.state);
  }
  archive.write("increments", std::span<const double>(increments));
  archive.write("responses", std::span<const double>(responses));
  archive.write("definitions_and_names", std::span<const std::int64_t>(whole));
  archive.write("states", std::span<const StatePointer>(states));
  write_checkpoint(file, sample);
}

std::vector<SampledAnswer> answers_of(coupler::Checkpoint& sample) {
  MemoryArchive& archive = sample.state;
  const std::vector<double> increments = archive.doubles("increments");
  const std::vector<double> responses = archive.doubles("responses");
  const std::vector<std::int64_t> whole = archive.integers("definitions_and_names");
  const std::vector<StatePointer> states = archive.states("states");
  const std::size_t count = states.size();
  if (increments.size() != kIncrementValues * count || responses.size() != kResponseValues * count ||
      whole.size() != 3 * count) {
    throw RunError("its lists do not fit each other");
  }
  std::vector<SampledAnswer> answers;
  for (std::size_t k = 0; k < count; ++k) {
    SampledAnswer& answer = answers.emplace_back();
    answer.request.definition = static_cast<std::uint32_t>(whole[3 * k]);
    answer.request.cell = {states[k], increment_of(increments.data() + kIncrementValues * k)};
    answer.response = response_of(responses.data() + kResponseValues * k);
    answer.state = {std::bit_cast<std::uint64_t>(whole[3 * k + 1]), std::bit_cast<std::uint64_t>(whole[3 * k + 2])};
  }
  return answers;
}

}  // namespace polargrain::app
