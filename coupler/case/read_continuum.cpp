// SPDX-License-Identifier: GPL-2.0-or-later
// continuum: kind, and slips that are spread (docs/theory/spread.md)
#include "coupler/case/read_continuum.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace polargrain::coupler {
namespace {

constexpr const char* kCosserat = "cosserat";
constexpr const char* kCauchy = "cauchy";

/// Where slips cannot be spread yet.
void refuse(const Entry& entry, const Entry& document, CaseParts& parts) {
  const auto fault = [&](const std::string& text) {
    parts.faults.push_back(entry.fault("continuum: spread: " + text));
  };
  if (dem_steps_of(document) > 0)
    fault("explicit steps do not spread slips; leave 'method' out of the steps");
  if (builds_in_stages(document)) fault("slips are spread where no region comes or goes; leave spread out");
}

}  // namespace

void read_continuum(const Entry* entry, const Entry& document, CaseParts& parts) {
  std::string kind = kCosserat;
  if (entry != nullptr && entry->kind == Entry::Kind::map) {
    Section section(*entry, "continuum", parts.faults);
    kind = section.choice_or("kind", {kCosserat, kCauchy}, kCosserat);
    const Entry* const spread = section.find("spread");
    if (spread != nullptr && spread->text.ends_with("d50")) {
      parts.faults.push_back(spread->fault(
          "continuum: spread: the spread is one of the whole body, not of the grains of one material; give a length, "
          "such as '5 mm'"));
    } else {
      parts.result.spread = section.quantity_or("spread", Dimension::length, Limit::not_negative, 0.0);
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
