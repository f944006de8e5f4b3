// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace polargrain::coupler {

/// A worker that tried to do a task, in vain.
struct Attempt {
  enum class End {
    by_work,       ///< the engine's own end: exit, crash, hang, a false answer
    refused,       ///< it said no
    other_state,   ///< it came to another state than the one asked for
    from_outside,  ///< somebody else ended it, or its connection broke
  };
  End end = End::by_work;
  std::uint64_t worker = 0;  ///< number of its Member
  std::string party;         ///< Member::party
  std::string words = {};    ///< the message about it
};

/// A worker as the list below sees it.
struct Candidate {
  std::uint64_t worker = 0;
  std::string party;
  std::string name =
      {};  ///< Member::name: the name of a process of our own stays with the one that takes its place
};

/// The failed attempts at a task, and their verdict: that the task is at fault only when
/// workers as different as there are could not do it. One that fails at everything, or comes again under
/// another number, proves nothing.
class Attempts {
 public:
  /// How often the work itself may end until the task is taken to be at fault; and how often others may end
  /// the worker, which the memory that a task takes may also bring about.
  static constexpr int kMostByWork = 2;
  static constexpr int kMostFromOutside = 10;

  void add(Attempt attempt) { list_.push_back(std::move(attempt)); }
  [[nodiscard]] bool empty() const { return list_.empty(); }
  [[nodiscard]] const std::vector<Attempt>& list() const { return list_; }

  /// How much a worker would tell by trying: 3 it is one of our own and no process of ours has tried, 2 nobody of its party
  /// has, 1 another one of its party has, 0 it has tried itself. A failure of guests alone proves nothing while
  /// one of our own is there.
  [[nodiscard]] int news_of(const Candidate& worker) const;
  /// Whether nobody there would tell more than this one.
  [[nodiscard]] bool may_try(const Candidate& worker, const std::vector<Candidate>& present) const;
  /// Whether the task is at fault.
  [[nodiscard]] bool are_enough(const std::vector<Candidate>& present) const;

 private:
  std::vector<Attempt> list_;
};

}  // namespace polargrain::coupler
