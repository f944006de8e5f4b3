// SPDX-License-Identifier: GPL-2.0-or-later
// continuum: kind, and slips that are spread (docs/theory/spread.md)
#include "coupler/case/read_continuum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "common/packing_file.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_length.hpp"

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

/// `spread: measured`: the length that polargrain layer has written beside the packings, of which there is one in a body.
double measured_spread(const Entry& spread, const Entry& document, CaseParts& parts) {
  const auto fault = [&](const std::string& text) {
    parts.faults.push_back(spread.fault("continuum: spread: measured: " + text));
  };
  std::vector<std::pair<std::string, double>> found;
  bool told = false;
  const Entry* const materials = document.find("materials");
  for (const Entry::Member& material :
       materials == nullptr ? std::vector<Entry::Member>{} : materials->members) {
    const Entry* const packing = material.value.find("packing");
    const Entry* const script = material.value.find("script");
    if (packing == nullptr || script == nullptr) continue;
    const auto packing_file = find_data_file(packing->text, parts.directory);
    const auto script_file = find_data_file(script->text, parts.directory);
    if (!packing_file || !script_file) return 1.0;  // is a fault of the material
    try {
      const auto measured =
          length_beside({*packing_file, packing->text, 2.0 * read_packing(*packing_file).mean_radius(),
                         text_of_script(*script_file), script->text},
                        [&](const std::string& text) {
                          told = true;
                          fault(text);
                        });
      if (measured && measured->spread) found.emplace_back(packing->text, *measured->spread);
      if (measured && !measured->spread) {
        told = true;
        fault(fmt::format(
            "{} holds no spread; 'polargrain layer' without --no-spread measures it, or give a length",
            length_file_of(*packing_file).filename().string()));
      }
    } catch (const InputError&) {
      return 1.0;  // is a fault of the material
    }
  }
  if (told) return 1.0;
  if (found.empty()) {
    fault("no material has grains that it could be measured of; give a length, such as '5 mm'");
    return 1.0;
  }
  for (const auto& [name, length] : found)
    if (length != found.front().second)
      fault(fmt::format(
          "the spread is one of the whole body: '{}' has {:.4g} mm, '{}' has {:.4g} mm; give a length",
          found.front().first, 1e3 * found.front().second, name, 1e3 * length));
  return found.front().second;
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
          "such as '5 mm', or 'measured'"));
    } else if (spread != nullptr && spread->text == "measured") {
      parts.result.spread = measured_spread(*spread, document, parts);
    } else {
      parts.result.spread = section.quantity_or("spread", Dimension::length, Limit::not_negative, 0.0);
    }
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
