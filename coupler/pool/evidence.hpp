// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>

#include "common/cell.hpp"

namespace polargrain::coupler {

/// The answer of an evaluation, kept with its state: should the state turn out to be false, whoever
/// evaluates again shows whether the numbers that were used are right.
struct Evidence {
  ContentName answer = {};  ///< of the numbers; see name_of_answer
  std::string who = {};     ///< name of the worker
  bool confirmed = false;   ///< another worker has come to the same numbers and the same state
};

/// Of all that counts as result in an answer: equal for equal bits.
ContentName name_of_answer(const CellReply& reply);

}  // namespace polargrain::coupler
