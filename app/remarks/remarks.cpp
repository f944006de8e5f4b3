// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <utility>

#include "app/remarks/kinds.hpp"
#include "coupler/case/document_kind.hpp"

namespace polargrain::app {
namespace {

struct Kind {
  RemarkKind look;
  /// It weighs loads against the stress of the skeleton alone, as if there were no water.
  bool of_dry_ground = false;
};

/// The kinds that look at loads and stresses at time zero, one by one.
constexpr Kind kAtTimeZero[] = {
    {loads_at_start, true}, {weight_in_boxes}, {load_on_held}, {plain_loads},       {tension},
    {ground_stress},        {weight},          {free_sides},   {stiffness_of_laws}, {loads_twice}};

/// All loads and stresses at time zero together: told where the kinds above have no remark.
constexpr Kind kBalance[] = {{balance_at_start, true}};

constexpr Kind kOtherRemarks[] = {{movement},
                                  {times_of_loads},
                                  {idle_steps},
                                  {growing_steps},
                                  {missed_turns},
                                  {open_seams},
                                  {hanging_nodes},
                                  {steps_of_strain},
                                  {internal_length},
                                  {plastic_length},
                                  {few_grains},
                                  {softness},
                                  {size_of_grains},
                                  {unread_properties},
                                  {contact_numbers},
                                  {neighbours},
                                  {tolerances},
                                  {softening_cauchy},
                                  {strength_of_laws},
                                  {monitors},
                                  {measures},
                                  {formulas},
                                  {output},
                                  {cost},
                                  {moduli},
                                  {node_forces},
                                  {weight_at_once, true},
                                  {pulled_apart},
                                  {carried_along},
                                  {held_sides},
                                  {narrow_plates},
                                  {shape_of_elements},
                                  {skew_locking},
                                  {places_of_monitors},
                                  {ends_of_profiles},
                                  {ends_of_regions},
                                  {parted_curves},
                                  {structures},
                                  {weight_of_parts},
                                  {loads_of_stages},
                                  {sums_of_stages},
                                  {placed_stress, true},
                                  {densities},
                                  {motions},
                                  {length_of_pulses},
                                  {quiet_sides},
                                  {pore_water},
                                  {drains_dug_away},
                                  {loads_behind_walls},
                                  {polygons_of_cylinders},
                                  {end_of_run_before},
                                  {pressure_of_run_before, true}};

void look_by(std::span<const Kind> kinds, const Scene& scene, Remarks& remarks) {
  const bool is_wet = scene.find({"water"}) != nullptr;
  for (const Kind& kind : kinds)
    if (!(is_wet && kind.of_dry_ground)) kind.look(scene, remarks);
}

/// Kinds that later stages may have too, by their supports and loads.
constexpr Kind kInEachStage[] = {{load_on_held}, {plain_loads}, {weight}, {movement},
                                 {node_forces},  {loads_twice}, {tension}};

/// An item that stays through several stages is told once.
void look_at_later_stages(const Scene& scene, Remarks& remarks) {
  const int stages =
      scene.with_problem([](const auto& problem) { return static_cast<int>(problem.stages.size()); });
  for (int stage = 1; stage < stages; ++stage) {
    Remarks later;
    look_by(kInEachStage, scene.in_stage(stage), later);
    for (Remark& remark : later) {
      const auto is_known = [&](const Remark& known) {
        return known.at.message == remark.at.message ||
               (known.at.line == remark.at.line && known.remedy == remark.remedy);
      };
      if (std::ranges::none_of(remarks, is_known)) remarks.push_back(std::move(remark));
    }
  }
}

std::string with_number(std::size_t count) {
  return fmt::format("{} remark{}", count, count == 1 ? "" : "s");
}

}  // namespace

Remarks remarks_on(const Scene& scene) {
  Remarks remarks;
  if (scene.stress_at_start() != Scene::StressAtStart::run_before) {
    look_by(kAtTimeZero, scene, remarks);
    if (remarks.empty()) look_by(kBalance, scene, remarks);
  }
  look_by(kOtherRemarks, scene, remarks);
  look_at_later_stages(scene, remarks);
  // Regions of one material have its remarks alike.
  std::set<std::string> told;
  std::erase_if(remarks, [&](const Remark& remark) { return !told.insert(remark.at.text()).second; });
  std::ranges::stable_sort(remarks, [](const Remark& a, const Remark& b) {
    return a.rank != b.rank ? a.rank < b.rank : a.weight > b.weight;
  });
  return remarks;
}

Remarks remarks_on(const coupler::Case& the_case, const std::vector<std::string>& settings,
                   const PackingsAtRest& packings) {
  const coupler::Entry document =
      coupler::load_document_of(coupler::DocumentKind::problem, the_case.file, settings);
  return remarks_on(Scene(the_case, document, packings));
}

const char* name_of(Rank rank) {
  switch (rank) {
    case Rank::wrong:
      return "wrong";
    case Rank::doubtful:
      return "doubtful";
    case Rank::costly:
      break;
  }
  return "costly";
}

std::string line_of(const Remark& remark) {
  return fmt::format("{}: {}; {}", name_of(remark.rank), remark.at.text(), remark.remedy);
}

std::string text_of(const Remarks& remarks, bool all) {
  if (remarks.empty()) return {};
  const std::size_t shown = all ? remarks.size() : std::min(remarks.size(), kRemarksShown);
  std::string text = fmt::format("{} on the case, the most serious first:\n", with_number(remarks.size()));
  for (std::size_t k = 0; k < shown; ++k)
    text += fmt::format("  {:<9} {}\n            -> {}\n", name_of(remarks[k].rank), remarks[k].at.text(),
                        remarks[k].remedy);
  if (shown < remarks.size())
    text += fmt::format("  {} more: polargrain check --all\n", remarks.size() - shown);
  return text;
}

void refuse(const Remarks& remarks) {
  if (remarks.empty()) return;
  std::vector<Fault> faults;
  for (const Remark& remark : remarks)
    faults.push_back(
        {remark.at.file, remark.at.line,
         fmt::format("{}; {} ({}, --strict)", remark.at.message, remark.remedy, name_of(remark.rank))});
  throw InputError(faults);
}

}  // namespace polargrain::app
