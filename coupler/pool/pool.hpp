// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "coupler/pool/worker.hpp"

namespace polargrain::coupler {

struct PoolOptions {
  int workers = 1;
  /// Gets logs/worker-K.log, which take the workers' and their engines' whole output; made when missing.
  std::filesystem::path directory;
  /// The program and its leading arguments; the pool adds `--connect URL`. Empty: this program, `worker`.
  std::vector<std::string> worker_command;
  /// A worker that has not said Hello after so long is a start-up failure.
  double startup_seconds = 10.0;
  /// What a worker is taken to keep; see StateCache.
  std::size_t cache_bytes = kWorkerCacheBytes;
};

/// One cell to evaluate: number from Pool::define, state and increment.
struct PoolRequest {
  std::uint32_t definition = 0;
  CellRequest cell;
};

/// What the cells have cost so far.
struct PoolCounts {
  std::int64_t evaluations = 0;
  std::int64_t dem_steps = 0;
  std::int64_t states_sent = 0;  ///< states whose bytes had to travel to a worker
  std::int64_t bytes_sent = 0;
  std::int64_t bytes_received = 0;
  double engine_seconds = 0.0;  ///< inside the engines, summed over workers
  double busy_seconds = 0.0;    ///< from sending a request to its reply, summed over workers
  double wall_seconds = 0.0;    ///< spent by the coordinator in evaluate and initial
};

/// The coordinator's side of its workers: starts them, spreads cells over them as they become free, notices
/// their death at once. What comes back does not depend on how many there are, nor on who took which cell.
///
/// Order of calls: construct (starts the workers), define each material's cell, then any number of initial
/// and evaluate. After an exception the pool can only be destroyed. One thread.
///
/// @throws RunError when a worker dies (with the engine's own words and the name of the log), when it does
/// not report in time, when it refuses a request or sends what is no message.
class Pool {
 public:
  explicit Pool(PoolOptions options);
  ~Pool();
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  /// Makes a cell known. @returns the number that requests name it by.
  std::uint32_t define(CellDefinition definition);
  /// The packing of a definition at rest.
  CellReply initial(std::uint32_t definition);
  /// Evaluates all requests. @returns the replies in the order of the requests.
  std::vector<CellReply> evaluate(std::span<const PoolRequest> requests);

  /// Called after each reply of an evaluate with the cells done and the cells asked for.
  void on_progress(std::function<void(std::size_t done, std::size_t total)> call);
  [[nodiscard]] const PoolCounts& counts() const;
  [[nodiscard]] int workers() const;

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace polargrain::coupler
