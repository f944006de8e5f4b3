// SPDX-License-Identifier: GPL-2.0-or-later
// `friction: measured` of an interface: its packing, and errors where no measurement fits.
#include <fmt/format.h>

#include <cmath>

#include "common/error.hpp"
#include "common/packing.hpp"
#include "coupler/case/cell_script.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/measured_interface.hpp"
#include "coupler/case/measured_length.hpp"
#include "coupler/case/parts.hpp"

namespace polargrain::coupler {
namespace {

/// Sizes of grains may differ by so much, relative, from those that were measured.
constexpr double kSameGrainsOfWalls = 0.05;

}  // namespace

std::optional<MeasuredWall> read_measured_friction(Section& section, CaseParts& parts) {
  section.find("packing");
  const double roughness = section.quantity("roughness", Dimension::number, Limit::positive);
  for (const char* const key : {"dilation", "dilation_until"})
    if (section.find(key) != nullptr)
      section.fault(key, fmt::format("{}: comes with 'friction: measured'; leave it out", key));
  const std::string packing = packing_of_interface(section.entry(), parts.materials);
  if (packing.empty()) {
    section.fault("friction",
                  "friction: measured: on which grains? write 'packing: FILE', the packing of the grains; "
                  "it may be left out where all materials have one packing");
    return {};
  }
  const auto place = find_data_file(packing, parts.directory);
  if (!place) {
    section.fault(
        "packing",
        fmt::format("packing: there is no file '{}' beside the case; correct the path or put the file there",
                    packing));
    return {};
  }
  const std::filesystem::path file = interface_file_of(*place);
  const std::string name = file.filename().string();
  const std::string measure = fmt::format("polargrain interface SPEC.yaml --beside {}", packing);
  if (!std::filesystem::exists(file)) {
    section.fault("friction",
                  fmt::format("friction: measured: there is no {}; '{} --roughness {:g}' makes the "
                              "experiment and writes it, or give an angle",
                              name, measure, roughness));
    return {};
  }
  try {
    const MeasuredInterface measured = read_measured_interface(file);
    const double diameter = 2.0 * read_packing(*place).mean_radius();
    if (std::abs(measured.mean_diameter - diameter) > kSameGrainsOfWalls * diameter)
      section.fault("friction",
                    fmt::format("friction: measured: {} is of grains of {:.4g} mm, the grains of the packing "
                                "have {:.4g} mm; measure with these grains, or give an angle",
                                name, 1e3 * measured.mean_diameter, 1e3 * diameter));
    for (const std::string& script : of_materials_with_packing(parts.materials, "script", packing)) {
      const auto law = find_data_file(script, parts.directory);
      if (law && measured.script != name_of_script(text_of_script(*law)))
        section.fault("friction",
                      fmt::format("friction: measured: {} was measured under another contact law than {} "
                                  "has; measure with this script, or give an angle",
                                  name, script));
    }
    if (const MeasuredWall* const wall = measured.wall(roughness)) return *wall;
    std::vector<std::string> known;
    for (const MeasuredWall& wall : measured.walls) known.push_back(fmt::format("{:g}", wall.roughness));
    section.fault("roughness",
                  fmt::format("roughness: {:g} was not measured, {} has {}; take one of these, or measure "
                              "with '{} --roughness {:g}'",
                              roughness, name, listed(known), measure, roughness));
  } catch (const InputError& error) {
    for (const Fault& fault : error.faults())
      section.fault("friction",
                    fmt::format("friction: measured: {}:{}: {}", name, fault.line, fault.message));
  }
  return {};
}

}  // namespace polargrain::coupler
