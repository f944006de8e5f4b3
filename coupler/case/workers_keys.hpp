// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "coupler/case/keys.hpp"
#include "coupler/pool/patience.hpp"

namespace polargrain::coupler {

/// The map `workers` of a case.
struct WorkersOfCase {
  PatienceLimits patience = {};
  double check_share = 0.0;  ///< of the evaluations, 0 to 1
};

template <class Visit>
void describe_keys(WorkersOfCase& workers, Visit&& visit) {
  visit(Key{.name = "silence",
            .meaning = "a worker at work without a sign of life for so long is given up",
            .dimension = Dimension::duration},
        workers.patience.silence_seconds);
  visit(Key{.name = "cell_time",
            .meaning = "a cell may take so long, or 20 times the longest before, whichever is more",
            .dimension = Dimension::duration},
        workers.patience.cell_seconds);
  visit(
      Key{.name = "check",
          .meaning = "share of evaluations made by two workers, whose answers must have the same bits: `1 %` "
                     "([more](trust.md#whether-a-stress-is-right))",
          .limit = Limit::not_negative,
          .most = 1.0,
          .beyond = "it is a share of the evaluations, 100 % is all"},
      workers.check_share);
}

}  // namespace polargrain::coupler
