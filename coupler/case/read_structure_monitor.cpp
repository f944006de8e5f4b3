// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>

#include "coupler/case/parts.hpp"
#include "coupler/case/structure_values.hpp"

namespace polargrain::coupler {

bool read_structure_monitor(Section& section, CaseParts& parts, Monitor& monitor) {
  std::string kind;
  for (const std::string candidate : {"interface", "beam", "anchor"})
    if (section.find(candidate) != nullptr) kind = candidate;
  if (kind.empty()) return false;
  monitor.kind = Monitor::Kind::structure;
  monitor.structure = section.text(kind, "the name of an " + kind);
  const std::vector<std::string>& values = values_of_structure(kind);
  monitor.value = values.size() == 1 && section.find("value") == nullptr ? values.front()
                                                                         : section.choice("value", values);
  section.finish();
  if (!parts.has_mesh || monitor.structure.empty()) return true;
  const std::vector<std::string> known =
      parts.result.with_problem([&](const auto& problem) { return structures_of(problem, kind); });
  if (std::ranges::find(known, monitor.structure) != known.end()) return true;
  const std::string guess = nearest(monitor.structure, known);
  section.fault(kind, fmt::format("{0}: there is no {0} '{1}'; {2}", kind, monitor.structure,
                                  !guess.empty()  ? "did you mean '" + guess + "'?"
                                  : known.empty() ? "give it below '" + kind + "s'"
                                                  : "there are " + listed(known)));
  return true;
}

}  // namespace polargrain::coupler
