// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/models/cell_definition.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "common/error.hpp"
#include "coupler/case/contact_library.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_length.hpp"
#include "coupler/case/models/cell_control_keys.hpp"
#include "coupler/case/script_scene.hpp"

namespace polargrain::coupler {
namespace {

/// The path of the packing; empty, with a fault, when no file is there.
std::filesystem::path packing_file(Section& section, const std::filesystem::path& directory) {
  const std::string name = section.text("packing", "the path of a packing (CSV or HDF5)");
  if (name.empty()) return {};
  const auto file = find_data_file(name, directory);
  const std::string ending = std::filesystem::path(name).extension().string();
  if (ending == ".yaml" || ending == ".yml") {
    section.fault(
        "packing",
        fmt::format(
            "packing: '{0}' is the specification of a packing; make the packing of it, polargrain pack "
            "{0} -o {1}, and name that",
            name, std::filesystem::path(name).replace_extension(".h5").string()));
    return {};
  }
  if (file) return *file;
  section.fault(
      "packing",
      fmt::format("packing: there is no file '{}', neither beside the case nor below liggghts_inputs/; "
                  "correct the path or put the file there",
                  name));
  return {};
}

/// `lc: measured`: the lengths that polargrain layer has written beside the packing.
void take_measured_length(Section& section, const CellDefinition& definition, const CaseFiles& files,
                          CosseratChoice& choice) {
  choice.internal_length = 1.0;  // fit for reading on
  const Entry* const packing = section.find("packing");
  const auto place = packing == nullptr ? std::nullopt : find_data_file(packing->text, files.directory);
  if (!place || definition.packing.grains.empty()) return;  // is a fault already
  const auto fault = [&section](const std::string& text) { section.fault("lc", "lc: measured: " + text); };
  const auto measured = length_beside({*place, packing->text, 2.0 * definition.packing.mean_radius(),
                                       definition.script, definition.script_file},
                                      fault);
  if (!measured) return;
  choice.internal_length = measured->internal_length;
  // Lengths that were measured without a limit go without one.
  choice.plastic_length = {measured->plastic_length, !measured->plastic_length};
}

/// A limit: a value, `none`, or what the packing has, which is the default.
LimitChoice read_limit(Section& section, const char* key, Dimension dimension, Limit limit) {
  const Entry* const entry = section.find(key);
  if (entry == nullptr) return {};
  const auto value = section.quantity_or_word(key, dimension, limit, {"from packing", "none"});
  return {value, !value && entry->text == "none"};
}

CosseratChoice read_cosserat_choice(Section& section, const CellDefinition& definition,
                                    const CaseFiles& files) {
  const auto modulus = [&section](const char* key) -> std::optional<double> {
    return section.quantity_or_word(key, Dimension::pressure, Limit::positive, {"from packing"});
  };
  CosseratChoice choice;
  if (section.find("G") != nullptr) choice.shear_modulus = modulus("G");
  if (section.find("Gc") != nullptr) choice.cosserat_shear_modulus = modulus("Gc");
  // A classical continuum has no curvature: its length is of no effect.
  const Entry* const length = section.find("lc");
  if (length != nullptr && length->text == "measured")
    take_measured_length(section, definition, files, choice);
  else if (files.cosserat || length != nullptr)
    choice.internal_length =
        section.quantity_or_word("lc", Dimension::length, Limit::positive, {"from packing", "measured"});
  if (section.find("lp") != nullptr)
    choice.plastic_length = read_limit(section, "lp", Dimension::length, Limit::positive);
  choice.skew_limit = read_limit(section, "skew_limit", Dimension::number, Limit::not_negative);
  // Nor has it skew stress: nothing is worth finding out.
  choice.has_rotations = files.cosserat;
  if (!files.cosserat) choice.skew_limit = choice.plastic_length = {.none = true};
  return choice;
}

/// Two answers to one question would be one too many: a cell that controls its rotations has a skew
/// stiffness, a couple modulus and limits of both.
void refuse_cosserat_parameters(Section& section) {
  for (const char* const key : {"G", "Gc", "lc", "lp", "skew_limit"}) {
    if (section.find(key) == nullptr) continue;
    section.fault(
        key, fmt::format("{0}: with 'rotations: controlled' the grains give the skew stress and the couple "
                         "stresses themselves; leave {0} out, or set 'rotations: free'",
                         key));
  }
}

}  // namespace

CellDefinition read_cell_definition(const std::string& material, Section& section, Faults& faults,
                                    const CaseFiles& files, const CellControl& defaults) {
  CellDefinition definition = read_cell_without_packing(material, section, faults, files, defaults);
  const auto packing = packing_file(section, files.directory);
  if (!packing.empty()) try {
      definition.packing = read_packing(packing);
      const std::vector<Fault> other =
          scene_faults(definition.script, definition.script_file, definition.packing.dimension);
      faults.insert(faults.end(), other.begin(), other.end());
      if (files.dimension == 3 && definition.packing.dimension != 3)
        section.fault("packing", "packing: elements in space need spheres, and this packing is of discs");
    } catch (const InputError& error) {
      faults.insert(faults.end(), error.faults().begin(), error.faults().end());
    }
  return definition;
}

CellDefinition read_cell_without_packing(const std::string& name, Section& section, Faults& faults,
                                         const CaseFiles& files, const CellControl& defaults) {
  CellDefinition definition;
  definition.name = name;
  definition.control = defaults;
  const CellScript script = read_cell_script("script", section, faults, files);
  definition.script_file = script.file;
  definition.script = script.text;
  definition.contact_library = read_contact_library(section, files);
  read_keys(section, definition.control);
  return definition;
}

bool read_controlled(Section& section, CellDefinition& definition) {
  if (section.choice_or("rotations", {"free", "controlled"}, "free") != "controlled") return false;
  definition.control.rotations = CellRotations::controlled;
  return true;
}

std::optional<CosseratChoice> read_rotations(Section& section, CellDefinition& definition,
                                             const CaseFiles& files) {
  if (!read_controlled(section, definition)) return read_cosserat_choice(section, definition, files);
  refuse_cosserat_parameters(section);
  return {};
}

}  // namespace polargrain::coupler
