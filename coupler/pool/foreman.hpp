// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_set>
#include <vector>

#include "common/seconds.hpp"
#include "coupler/pool/crew.hpp"
#include "coupler/pool/pool.hpp"
#include "coupler/pool/state_book.hpp"
#include "coupler/pool/task.hpp"
#include "coupler/pool/task_queue.hpp"

namespace polargrain::coupler {

/// Has tasks done by a crew: gives every worker the next ones before it has finished with those at hand,
/// sends lost messages again, notices who hangs, and gives the tasks of the lost to others.
class Foreman final : private CrewEvents {
 public:
  explicit Foreman(PoolOptions options);

  std::uint32_t define(CellDefinition definition);
  [[nodiscard]] const CellDefinition& definition(std::uint32_t number) const;

  /// Returns when every task is done, with its reply; replies to `fetch` and `again` have a state and no more.
  /// @throws RunError when no worker is left, or nobody can do a task other than an evaluation; ResidentsLost when a
  /// worker is gone that a task is for: this alone ends nothing, the other tasks are dropped
  void work(std::vector<Task>& tasks);
  /// Waits until no process of our own is on its way. @returns the workers there are, at least one, by the numbers of
  /// their Members
  std::vector<std::uint64_t> gather();
  /// Workers there were when this was last asked for anything.
  [[nodiscard]] std::size_t present_count() const { return present_.size(); }

  StateBook& book() { return book_; }
  [[nodiscard]] const Switchboard& switchboard() const { return crew_.switchboard(); }
  [[nodiscard]] int workers() const { return options_.workers; }
  [[nodiscard]] double check_share() const { return options_.check_share; }
  void tell(const std::string& text) const;

  std::function<void(std::size_t, std::size_t)> progress;  ///< see Pool::on_progress
  PoolCounts counts;
  std::map<std::string, WorkerRecord> records;  ///< by the names of workers

 private:
  /// A worker has one job at work and one more at hand, so that it never waits for the coordinator.
  static constexpr std::size_t kJobsAtHand = 2;
  struct Definition {
    CellDefinition cell;
    double longest = 0.0;  ///< s, of the requests answered so far
    double seconds = 0.0;  ///< of all of them
    std::int64_t answers = 0;
  };

  // Messages of the crew.
  void joined(Member& member) override;
  void said(Member& member, const Message& message) override;
  void lost(Member& member, const Loss& loss) override;

  // Giving tasks to workers.
  void enqueue(std::size_t number);
  void give_all();
  void give_next(Member& member, std::size_t jobs);
  [[nodiscard]] std::size_t most_at_once(const Task& first);
  void send(Member& member, const Job& job);
  [[nodiscard]] EvaluateRequest request_for(Member& member, const Job& job);

  // Their answers.
  void take_replies(Member& member, const Reply& reply);
  void take_states(Member& member, const States& answer);
  void take_reply(Member& member, Task& task, const CellReply& reply);
  void take_other_state(Member& member, Task& task, const CellReply& reply);
  /// @throws FalseMessage when a state that was sent cannot be one of the cell
  void check_state(const Task& task, const StatePointer& state) const;
  /// Somebody has done a task: who refused it, or came to something else, was wrong.
  void blame_others(const Member& member, const Task& done);
  void send_away_the_blamed();
  void take_refusal(Member& member, const Refusal& refusal);
  void accept(const Member& member, Task& done, const CellReply& reply);
  void supply(Member& member, const Missing& missing);
  /// Takes a job off its worker, with the time it took.
  Job finished(Member& member, std::uint64_t request);
  void complete(Task& task);

  // Answers that two workers must agree on.
  void take_opinion(const Member& member, Task& task, const CellReply& reply);
  /// @returns whether enough agree
  bool decide(Task& task);
  /// Ends the tasks that wait for an opinion that nobody can give.
  void settle_what_waits();
  void settle(Task& task);
  /// One opinion is false: takes back all that its worker has answered in this call.
  void find_false(const Opinion& opinion, const std::string& words);
  /// Answers returned now rest on one worker's word: noted, should it be found to answer falsely later.
  void note_returned();

  // Messages about resident boxes.
  void take_resident_reply(Member& member, const ResidentReply& reply);
  /// @throws RunError
  [[noreturn]] void end_refused(const Member& member, const Task& refused, const Refusal& refusal) const;

  // Tasks that cannot be finished.
  void put_back(const Job& job);
  /// All that is at work comes to nothing; answers to it are late.
  void drop_jobs();
  void end_attempt(Task& task, Attempt attempt);
  [[nodiscard]] bool may_take(const Member& member, const Task& task);
  [[nodiscard]] std::vector<Candidate> present();
  void say_again(const std::string& text, std::size_t cells) const;
  [[nodiscard]] std::string place_of(const Task& task) const;
  [[nodiscard]] std::string place_of(const Job& job) const;

  // Clocks.
  static void excuse(Member& member, Clock::duration time);
  void excuse_all(Clock::duration time);
  void count_seconds(Clock::duration passed);
  void check_clocks();

  [[nodiscard]] Task& task(std::size_t number) { return (*tasks_)[number]; }
  [[nodiscard]] const Task& task(std::size_t number) const { return (*tasks_)[number]; }
  [[nodiscard]] Task& first_of(const Job& job) { return task(job.tasks.front()); }

  PoolOptions options_;
  std::chrono::milliseconds tick_;
  std::vector<Definition> definitions_;
  StateBook book_;
  std::unordered_set<std::uint64_t> present_;    ///< numbers of the workers there are
  std::map<std::uint64_t, std::string> blamed_;  ///< of them: who is to be sent away, and why
  Crew crew_;

  std::map<std::string, std::int64_t>
      returned_;                   ///< by standing: answers used that nobody else has confirmed
  std::set<std::size_t> waiting_;  ///< tasks at work that have an opinion and need another one
  // The tasks at work. Request numbers run on, so that no late answer fits a new request.
  std::vector<Task>* tasks_ = nullptr;
  TaskQueue queue_;
  std::uint64_t last_request_ = 0;
  std::size_t done_ = 0;
  std::string residents_lost_;  ///< how; empty: all of them are there
  Clock::time_point checked_;
};

}  // namespace polargrain::coupler
