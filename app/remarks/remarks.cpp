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

/// The bodies that a kind of remarks knows.
enum class Bodies { plane, space, both };

struct Kind {
  RemarkKind look;
  Bodies bodies;
  /// It weighs loads against the stress of the skeleton alone, as if there were no water.
  bool of_dry_ground = false;
};

/// The kinds that look at loads and stresses at time zero, one by one.
constexpr Kind kAtTimeZero[] = {{loads_at_start, Bodies::both, true},
                                {weight_in_boxes, Bodies::both},
                                {load_on_held, Bodies::both},
                                {plain_loads, Bodies::both},
                                {tension, Bodies::both},
                                {ground_stress, Bodies::both},
                                {weight, Bodies::both},
                                {free_sides, Bodies::both},
                                {stiffness_of_laws, Bodies::both},
                                {loads_twice, Bodies::both}};

/// All loads and stresses at time zero together: told where the kinds above have no remark.
constexpr Kind kBalance[] = {{balance_at_start, Bodies::both, true}};

constexpr Kind kOtherRemarks[] = {{movement, Bodies::both},
                                  {times_of_loads, Bodies::both},
                                  {idle_steps, Bodies::both},
                                  {growing_steps, Bodies::both},
                                  {missed_turns, Bodies::both},
                                  {open_seams, Bodies::both},
                                  {steps_of_strain, Bodies::both},
                                  {internal_length, Bodies::both},
                                  {plastic_length, Bodies::both},
                                  {few_grains, Bodies::both},
                                  {softness, Bodies::both},
                                  {size_of_grains, Bodies::both},
                                  {unread_properties, Bodies::both},
                                  {contact_numbers, Bodies::both},
                                  {neighbours, Bodies::both},
                                  {tolerances, Bodies::both},
                                  {softening_cauchy, Bodies::both},
                                  {strength_of_laws, Bodies::both},
                                  {monitors, Bodies::both},
                                  {measures, Bodies::both},
                                  {formulas, Bodies::both},
                                  {output, Bodies::both},
                                  {cost, Bodies::both},
                                  {moduli, Bodies::both},
                                  {node_forces, Bodies::both},
                                  {weight_at_once, Bodies::both, true},
                                  {pulled_apart, Bodies::both},
                                  {carried_along, Bodies::both},
                                  {held_sides, Bodies::both},
                                  {narrow_plates, Bodies::plane},
                                  {shape_of_elements, Bodies::both},
                                  {places_of_monitors, Bodies::both},
                                  {ends_of_profiles, Bodies::both},
                                  {structures, Bodies::plane},
                                  {weight_of_parts, Bodies::both},
                                  {loads_of_stages, Bodies::both},
                                  {sums_of_stages, Bodies::both},
                                  {densities, Bodies::both},
                                  {motions, Bodies::both},
                                  {pore_water, Bodies::both},
                                  {drains_dug_away, Bodies::both},
                                  {loads_behind_walls, Bodies::both},
                                  {polygons_of_cylinders, Bodies::space},
                                  {end_of_run_before, Bodies::both}};

void look_by(std::span<const Kind> kinds, const Scene& scene, Remarks& remarks) {
  const Bodies here = scene.dimension() == 3 ? Bodies::space : Bodies::plane;
  const bool is_wet = scene.find({"water"}) != nullptr;
  for (const Kind& kind : kinds) {
    const bool is_of_body = kind.bodies == here || kind.bodies == Bodies::both;
    if (is_of_body && !(is_wet && kind.of_dry_ground)) kind.look(scene, remarks);
  }
}

/// Kinds that later stages may have too, by their supports and loads.
constexpr Kind kInEachStage[] = {{load_on_held, Bodies::both}, {plain_loads, Bodies::both},
                                 {weight, Bodies::both},       {movement, Bodies::both},
                                 {node_forces, Bodies::both},  {loads_twice, Bodies::both},
                                 {tension, Bodies::both}};

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
