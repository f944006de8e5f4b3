// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/sample.hpp"

#include <cstring>
#include <random>

#include "common/record_archive.hpp"

namespace polargrain::app {
namespace {

constexpr std::size_t kMost = 16;
constexpr const char* kName = "answers";

/// All of a sample: a list says how long it is.
struct SampledAnswers {
  std::vector<SampledAnswer> answers;
};

template <RecordOf<SampledAnswers> Record, class Visit>
void describe(Record& sample, Visit&& visit) {
  visit(FieldNotes{"answers", "", "the answers of the sample"}, sample.answers);
}

}  // namespace

bool SampledAnswer::same_answer(const CellReply& reply) const {
  RecordValues before;
  RecordValues now;
  append(before, response, false);
  append(now, reply.response, false);
  return reply.state && reply.state->name().text() == state && before.integers == now.integers &&
         std::memcmp(before.numbers.data(), now.numbers.data(), sizeof(double) * before.numbers.size()) == 0;
}

void Sample::take(std::span<const coupler::PoolRequest> requests, std::span<const CellReply> replies) {
  for (std::size_t k = 0; k < requests.size(); ++k) {
    if (!replies[k].state || replies[k].response.quality == Quality::failed) continue;
    // Reservoir sampling; a generator of its own for each answer, so that nothing has to be remembered.
    ++seen_;
    const std::uint64_t drawn = std::mt19937_64(seen_)() % seen_;
    const bool is_full = answers_.size() == kMost;
    if (is_full && drawn >= kMost) continue;
    SampledAnswer answer{requests[k].definition, requests[k].cell, replies[k].response,
                         replies[k].state->name().text()};
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
  const SampledAnswers all{answers};
  write_records(sample.state, kName, std::span(&all, 1));
  write_checkpoint(file, sample);
}

std::vector<SampledAnswer> answers_of(coupler::Checkpoint& sample) {
  return read_records<SampledAnswers>(sample.state, kName, 1).front().answers;
}

}  // namespace polargrain::app
