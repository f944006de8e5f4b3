// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "common/cell.hpp"
#include "coupler/pool/attempts.hpp"
#include "coupler/pool/evidence.hpp"
#include "coupler/pool/opinions.hpp"
#include "coupler/pool/resident_work.hpp"

namespace polargrain::coupler {

/// Something that one worker is to do.
struct Task {
  enum class Kind {
    rest,      ///< the packing at rest
    evaluate,  ///< a cell
    fetch,     ///< the bytes of a state on trial, from the worker that keeps it
    again,     ///< those bytes from anybody: the cell is evaluated again from where it was
    resident   ///< a message about resident boxes, to the worker that has them
  };
  Kind kind = Kind::evaluate;
  std::uint32_t definition = 0;
  CellRequest cell = {};  ///< its state is here, or null
  std::optional<std::size_t> point = {};
  StatePointer wanted = {};                    ///< fetch, again: the state on trial
  std::optional<ResidentWork> residents = {};  ///< resident

  std::uint64_t home = 0;  ///< the worker that should have the state the cell starts from; 0: not known

  CellReply reply = {};
  bool alone =
      false;  ///< the worker has nothing else meanwhile: a worker with this and others was lost, or it is `resident`
  Attempts attempts = {};  ///< that came to nothing

  // rest, evaluate: who answered, where that can be checked
  bool checked = false;       ///< two workers must agree on the answer
  Opinions opinions = {};     ///< of a checked one that is not done yet
  std::string answerer = {};  ///< standing of the worker whose answer was taken with no second one beside it

  // fetch, again: of the evaluation that made the state
  Evidence evidence = {};
  std::vector<ContentName> others = {};  ///< the other answers of repeated evaluations
};

/// Whether two tasks may go in one message.
inline bool go_together(const Task& a, const Task& b) {
  const auto travels_alone = [](const Task& task) {
    return task.kind == Task::Kind::rest || task.alone || !task.attempts.empty() || !task.opinions.empty();
  };
  return a.kind == b.kind && a.definition == b.definition && !travels_alone(a) && !travels_alone(b);
}

}  // namespace polargrain::coupler
