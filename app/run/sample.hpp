// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "coupler/checkpoint/checkpoint.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::app {

/// A request to a cell and its answer, in bits.
struct SampledAnswer {
  std::int64_t definition = 0;  ///< number of the cell's definition in the pool
  CellRequest asked;            ///< its state with bytes; null: from the packing
  CellResponse response;
  std::string state;  ///< name of the state that was answered, 32 hexadecimal digits

  [[nodiscard]] bool same_answer(const CellReply& reply) const;
};

template <RecordOf<SampledAnswer> Record, class Visit>
void describe(Record& answer, Visit&& visit) {
  visit(FieldNotes{"definition", "", "number of the material whose cell was asked"}, answer.definition);
  visit(FieldNotes{"start", "", "the state it was asked from; none: the packing"}, answer.asked.state);
  visit(FieldNotes{"increment", "", "what it was asked"}, answer.asked.increment);
  visit(FieldNotes{"response", "", "what it answered"}, answer.response);
  visit(FieldNotes{"state", "", "name of the state that was answered"}, answer.state);
}

/// Some of all answers of a run, so that anybody can ask again (polargrain verify): sixteen, each of all with the same
/// chance. Which ones depends on their order alone, not on workers or time.
class Sample {
 public:
  void take(std::span<const coupler::PoolRequest> requests, std::span<const CellReply> replies);
  [[nodiscard]] const std::vector<SampledAnswer>& answers() const { return answers_; }

 private:
  std::uint64_t seen_ = 0;
  std::vector<SampledAnswer> answers_;
};

/// Writes a sample in the form of a checkpoint (docs/file_formats.md). An empty one leaves the file that is there: a run
/// that is resumed when it was done asks no cell. @throws RunError
void write_sample(const std::filesystem::path& file, const coupler::CaseIdentity& identity,
                  const std::vector<SampledAnswer>& answers);

/// @param sample as read by read_checkpoint @throws RunError when it holds no sample
std::vector<SampledAnswer> answers_of(coupler::Checkpoint& sample);

}  // namespace polargrain::app
