// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/run_remarks.hpp"

#include "app/run/interrupt.hpp"

#include "common/error.hpp"

namespace polargrain::app {

Remarks remarks_before(const RunOptions& options, const coupler::Case& the_case) {
  PackingsAtRest packings;
  try {
    // Without workers of its own a run may be on a machine that is to run no engine.
    if (options.workers > 0)
      packings = packings_at_rest(the_case, options.scripts.trusted, LogsOfFailure::lost,
                                  [] { stop_if_interrupted("before anything was written"); });
  } catch (const Interrupted&) {
    throw;
  } catch (const RunError&) {
    packings.clear();
  }
  Remarks remarks = remarks_on(the_case, options.settings, packings);
  if (options.strict) refuse(remarks);
  return remarks;
}

nlohmann::ordered_json remarks_for_summary(const Remarks& remarks) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Remark& remark : remarks)
    list.push_back({{"rank", name_of(remark.rank)},
                    {"file", remark.at.file},
                    {"line", remark.at.line},
                    {"text", remark.at.message},
                    {"remedy", remark.remedy}});
  return list;
}

}  // namespace polargrain::app
