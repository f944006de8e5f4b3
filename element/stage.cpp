// SPDX-License-Identifier: GPL-2.0-or-later
#include "element/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace polargrain::element {
namespace {

/// 0, +1, -1 and back to 0 over each unit of its argument.
double wave(double turns) {
  const double part = turns - std::floor(turns);
  if (part <= 0.25) return 4.0 * part;
  return part <= 0.75 ? 2.0 - 4.0 * part : 4.0 * part - 4.0;
}

std::string why_not(Room room, const Constraint& constraint, int place) {
  const char* const name = kPlaceNames[static_cast<std::size_t>(place)];
  if (room == Room::discs)
    return fmt::format(
        "{}: discs neither move out of their plane nor have a stress there ({}); leave it out, or take "
        "a packing of spheres (dimension: 3)",
        constraint.name, name);
  return fmt::format("{}: the material is of plane strain and has no such component ({}); leave it out",
                     constraint.name, name);
}

/// The normal components that no constraint of its own prescribes.
std::vector<int> open_normals(const Stage& stage, Room room) {
  std::vector<int> open;
  for (const int place : {k11, k22, k33})
    if (can_strain(room, place) &&
        std::ranges::none_of(stage.constraints, [place](const auto& c) { return c.place == place; }))
      open.push_back(place);
  return open;
}

}  // namespace

Constraint component(Constraint::Kind kind, int place, Constraint::Way way, double amount) {
  Constraint made;
  made.kind = kind;
  made.way = way;
  made.place = place;
  made.weights(place) = 1.0;
  made.amount = amount;
  made.name = (kind == Constraint::Kind::stress ? "s" : "e") +
              std::string(kPlaceNames[static_cast<std::size_t>(place)]);
  return made;
}

Constraint sum_of_stresses(const std::string& name, const Vector6& weights, Constraint::Way way,
                           double amount) {
  Constraint made;
  made.kind = Constraint::Kind::stress;
  made.way = way;
  made.weights = weights;
  made.amount = amount;
  made.name = name;
  return made;
}

Constraint constant_volume() {
  Constraint made;
  made.kind = Constraint::Kind::volume;
  made.name = "volume";
  return made;
}

Vector6 weights_of_pressure(Room room) {
  Vector6 weights = Vector6::Zero();
  if (tells_stress(room, k33))
    weights.head<3>().setConstant(-1.0 / 3.0);
  else
    weights.head<2>().setConstant(-0.5);
  return weights;
}

Vector6 weights_of_deviator(Room room) {
  Vector6 weights = Vector6::Zero();
  weights(k22) = -1.0;
  weights(k11) = 1.0;
  if (can_strain(room, k33)) weights(k11) = weights(k33) = 0.5;
  return weights;
}

std::vector<std::string> faults(const Stage& stage, Room room) {
  std::vector<std::string> found;
  std::vector<std::string> sums;
  for (std::size_t k = 0; k < stage.constraints.size(); ++k) {
    const Constraint& one = stage.constraints[k];
    if (one.place < 0) sums.push_back(one.name);
    for (int place = 0; place < 6; ++place) {
      if (one.weights(place) == 0.0) continue;
      const bool there =
          one.kind == Constraint::Kind::stress ? tells_stress(room, place) : can_strain(room, place);
      // A stress that is told but cannot be changed by a strain of its own cannot be prescribed by itself either.
      if (!there || (one.place >= 0 && !can_strain(room, place))) {
        found.push_back(why_not(room, one, place));
        break;
      }
    }
    for (std::size_t other = 0; other < k; ++other) {
      const Constraint& before = stage.constraints[other];
      if (one.place < 0 ? one.name == before.name : one.place == before.place)
        found.push_back(fmt::format("{}: the component is prescribed twice, as {} too; leave one of them out",
                                    one.name, before.name));
    }
  }
  if (!found.empty() || sums.empty()) return found;
  const std::vector<int> open = open_normals(stage, room);
  if (open.size() != sums.size()) {
    std::vector<std::string> names;
    for (const int place : open) names.emplace_back(kPlaceNames[static_cast<std::size_t>(place)]);
    found.push_back(fmt::format(
        "{}: {} for {} normal component{} that no other key prescribes ({}); each needs one condition, so {}",
        fmt::join(sums, ", "), sums.size() == 1 ? "one condition" : fmt::format("{} conditions", sums.size()),
        open.size(), open.size() == 1 ? "" : "s",
        names.empty() ? "none" : fmt::format("{}", fmt::join(names, ", ")),
        open.size() > sums.size() ? "prescribe a strain or a stress of the others" : "leave one out"));
  }
  return found;
}

Stage completed(Stage stage, Room room) {
  const bool has_sums =
      std::ranges::any_of(stage.constraints, [](const Constraint& c) { return c.place < 0; });
  for (int place = 0; place < 6; ++place) {
    if (!can_strain(room, place) || (place <= k33 && has_sums)) continue;
    if (std::ranges::none_of(stage.constraints, [place](const auto& c) { return c.place == place; }))
      stage.constraints.push_back(component(Constraint::Kind::strain, place, Constraint::Way::hold));
  }
  return stage;
}

bool extends(const Stage& stage, bool before) {
  for (const Constraint& constraint : stage.constraints) {
    if (constraint.way != Constraint::Way::reach || constraint.amount == 0.0) continue;
    const bool is_stress = constraint.kind == Constraint::Kind::stress;
    const bool is_deviator = is_stress && constraint.weights(k22) < 0.0 && constraint.weights(k11) > 0.0;
    if (is_deviator) return constraint.amount < 0.0;
    if (!is_stress && constraint.place == k22) return constraint.amount > 0.0;
  }
  return before;
}

bool drives_shear(const Stage& stage) {
  return std::ranges::any_of(stage.constraints, [](const Constraint& constraint) {
    const bool moves = constraint.way == Constraint::Way::reach || constraint.way == Constraint::Way::cycle;
    return constraint.place >= k12 && moves && constraint.amount != 0.0;
  });
}

double target(const Constraint& constraint, int cycles, double start, double t) {
  switch (constraint.way) {
    case Constraint::Way::hold:
      break;
    case Constraint::Way::reach:
      return t == 1.0 ? constraint.amount : start + (constraint.amount - start) * t;
    case Constraint::Way::cycle:
      return start + constraint.amount * wave(cycles * t);
    case Constraint::Way::scale:
      return start * (1.0 + (constraint.amount - 1.0) * t);
  }
  return start;
}

}  // namespace polargrain::element
