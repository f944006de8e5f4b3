// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/measured_length.hpp"

#include <fmt/format.h>

#include <span>
#include <sstream>

#include "common/state.hpp"
#include "coupler/case/section.hpp"
#include "grains_io/script.hpp"

namespace polargrain::coupler {

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
  measured.mean_diameter = section.quantity("mean_diameter", Dimension::length, Limit::positive);
  measured.script = section.text("script", "the name of a contact law");
  // How it was found is for people.
  for (const char* const note : {"lc_interval", "lp_interval", "layers", "cells", "at_edge"})
    section.find(note);
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  return measured;
}

}  // namespace polargrain::coupler
