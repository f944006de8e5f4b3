// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/measured_interface.hpp"

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "coupler/case/section.hpp"

namespace polargrain::coupler {
namespace {

/// Written with six digits.
constexpr double kSameRoughness = 1e-5;

MeasuredWall read_wall(const Entry& entry, Faults& faults) {
  Section section(entry, "wall", faults);
  MeasuredWall wall;
  wall.roughness = section.quantity("roughness", Dimension::number, Limit::positive);
  const auto friction = section.pairs("friction", Dimension::length, Dimension::number, Limit::not_negative);
  const auto opening = section.pairs("opening", Dimension::length, Dimension::length, Limit::any);
  wall.turning = section.quantity("turning", Dimension::number, Limit::any);
  // How sure it is, is for people.
  for (const char* const note : {"friction_interval", "turning_interval", "peak", "end"}) section.find(note);
  if (!friction.empty() && friction.front().first != 0.0)
    section.fault("friction", "friction: the first pair must be at a slip of 0");
  const auto slip = [](const auto& pair) { return pair.first; };
  if (!std::ranges::equal(friction, opening, {}, slip, slip)) {
    section.fault("opening", "opening: must be at the slips of 'friction'");
  } else {
    for (std::size_t k = 0; k < friction.size(); ++k)
      wall.curve.push_back({friction[k].first, friction[k].second, opening[k].second});
  }
  section.finish();
  return wall;
}

}  // namespace

const MeasuredWall* MeasuredInterface::wall(double roughness) const {
  const auto found = std::ranges::find_if(walls, [roughness](const MeasuredWall& wall) {
    return std::abs(wall.roughness - roughness) <= kSameRoughness * roughness;
  });
  return found == walls.end() ? nullptr : &*found;
}

std::set<std::string> of_materials_with_packing(const Entry* materials, const std::string& key,
                                                const std::string& packing) {
  std::set<std::string> texts;
  if (materials == nullptr) return texts;
  for (const Entry::Member& material : materials->members) {
    const Entry* const grains = material.value.find("packing");
    const Entry* const value = material.value.find(key);
    if (grains != nullptr && value != nullptr && (packing.empty() || grains->text == packing))
      texts.insert(value->text);
  }
  return texts;
}

std::string packing_of_interface(const Entry& interface, const Entry* materials) {
  if (const Entry* const given = interface.find("packing")) return given->text;
  const std::set<std::string> packings = of_materials_with_packing(materials, "packing");
  return packings.size() == 1 ? *packings.begin() : std::string();
}

std::filesystem::path interface_file_of(const std::filesystem::path& packing) {
  return std::filesystem::path(packing).replace_extension(".interface.yaml");
}

MeasuredInterface read_measured_interface(const std::filesystem::path& file) {
  const Entry document = load_document(file);
  Faults faults;
  Section section(document, "measured interface", faults);
  MeasuredInterface measured;
  measured.mean_diameter = section.quantity("mean_diameter", Dimension::length, Limit::positive);
  measured.script = section.text("script", "the name of a contact law");
  for (const char* const note : {"pressure", "boxes", "height"}) section.find(note);
  if (const Entry* const walls = section.require("walls", "a list of walls by their roughness")) {
    for (const Entry& wall : walls->items) measured.walls.push_back(read_wall(wall, faults));
    if (walls->items.empty()) section.fault("walls", "walls: expected at least one wall");
  }
  for (MeasuredWall& wall : measured.walls) wall.mean_diameter = measured.mean_diameter;
  section.finish();
  if (!faults.empty()) throw InputError(faults);
  return measured;
}

}  // namespace polargrain::coupler
