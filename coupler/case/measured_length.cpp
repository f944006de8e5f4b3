// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/measured_length.hpp"

#include <fmt/format.h>

#include <cmath>
#include <span>
#include <sstream>
#include <vector>

#include "common/state.hpp"
#include "coupler/case/section.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {

namespace {

/// Sizes of grains may differ by so much, relative, from those a length was measured with.
constexpr double kSameGrains = 0.05;

}  // namespace

std::filesystem::path length_file_of(const std::filesystem::path& packing) {
  return std::filesystem::path(packing).replace_extension(".length.yaml");
}

std::string name_of_script(const std::string& text) {
  std::string commands;
  for (const ScriptCommand& command : commands_of_script(text, "")) {
    std::istringstream words(command.text);
    for (std::string word; words >> word;) commands += word + ' ';
    commands += '\n';
  }
  return name_of(std::as_bytes(std::span(commands))).text();
}

MeasuredLength read_measured_length(const std::filesystem::path& file) {
  const Entry document = load_document(file);
  Faults faults;
  Section section(document, "measured length", faults);
  MeasuredLength measured;
  measured.internal_length = section.quantity("lc", Dimension::length, Limit::positive);
  if (section.find("lp") != nullptr)
    measured.plastic_length = section.quantity("lp", Dimension::length, Limit::positive);
  if (section.find("spread") != nullptr)
    measured.spread = section.quantity("spread", Dimension::length, Limit::positive);
  measured.mean_diameter = section.quantity("mean_diameter", Dimension::length, Limit::positive);
  measured.script = section.text("script", "the name of a contact law");
  // How it was found is for people.
  for (const char* const note : {"lc_interval", "lp_interval", "spread_interval", "layers", "cells",
                                 "at_edge", "spread_at_edge", "preferred", "misfits"})
    section.find(note);
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  return measured;
}

std::optional<MeasuredLength> length_beside(const GrainsToMeasure& grains,
                                            const std::function<void(const std::string&)>& fault) {
  const std::filesystem::path file = length_file_of(grains.packing);
  const std::string name = file.filename().string();
  if (!std::filesystem::exists(file)) {
    fault(fmt::format(
        "there is no {}; 'polargrain layer SPEC.yaml --beside {}' makes the experiment and writes it, or "
        "give a length",
        name, grains.name));
    return std::nullopt;
  }
  try {
    const MeasuredLength measured = read_measured_length(file);
    std::vector<std::string> faults;
    if (std::abs(measured.mean_diameter - grains.mean_diameter) > kSameGrains * grains.mean_diameter)
      faults.push_back(fmt::format(
          "{} is of grains of {:.4g} mm, the grains of the packing have {:.4g} mm; measure with these "
          "grains, or give a length",
          name, 1e3 * measured.mean_diameter, 1e3 * grains.mean_diameter));
    if (!grains.script.empty() && measured.script != name_of_script(grains.script))
      faults.push_back(fmt::format(
          "{} was measured under another contact law than {} has; measure with this script, or give a "
          "length",
          name, grains.script_name));
    if (faults.empty()) return measured;
    for (const std::string& one : faults) fault(one);
  } catch (const InputError& error) {
    for (const Fault& one : error.faults()) fault(fmt::format("{}:{}: {}", name, one.line, one.message));
  }
  return std::nullopt;
}

}  // namespace polargrain::coupler
