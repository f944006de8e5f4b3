// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "common/error.hpp"
#include "coupler/pool/pool.hpp"

namespace polargrain::coupler {

/// Somebody wished an evaluation to end before it was done.
class Cancelled : public RunError {
 public:
  using RunError::RunError;
};

/// Cells are known by their definition; those who share a pointer share the engines.
using DefinitionPointer = std::shared_ptr<const CellDefinition>;

struct HostedRequest {
  DefinitionPointer definition;
  CellRequest cell;
};

/// Cells for a host that is not the program: an interpreter, a finite element code. Engines run in processes of the
/// program, because LIGGGHTS ends its process on any error and leaves signal handlers and MPI behind: a host must have
/// neither. A pool is kept by a thread of its own, because workers end with the thread that started them, and a pool is
/// for one thread; calls may come from any, one at a time is served.
///
/// The pool starts with the first question. After an exception it is gone, and the next question starts another one:
/// cells are values, so nothing is lost.
class HostedCells {
 public:
  struct Options {
    std::vector<std::string> worker_command;  ///< as PoolOptions
    int workers = 1;
    bool trust_scripts = false;
    std::function<void(const std::string&)> tell = {};  ///< as PoolOptions; called by the pool's thread
  };
  explicit HostedCells(Options options);
  /// Ends the workers.
  ~HostedCells();
  HostedCells(const HostedCells&) = delete;
  HostedCells& operator=(const HostedCells&) = delete;

  /// Asked ten times a second while a question waits: whether it is still wanted.
  using IsWanted = std::function<bool()>;

  /// The packing at rest, with its state. @throws Cancelled, RunError as Pool, or in a process that was forked from the
  /// one that asked before
  CellReply initial(const DefinitionPointer& definition, const IsWanted& is_wanted = {});
  /// @returns the replies in the order of the requests; their states have their bytes
  /// @throws as initial
  std::vector<CellReply> evaluate(const std::vector<HostedRequest>& requests, const IsWanted& is_wanted = {});
  /// Costs of the cells since the pool was started last.
  [[nodiscard]] PoolCounts counts() const;
  /// Ends the workers now; the next question starts others.
  void close();

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

/// The program whose workers serve cells: $POLARGRAIN_PROGRAM, or else the first of these that is there, or else
/// `polargrain` of $PATH. @throws InputError when it is missing
std::string program_for_workers(const std::vector<std::filesystem::path>& places);

}  // namespace polargrain::coupler
