// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <optional>
#include <string>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// One kind of remark: looks at a scene and adds its remarks. A new kind is a file in kinds/ with its function, and
/// its line in remarks.cpp.
using RemarkKind = void (*)(const Scene& scene, Remarks& remarks);

/// All remarks on a scene, worst first; remarks of one rank by their weight. Runs no cell.
Remarks remarks_on(const Scene& scene);

/// The same from the file of a case. @param settings of --set
/// @param packings as the engine has found them; a packing not asked for gets no remark
Remarks remarks_on(const coupler::Case& the_case, const std::vector<std::string>& settings,
                   const PackingsAtRest& packings);

/// "wrong", "doubtful", "costly"
const char* name_of(Rank rank);
/// A remark on one line: rank, file, line, finding, remedy.
std::string line_of(const Remark& remark);

/// The number of remarks shown to people.
inline constexpr std::size_t kRemarksShown = 8;
/// The first of them, a line each, under a heading; empty without remarks. @param all whether to show every one
std::string text_of(const Remarks& remarks, bool all = false);

/// @throws InputError with all of them as faults, where there are any (--strict)
void refuse(const Remarks& remarks);

}  // namespace polargrain::app
