// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <nlohmann/json.hpp>

#include "app/remarks/remarks.hpp"
#include "app/run/run.hpp"

namespace polargrain::app {

/// Remarks on a case before its grains move. Where no worker can tell of a packing, those that need it are missing, and the
/// run ends in the engine's words. @throws InputError with all of them where the options are strict and there are any
Remarks remarks_before(const RunOptions& options, const coupler::Case& the_case);

/// As summary.json has them: rank, file, line, text, remedy.
nlohmann::ordered_json remarks_for_summary(const Remarks& remarks);

}  // namespace polargrain::app
