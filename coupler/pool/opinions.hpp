// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "coupler/pool/attempts.hpp"
#include "coupler/pool/evidence.hpp"

namespace polargrain::coupler {

/// The answer of one worker to an evaluation that several make.
struct Opinion {
  Candidate worker;
  std::string who;       ///< Member::name
  std::string standing;  ///< Member::standing
  CellReply reply;
  ContentName numbers;  ///< name_of_answer of the reply

  /// Whether a process of our own gave it.
  [[nodiscard]] bool is_ours() const { return worker.party.empty(); }
};

/// The answers to an evaluation that is checked: it is done when two of them have the same bits. Guests may agree on a
/// false answer: against a process of our own they count when another one of our own says the same.
class Opinions {
 public:
  void add(Opinion opinion) { list_.push_back(std::move(opinion)); }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] const std::vector<Opinion>& list() const { return list_; }
  /// Forgets the answers of a worker that was found to answer falsely.
  void remove(const std::string& standing);

  /// The candidates whose answer would be a second one: a worker that has answered counts as the same when it comes again.
  [[nodiscard]] std::vector<Candidate> others(const std::vector<Candidate>& present) const;
  /// Whether this worker is the best of them to ask: a guest is checked by one of our own, one of our own by a
  /// guest, before two with one key check each other; where answers differ one of our own is asked.
  [[nodiscard]] bool may_answer(const Candidate& worker, const std::vector<Candidate>& others) const;
  /// The first answer that another one agrees with. Empty: no two agree yet.
  [[nodiscard]] std::optional<std::size_t> agreed() const;
  [[nodiscard]] bool same(std::size_t a, std::size_t b) const;

 private:
  [[nodiscard]] int news_of(const Candidate& worker) const;

  std::vector<Opinion> list_;
};

}  // namespace polargrain::coupler
