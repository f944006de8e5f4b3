// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "common/state_check.hpp"
#include "coupler/pool/listening.hpp"
#include "coupler/pool/patience.hpp"
#include "coupler/pool/resident_work.hpp"
#include "coupler/pool/worker.hpp"

namespace polargrain::coupler {

struct PoolOptions {
  /// Local worker processes; may be 0 when `listening`.
  int workers = 1;
  /// Gets logs/worker-K.log, which take the workers' and their engines' whole output; made when missing.
  std::filesystem::path directory;
  /// The program and its leading arguments; the pool adds `--connect URL`. Empty: this program, `worker`.
  std::vector<std::string> worker_command;
  /// Local workers run any script (grains_io/script.hpp).
  bool trust_scripts = false;
  /// A worker that has not said Hello after so long is a start-up failure; see PatienceLimits for the time that counts.
  double startup_seconds = 60.0;
  /// Bytes that a worker is assumed to keep; see StateCache.
  std::size_t cache_bytes = kWorkerCacheBytes;
  PatienceLimits patience;
  /// Where workers of other machines may join and leave at any time.
  std::optional<Listening> listening;
  /// Judges each state that a worker sends, before anybody uses it; empty: only names are checked.
  StateCheck state_fault;
  /// Share of the evaluations that two workers must agree on, 0 to 1; see foreman_checks.cpp.
  double check_share = 0.0;
  /// Called twice a second at least while the pool waits for anything, its first workers included. An exception ends the
  /// waiting: this is where a program heeds the signals it was sent. Empty: the pool waits undisturbed.
  std::function<void()> heed;
  /// Gets a sentence about everything the user should know that ends nothing: a worker lost, a guest refused.
  std::function<void(const std::string&)> tell;
};

/// One cell to evaluate: number from Pool::define, state and increment.
struct PoolRequest {
  std::uint32_t definition = 0;
  CellRequest cell;
  std::optional<std::size_t> point = {};  ///< which point of its material it stands for, for messages
};

/// A cell that no worker could answer, or that answered that it failed.
struct CellFailure {
  std::uint32_t definition = 0;
  CellRequest request;
  std::optional<std::size_t> point;
  std::string reason;
};

/// Costs of the cells so far.
struct PoolCounts {
  std::int64_t evaluations = 0;
  std::int64_t dem_steps = 0;
  std::int64_t states_sent = 0;  ///< states whose bytes had to travel to a worker
  std::int64_t states_fetched =
      0;  ///< states on trial whose bytes were fetched from the worker that made them
  std::int64_t evaluations_again = 0;    ///< for states on trial that were lost with their worker
  std::int64_t evaluations_checked = 0;  ///< answers that another worker agreed with
  std::int64_t bytes_sent = 0;
  std::int64_t bytes_received = 0;
  std::int64_t workers_lost = 0;
  double engine_seconds = 0.0;  ///< inside the engines, summed over workers
  double busy_seconds = 0.0;    ///< from sending a request to its reply, summed over workers
  double wall_seconds = 0.0;    ///< spent by the coordinator in evaluate, initial and collect
  double member_seconds = 0.0;  ///< the same, times the workers there were
};

/// The account of a worker that has answered.
struct WorkerRecord {
  std::int64_t evaluations = 0;
  std::string processor = {};  ///< its kind, as the worker says
};

/// The coordinator's side of its workers: spreads cells over them as they become free, notices their death at
/// once and their hanging by their silence. Results do not depend on how many there are, nor on who
/// took which cell, nor on who died meanwhile.
///
/// A request whose worker is lost goes to another one, from the same state. When the work itself has ended
/// two workers (engine error, crash, hanging, refusal), or ten were killed at it from outside, the cell is at
/// fault: the reply is Quality::failed, with the last cause as its message and half the increment proposed.
///
/// A new state stays with the worker that made it: the replies of evaluate name it and say its size. Most are
/// never needed again; collect brings the bytes of those that are, at the latest when a step is committed.
/// A state lost with its worker is made again from where it came from, to the same bits. A worker is given
/// first the requests that start from a state that it has.
///
/// Order of calls: construct (starts the workers), define each material's cell, then any number of initial,
/// evaluate and collect. After an exception other than ResidentsLost the pool can only be destroyed. One thread.
///
/// A share of the evaluations, drawn by their order from a fixed seed, is done by two workers, who must
/// come to the same bits; a third decides. A worker found alone is sent away, and its other answers in the same
/// call are computed again.
///
/// @throws FalseResults when answers that were returned before come from such a worker. @throws RunError when a
/// program cannot be started as a worker, when a definition ends every worker that
/// takes it (with the engine's own words and the name of the log), when no worker is left, when a state that
/// was lost cannot be made again.
class Pool {
 public:
  explicit Pool(PoolOptions options);
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Makes a cell known. @returns the number that requests name it by.
  std::uint32_t define(CellDefinition definition);
  [[nodiscard]] const CellDefinition& definition(std::uint32_t number) const;
  /// The packing of a definition at rest, with its state.
  CellReply initial(std::uint32_t definition);
  /// Evaluates all requests; equal ones once. Collects first the states they start from.
  /// @returns the replies in the order of the requests. A state in them may be elsewhere
  std::vector<CellReply> evaluate(std::span<const PoolRequest> requests);
  /// The same states with their bytes; those that are here already, and null, as they are. To be used in the
  /// place of the pointers given, which nobody can collect again once these are gone.
  std::vector<StatePointer> collect(std::span<const StatePointer> states);
  /// The first request of the last evaluate whose reply is Quality::failed.
  [[nodiscard]] const std::optional<CellFailure>& last_failure() const;

  /// Called after each reply of an evaluate, and twice a second while no reply comes, with the cells done and
  /// the cells asked for.
  void on_progress(std::function<void(std::size_t done, std::size_t total)> call);
  /// Called behind each evaluate with its requests, their states with bytes, and its replies.
  void on_answers(std::function<void(std::span<const PoolRequest>, std::span<const CellReply>)> call);
  [[nodiscard]] const PoolCounts& counts() const;
  /// The workers that have answered, by their names.
  [[nodiscard]] const std::map<std::string, WorkerRecord>& worker_records() const;
  /// Where workers of other machines may join; empty when nowhere.
  [[nodiscard]] std::string listening_url() const;
  /// Connections that were refused so far.
  [[nodiscard]] std::size_t refused() const;
  /// Local workers, as asked for.
  [[nodiscard]] int workers() const;
  /// Gives the user a sentence; see PoolOptions::tell.
  void tell(const std::string& text) const;

 private:
  friend class ResidentTeam;
  /// The workers there are; see Foreman::gather.
  std::vector<std::uint64_t> gather();
  [[nodiscard]] std::size_t present_count() const;
  /// Has these messages about boxes of a definition answered, those of one worker in their order.
  /// @throws ResidentsLost when one of these workers is gone @throws RunError when one refuses its boxes
  void serve(std::uint32_t definition, std::vector<ResidentWork>& works);

  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::coupler
