// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/remarks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "app/remarks/kinds.hpp"
#include "coupler/case/document_kind.hpp"

namespace polargrain::app {
namespace {

/// The kinds that look at loads and stresses at time zero, one by one.
constexpr RemarkKind kAtTimeZero[] = {loads_at_start, weight_in_boxes, load_on_held,
                                      plain_loads,    tension,         ground_stress,
                                      weight,         free_sides,      stiffness_of_laws};

constexpr RemarkKind kOthers[] = {movement,
                                  times_of_loads,
                                  idle_steps,
                                  missed_turns,
                                  open_seams,
                                  steps_of_strain,
                                  internal_length,
                                  plastic_length,
                                  few_grains,
                                  softness,
                                  size_of_grains,
                                  unread_properties,
                                  contact_numbers,
                                  neighbours,
                                  tolerances,
                                  softening_cauchy,
                                  strength_of_laws,
                                  monitors,
                                  measures,
                                  formulas,
                                  output,
                                  cost,
                                  moduli,
                                  node_forces,
                                  weight_at_once,
                                  pulled_apart,
                                  carried_along,
                                  held_sides,
                                  shape_of_elements,
                                  places_of_monitors,
                                  pore_water};

/// The kinds that know bodies in space.
constexpr RemarkKind kInSpace[] = {loads_at_start_in_space,
                                   movement,
                                   times_of_loads,
                                   missed_turns,
                                   idle_steps,
                                   steps_of_strain,
                                   internal_length,
                                   plastic_length,
                                   few_grains,
                                   softness,
                                   size_of_grains,
                                   unread_properties,
                                   contact_numbers,
                                   neighbours,
                                   softening_cauchy,
                                   output,
                                   cost,
                                   moduli,
                                   pore_water};

/// The kinds that weigh loads against the stress of the skeleton alone.
constexpr RemarkKind kOfDryGround[] = {loads_at_start, loads_at_start_in_space, weight_at_once};

std::string with_number(std::size_t count) {
  return fmt::format("{} remark{}", count, count == 1 ? "" : "s");
}

}  // namespace

Remarks remarks_on(const Scene& scene) {
  Remarks remarks;
  const bool is_wet = scene.find({"water"}) != nullptr;
  const auto look_with = [&](const auto& kinds) {
    for (const RemarkKind look : kinds)
      if (!is_wet || std::ranges::find(kOfDryGround, look) == std::end(kOfDryGround)) look(scene, remarks);
  };
  if (scene.dimension() == 3) {
    look_with(kInSpace);
  } else {
    look_with(kAtTimeZero);
    if (remarks.empty() && !is_wet) balance_at_start(scene, remarks);
    look_with(kOthers);
  }
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
