// SPDX-License-Identifier: GPL-2.0-or-later
#include "dem/cell/cell_answers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "common/error.hpp"
#include "common/stepping_note.hpp"
#include "dem/cell/packing_check.hpp"
#include "dem/cell/script_time_step.hpp"
#include "dem/engine/liggghts.hpp"

namespace polargrain::dem {

void check_rolling_model(LAMMPS_NS::LAMMPS& lammps) {
  const auto has = [&lammps](const char* property) {
    return lammps.modify->find_fix_property(property, "property/global", "peratomtypepair", 0, 0,
                                            "polargrain", false) != nullptr;
  };
  if (has("coefficientRollingFriction") && !has("rollingStiffnessRatio"))
    lammps.error->all(
        FLERR,
        "With controlled rotations the rolling model must be li_chu (or off): the stock models do "
        "not feel the curvature of the cell");
}

void restore_packing(const std::function<void()>& restore) {
  try {
    restore();
  } catch (const RunError& error) {
    throw RunError(fmt::format(
        "the springs of the contacts that the packing brings do not fit the script ({}); bring it to rest with "
        "'polargrain pack --settle PACKING SCRIPT -o NEW.h5'",
        error.what()));
  }
}

std::optional<CellReply> gone_astray(double size, double turn) {
  if (size <= kLargestIncrement && turn <= kLargestTurn) return std::nullopt;
  // Running it would cost hours and answer nothing.
  CellReply reply;
  reply.response.quality = Quality::failed;
  reply.response.step_factor = 0.5;
  const bool strains = size > kLargestIncrement;
  reply.response.message = fmt::format("the increment {} the cell by {:.2g} at once; at most {} is taken",
                                       strains ? "strains" : "turns", strains ? size : turn,
                                       strains ? kLargestIncrement : kLargestTurn);
  return reply;
}

void judge(CellResponse& response, const CellDiagnostics& diagnostics, const QuasiStatic& protocol,
           const CellControl& control, const Equilibrium& rest, std::span<const Contact> contacts,
           const Inertia& inertia, double time_step, double most_void_ratio) {
  std::string reason =
      answer_fault({diagnostics.mean_overlap, diagnostics.largest_overlap}, rest.void_ratio, most_void_ratio);
  if (reason.empty()) reason = step_fault(contacts, inertia, protocol.damping_rate(), time_step);
  if (reason.empty() && !protocol.at_rest(rest.unbalanced_force_ratio, rest.unbalanced_moment_ratio))
    reason = fmt::format(
        "the cell did not come to rest within {} DEM steps: unbalanced force ratio {:.2e} (asked {:.2e}), "
        "moment ratio {:.2e} (asked {:.2e})",
        protocol.relaxed(), rest.unbalanced_force_ratio, control.unbalanced_force_ratio,
        rest.unbalanced_moment_ratio, control.unbalanced_moment_ratio);
  if (reason.empty()) return;
  response.quality = Quality::unreliable;
  response.step_factor = 0.5;
  response.message = std::move(reason);
}

std::string stepping_note(CellLoop asked, const std::string& loop, const LawSelection& selection,
                          std::string_view instructions) {
  std::string note(kSteppingNote);
  if (asked == CellLoop::engine) return note + "LIGGGHTS's own loop, as `loop: engine` asks";
  if (!selection.combination)
    return note +
           fmt::format("LIGGGHTS's own loop, which is slower: {} does not take {}", loop, selection.reason);
  if (asked == CellLoop::plain)
    return note + fmt::format("the plain twin of {} ({})", loop, selection.combination->name());
  return note + fmt::format("{} ({}{}{})", loop, selection.combination->name(),
                            instructions.empty() ? "" : "; ", instructions);
}

std::string remarks_at_rest(const std::string& remark, const CellControl& control, const std::string& loop,
                            const LawSelection& selection, std::string_view instructions) {
  const std::string note = stepping_note(control.loop, loop, selection, instructions);
  return remark.empty() ? note : remark + "\n" + note;
}

std::string no_residents(const LawSelection& selection) {
  return fmt::format(
      "explicit steps need the program's own loop over the grains, and it does not take this script: {}; use the models "
      "and settings it knows (docs/contact_models.md), or `method: newton`",
      selection.reason);
}

CellDiagnostics diagnostics_of(const Equilibrium& rest, std::span<const Contact> contacts,
                               std::span<const double> radii) {
  CellDiagnostics diagnostics;
  diagnostics.unbalanced_force_ratio = rest.unbalanced_force_ratio;
  diagnostics.unbalanced_moment_ratio = rest.unbalanced_moment_ratio;
  diagnostics.void_ratio = rest.void_ratio;
  diagnostics.coordination_number = rest.coordination_number;
  diagnostics.rattlers = rest.rattlers;
  const Overlaps overlaps = overlaps_of(contacts, radii);
  diagnostics.mean_overlap = overlaps.mean;
  diagnostics.largest_overlap = overlaps.largest;
  const auto fraction = [&contacts](auto property) {
    const auto count = std::count_if(contacts.begin(), contacts.end(), property);
    return contacts.empty() ? 0.0 : static_cast<double>(count) / static_cast<double>(contacts.size());
  };
  diagnostics.contacts = static_cast<std::int64_t>(contacts.size());
  diagnostics.sliding_fraction = fraction([](const Contact& contact) { return contact.sliding(); });
  diagnostics.rolling_fraction = fraction([](const Contact& contact) { return contact.rolling_at_limit; });
  return diagnostics;
}

}  // namespace polargrain::dem
