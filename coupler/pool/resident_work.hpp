// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

#include "common/error.hpp"
#include "coupler/protocol/messages.hpp"

namespace polargrain::coupler {

/// Resident boxes are gone with their worker: they are to be moved in again from where they were last read out.
class ResidentsLost : public RunError {
 public:
  using RunError::RunError;
};

/// One message about resident boxes to the worker that has them, and its answer.
struct ResidentWork {
  std::uint64_t worker = 0;  ///< number of its Member; nobody else can do it
  std::size_t first = 0;     ///< number of the first box, counted over all workers
  std::size_t boxes = 0;
  std::variant<MoveIn, GoOn, ReadOut> message;  ///< but `request` and `settled`
  ResidentReply reply = {};
};

}  // namespace polargrain::coupler
