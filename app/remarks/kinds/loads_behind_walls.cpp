// SPDX-License-Identifier: GPL-2.0-or-later
// Loads on ground that an interface parts from a wall: they push the ground off the wall, not the wall.
#include <fmt/format.h>

#include <algorithm>

#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

using coupler::Entry;

bool names(const Entry& on, const std::string& boundary) {
  return on.text == boundary ||
         std::ranges::any_of(on.items, [&](const Entry& word) { return word.text == boundary; });
}

void look_at(const Entry& item, const std::string& boundary, const std::string& interface,
             const std::string& wall, Remarks& remarks) {
  const Entry* const on = item.find("on");
  if (on == nullptr || !names(*on, boundary)) return;
  for (const char* const key : {"free_water", "pressure", "traction"}) {
    const Entry* const value = item.find(key);
    if (value == nullptr) continue;
    const bool is_water = std::string(key) == "free_water";
    remarks.push_back(
        {is_water ? Rank::wrong : Rank::doubtful, 2.0,
         value->fault(fmt::format(
             "boundary: '{}' at '{}' presses on the ground, between it and '{}': interface '{}' lies there",
             key, boundary, wall, interface)),
         is_water
             ? fmt::format("for water outside name the wall, 'on: {}'; for the pores of the ground give "
                           "'water_level'",
                           wall)
             : fmt::format("for a load on the wall name it, 'on: {}' with 'node_force', or move it", wall)});
  }
}

/// The beam along a curve. Without a beam the interface: a rigid body has its name.
std::string wall_on(const Scene& scene, const std::string& curve, const std::string& interface) {
  if (const Entry* const beams = scene.find({"beams"}))
    for (const Entry::Member& beam : beams->members)
      if (const Entry* const on = beam.value.find("on"); on != nullptr && on->text == curve) return beam.key;
  return interface;
}

}  // namespace

void loads_behind_walls(const Scene& scene, Remarks& remarks) {
  const Entry* const interfaces = scene.find({"interfaces"});
  if (interfaces == nullptr) return;
  std::vector<const Entry*> lists{scene.find({"boundary"})};
  if (const Entry* const stages = scene.find({"steps", "stages"}))
    for (const Entry& stage : stages->items) lists.push_back(stage.find("boundary"));
  for (const Entry::Member& interface : interfaces->members) {
    const Entry* const on = interface.value.find("on");
    const bool is_outline = on != nullptr && scene.with_problem([&](const auto& problem) {
      return problem.mesh.boundaries.contains(on->text);
    });
    if (!is_outline) continue;
    const std::string wall = wall_on(scene, on->text, interface.key);
    for (const Entry* const list : lists)
      if (list != nullptr)
        for (const Entry& item : list->items) look_at(item, on->text, interface.key, wall, remarks);
  }
}

}  // namespace polargrain::app
