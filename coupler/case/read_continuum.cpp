// SPDX-License-Identifier: GPL-2.0-or-later
// continuum: kind, and slips that are spread (docs/theory/spread.md)
#include "coupler/case/read_continuum.hpp"

#include <fmt/format.h>

#include "coupler/case/read_spread.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kCosserat = "cosserat";
constexpr const char* kCauchy = "cauchy";

/// Where slips cannot be spread yet.
void refuse(const Entry& entry, const Entry& document, CaseParts& parts) {
  if (builds_in_stages(document))
    parts.faults.push_back(
        entry.fault("continuum: spread: slips are spread where no region comes or goes; leave spread out"));
}

}  // namespace

void read_continuum(const Entry* entry, const Entry& document, CaseParts& parts) {
  std::string kind = kCosserat;
  if (entry != nullptr && entry->kind == Entry::Kind::map) {
    Section section(*entry, "continuum", parts.faults);
    kind = section.choice_or("kind", {kCosserat, kCauchy}, kCosserat);
    if (const Entry* const spread = section.find("spread"); spread != nullptr && spread_is_of_grains(*spread))
      parts.result.spread = spread_of_grains(*spread, document, parts);
    else
      parts.result.spread = section.quantity_or("spread", Dimension::length, Limit::not_negative, 0.0);
    if (section.find("hold") != nullptr) {
      parts.result.slips_held_on =
          section.words("hold", "a boundary where no slip may be, or a list of them");
      parts.check_places(section, "hold", parts.result.slips_held_on, "a hold of slips");
      if (parts.result.spread == 0.0)
        section.fault("hold",
                      "hold: without 'spread' there are no slips to hold; give both keys, or leave hold out");
    }
    section.finish();
    if (parts.result.spread > 0.0) refuse(*entry, document, parts);
  } else if (entry != nullptr) {
    Section top(document, "case", parts.faults);
    kind = top.choice_or("continuum", {kCosserat, kCauchy}, kCosserat);
  }
  parts.result.with_problem([&](auto& problem) {
    problem.continuum = kind == kCauchy ? fem::Continuum::cauchy : fem::Continuum::cosserat;
  });
}

void check_spread_slips(const Entry& entry, CaseParts& parts) {
  bool any = false;
  for (const auto& [name, recipe] : parts.result.materials) {
    if (!recipe) return;  // a fault
    any = any || recipe->slips() == Slips::spread;
    if (recipe->slips() == Slips::own)
      parts.faults.push_back(entry.fault(fmt::format(
          "continuum: spread: the model of material '{}' cannot spread its slips yet; elastic, elastoplastic, "
          "cell and informed ones can",
          name)));
  }
  if (!any)
    parts.faults.push_back(
        entry.fault("continuum: spread: no material has slips that could be spread; leave spread out"));
}

}  // namespace polargrain::coupler
