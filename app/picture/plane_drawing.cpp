// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/plane_drawing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "app/page/page.hpp"
#include "app/picture/symbols.hpp"
#include "app/remarks/outline.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// From places on the mesh to places of the drawing, where down is positive.
struct Frame {
  Eigen::Vector2d least;
  Eigen::Vector2d size;
  double scale;

  explicit Frame(const fem::BoxAround<2>& box)
      : least(box.least), size(box.sides()), scale(kLongerSide / std::max(size.maxCoeff(), 1e-300)) {}
  [[nodiscard]] Eigen::Vector2d middle() const { return least + 0.5 * size; }
  [[nodiscard]] double width() const { return scale * size.x() + 2.0 * kMargin; }
  [[nodiscard]] double height() const { return scale * size.y() + 2.0 * kMargin; }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector2d& place) const {
    return {kMargin + scale * (place.x() - least.x()),
            kMargin + scale * (size.y() - (place.y() - least.y()))};
  }
};

/// A direction of the mesh as one of the drawing.
Eigen::Vector2d flipped(const Eigen::Vector2d& direction) {
  return {direction.x(), -direction.y()};
}

/// Mean outward normal of the edges of each node on the outline.
std::map<int, Eigen::Vector2d> normals_of(const std::vector<OutlineSide<2>>& edges) {
  std::map<int, Eigen::Vector2d> normals;
  for (const OutlineSide<2>& edge : edges)
    for (const int node : edge.nodes) {
      auto& normal = normals.try_emplace(node, Eigen::Vector2d::Zero()).first->second;
      normal += edge.size * edge.normal;
    }
  for (auto& [node, normal] : normals)
    if (normal.norm() > 0.0) normal.normalize();
  return normals;
}

/// The symbols of one place at one of its nodes.
std::string symbols_at(const PlaceConditions<2>& place, const Eigen::Vector2d& at,
                       const Eigen::Vector2d& outward) {
  std::string drawn;
  const Eigen::Vector2d out = flipped(outward);
  if (place.held[0] && place.held[1]) {
    drawn += support(at, out, true);
  } else {
    for (int k = 0; k < 2; ++k) {
      if (!place.held[static_cast<std::size_t>(k)]) continue;
      const Eigen::Vector2d axis = Eigen::Vector2d::Unit(k) * (outward(k) < 0.0 ? -1.0 : 1.0);
      drawn += support(at, flipped(axis), false);
    }
  }
  if (place.held[2]) drawn += square(at);
  if (place.movement.norm() > 0.0) {
    const Eigen::Vector2d way = flipped(place.movement.normalized());
    // Behind the symbols of supports, and outside of the body where it moves inward.
    const Eigen::Vector2d from =
        at + (way.dot(out) > 0.0 ? 4.0 : kArrow + 4.0) * (way.dot(out) > 0.0 ? way : Eigen::Vector2d(-way));
    drawn += arrow(from, from + kArrow * way, kMovement);
  }
  if (place.pressed) {
    const Eigen::Vector2d outside = at + (kArrow + 4.0) * out;
    const Eigen::Vector2d inside = at + 4.0 * out;
    drawn += place.pressure_sign > 0.0 ? arrow(outside, inside, kLoad) : arrow(inside, outside, kLoad);
  }
  if (place.pull.norm() > 0.0) {
    const Eigen::Vector2d way = flipped(place.pull);
    const Eigen::Vector2d from = at + 6.0 * out - (way.dot(out) < -0.1 ? kArrow : 0.0) * way;
    drawn += arrow(from, from + kArrow * way, kLoad);
  }
  return drawn;
}

/// Free water: its surface beside the place, and arrows where it presses on the outline below that.
std::string water_drawn(const PlaceConditions<2>& place, const Scene& scene, const Frame& frame,
                        const std::map<int, Eigen::Vector2d>& normals) {
  std::string drawn;
  double left = HUGE_VAL;
  double right = -HUGE_VAL;
  std::vector<Eigen::Vector2d> taken;
  for (const int node : place.nodes) {
    const Eigen::Vector2d& position = scene.mesh().nodes[static_cast<std::size_t>(node)];
    const Eigen::Vector2d at = frame.at(position);
    left = std::min(left, at.x());
    right = std::max(right, at.x());
    const auto normal = normals.find(node);
    const auto is_near = [&](const Eigen::Vector2d& other) { return (at - other).norm() < kSpacing; };
    if (normal == normals.end() || position.y() >= *place.water_level || std::ranges::any_of(taken, is_near))
      continue;
    taken.push_back(at);
    const Eigen::Vector2d out = flipped(normal->second);
    drawn += arrow(at + (kArrow + 4.0) * out, at + 4.0 * out, kWater);
  }
  // A level far above the body is shown at the edge of the drawing: the table has its value.
  constexpr double kEdge = 14.0;
  const double height =
      std::clamp(frame.at({frame.least.x(), *place.water_level}).y(), kEdge, frame.height() - kEdge);
  return drawn + water_surface({left - kArrow, height}, {right + kArrow, height});
}

std::string symbols_of(const PlaceConditions<2>& place, const Scene& scene, const Frame& frame) {
  std::map<int, Eigen::Vector2d> normals;
  if (place.is_boundary) normals = normals_of(sides_of(scene.mesh(), place.name));
  const Eigen::Vector2d middle = frame.middle();
  std::string drawn;
  if (place.water_level) drawn += water_drawn(place, scene, frame, normals);
  std::vector<Eigen::Vector2d> taken;
  for (const int node : place.nodes) {
    const Eigen::Vector2d& position = scene.mesh().nodes[static_cast<std::size_t>(node)];
    const Eigen::Vector2d at = frame.at(position);
    const auto is_near = [&](const Eigen::Vector2d& other) { return (at - other).norm() < kSpacing; };
    if (std::ranges::any_of(taken, is_near)) continue;
    taken.push_back(at);
    Eigen::Vector2d outward = position - middle;
    if (const auto found = normals.find(node); found != normals.end()) outward = found->second;
    drawn += symbols_at(place, at, outward.norm() > 0.0 ? outward.normalized() : Eigen::Vector2d(0.0, -1.0));
  }
  return drawn;
}

std::string elements_drawn(const Scene& scene, const Frame& frame) {
  std::string drawn;
  for (std::size_t r = 0; r < scene.regions().size(); ++r) {
    drawn += fmt::format("<g fill='{}' stroke='#777' stroke-width='.6'>\n",
                         kRegionColours[r % kRegionColours.size()]);
    for (const int number : scene.regions()[r].elements) {
      const fem::Element<2>& element = scene.mesh().elements[static_cast<std::size_t>(number)];
      std::string corners;
      for (int k = 0; k < element.type->corners; ++k) {
        const int node = element.nodes[static_cast<std::size_t>(k)];
        corners += (k > 0 ? " " : "") + point(frame.at(scene.mesh().nodes[static_cast<std::size_t>(node)]));
      }
      drawn += fmt::format("<polygon points='{}'/>\n", corners);
    }
    drawn += "</g>\n";
  }
  return drawn;
}

std::string edges_drawn(const Scene& scene, const Frame& frame, const std::string& boundary,
                        const char* style) {
  std::string path;
  for (const OutlineSide<2>& edge : sides_of(scene.mesh(), boundary)) {
    const auto& nodes = scene.mesh().nodes;
    path += fmt::format("M{}L{}", point(frame.at(nodes[static_cast<std::size_t>(edge.nodes[0])])),
                        point(frame.at(nodes[static_cast<std::size_t>(edge.nodes[1])])));
  }
  return path.empty() ? path : fmt::format("<path d='{}' fill='none' {}/>\n", path, style);
}

std::string weight_drawn(const Scene& scene, const Frame& frame) {
  std::string drawn;
  const Eigen::Vector2d middle = frame.middle();
  for (const fem::BodyLoad<2>& load : scene.problem().body_loads) {
    const Eigen::Vector2d force = load.density(middle).head<2>();
    if (!(force.norm() > 0.0)) continue;
    const Eigen::Vector2d from = frame.at(middle);
    drawn += arrow(from, from + 1.4 * kArrow * flipped(force.normalized()), kLoad);
  }
  return drawn;
}

/// The names of boundaries, inside of the body beside the middle of each.
std::string names_drawn(const std::vector<PlaceConditions<2>>& places, const Scene& scene,
                        const Frame& frame) {
  std::string drawn;
  for (const PlaceConditions<2>& place : places) {
    const std::vector<OutlineSide<2>> edges =
        place.is_boundary ? sides_of(scene.mesh(), place.name) : std::vector<OutlineSide<2>>{};
    if (edges.empty()) continue;
    const OutlineSide<2>& edge = edges[edges.size() / 2];
    const Eigen::Vector2d at = frame.at(edge.centre) - 12.0 * flipped(edge.normal);
    const char* const anchor = edge.normal.x() > 0.5 ? "end" : edge.normal.x() < -0.5 ? "start" : "middle";
    drawn += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", at.x(), at.y() + 4.0,
                         anchor, escaped(place.name));
  }
  return drawn;
}

}  // namespace

std::string plane_drawing(const Scene& scene, const std::vector<PlaceConditions<2>>& places) {
  const Frame frame(fem::box_around(scene.mesh()));
  std::string drawn = elements_drawn(scene, frame);
  // An edge without a name, or with a name and no condition, is free: that is where a base is forgotten.
  const std::string free_style = fmt::format("stroke='{}' stroke-width='3' stroke-dasharray='7 5'", kFree);
  drawn += edges_drawn(scene, frame, "", free_style.c_str());
  for (const PlaceConditions<2>& place : places)
    if (place.is_boundary)
      drawn += edges_drawn(scene, frame, place.name,
                           place.is_free() ? free_style.c_str() : "stroke='#222' stroke-width='2.5'");
  for (const PlaceConditions<2>& place : places) drawn += symbols_of(place, scene, frame);
  drawn += weight_drawn(scene, frame) + names_drawn(places, scene, frame) +
           scale_bar(frame.size.maxCoeff(), frame.scale, frame.height());
  return fmt::format(
      "<figure class='grains scene'>\n<div><svg viewBox='0 0 {0:.0f} {1:.0f}' style='min-width:{2:.0f}px' role='img' aria-label='mesh, supports and loads' "
      "font-size='14' font-weight='bold' fill='#222'>\n{3}</svg></div>\n<figcaption><span class='held'>&#9650; held</span> (filled: "
      "both displacements; a square: the micro-rotation), <span class='moved'>&#10140; moved</span>, <span "
      "class='loaded'>&#10140; loaded</span>, <span style='color:#3b8bc2'>&#9661; free water</span>, <span class='free'>&#9476; free</span>. Arrows show directions alone.</figcaption>\n"
      "</figure>\n",
      frame.width(), frame.height(), kLeastScale * frame.width(), drawn);
}

}  // namespace polargrain::app
