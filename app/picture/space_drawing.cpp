// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/space_drawing.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "app/page/page.hpp"
#include "app/picture/symbols.hpp"

namespace polargrain::app {
namespace {

/// A parallel projection: where a place of the body is on the drawing, down positive.
class View {
 public:
  /// @param towards the eye, not upright
  View(const Eigen::Vector3d& towards, const fem::Mesh<3>& mesh) : towards_(towards.normalized()) {
    right_ = Eigen::Vector3d::UnitZ().cross(towards_).normalized();
    up_ = towards_.cross(right_);
    Eigen::Vector2d least = flat(mesh.nodes.front());
    Eigen::Vector2d most = least;
    for (const Eigen::Vector3d& node : mesh.nodes) {
      least = least.cwiseMin(flat(node));
      most = most.cwiseMax(flat(node));
    }
    origin_ = least;
    size_ = most - least;
    scale_ = 0.75 * kLongerSide / std::max(size_.maxCoeff(), 1e-300);
  }
  [[nodiscard]] double width() const { return scale_ * size_.x() + 2.0 * kMargin; }
  [[nodiscard]] double height() const { return scale_ * size_.y() + 2.0 * kMargin; }
  [[nodiscard]] double extent() const { return size_.maxCoeff(); }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] Eigen::Vector2d at(const Eigen::Vector3d& place) const {
    const Eigen::Vector2d on = flat(place) - origin_;
    return {kMargin + scale_ * on.x(), kMargin + scale_ * (size_.y() - on.y())};
  }
  /// A direction of the body as one of the drawing, of length one.
  [[nodiscard]] Eigen::Vector2d way(const Eigen::Vector3d& direction) const {
    const Eigen::Vector2d on = flat(direction);
    return Eigen::Vector2d(on.x(), -on.y()).normalized();
  }
  [[nodiscard]] double depth(const Eigen::Vector3d& place) const { return towards_.dot(place); }
  [[nodiscard]] bool sees(const Eigen::Vector3d& normal) const { return towards_.dot(normal) > 1e-6; }

 private:
  [[nodiscard]] Eigen::Vector2d flat(const Eigen::Vector3d& place) const {
    return {right_.dot(place), up_.dot(place)};
  }
  Eigen::Vector3d towards_, right_, up_;
  Eigen::Vector2d origin_, size_;
  double scale_ = 1.0;
};

/// Mean outward normal of each node of the outer faces, and whether the view sees one of its faces.
struct OuterNode {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  bool is_seen = false;
};

std::string faces_drawn(const fem::Mesh<3>& mesh, const std::vector<SceneRegion>& regions,
                        const std::vector<OutlineSide<3>>& faces, const std::set<std::string>& free,
                        const View& view) {
  std::map<int, std::size_t> region_of;
  for (std::size_t r = 0; r < regions.size(); ++r)
    for (const int element : regions[r].elements) region_of.emplace(element, r);
  std::vector<const OutlineSide<3>*> seen;
  for (const OutlineSide<3>& face : faces)
    if (view.sees(face.normal)) seen.push_back(&face);
  std::ranges::stable_sort(seen, [&](const OutlineSide<3>* a, const OutlineSide<3>* b) {
    return view.depth(a->centre) < view.depth(b->centre);
  });
  std::string drawn;
  for (const OutlineSide<3>* const face : seen) {
    std::string corners;
    for (const int node : face->corners)
      corners += (corners.empty() ? "" : " ") + point(view.at(mesh.nodes[static_cast<std::size_t>(node)]));
    const bool is_free =
        std::ranges::all_of(face->names, [&](const std::string& name) { return free.contains(name); });
    const auto region = region_of.find(face->element);
    drawn +=
        fmt::format("<polygon points='{}' fill='{}' stroke='{}' stroke-width='{}'/>\n", corners,
                    kRegionColours[(region == region_of.end() ? 5 : region->second) % kRegionColours.size()],
                    is_free ? kFree : "#777", is_free ? "1.5" : ".6");
  }
  return drawn;
}

/// The symbols of one place at one of its nodes.
std::string symbols_at(const PlaceConditions<3>& place, const Eigen::Vector2d& at,
                       const Eigen::Vector3d& outward, const View& view) {
  std::string drawn;
  const Eigen::Vector2d out = view.way(outward);
  if (place.held[0] && place.held[1] && place.held[2]) {
    drawn += support(at, out, true);
  } else {
    for (int k = 0; k < 3; ++k) {
      if (!place.held[static_cast<std::size_t>(k)]) continue;
      drawn += support(at, view.way(Eigen::Vector3d::Unit(k) * (outward(k) < 0.0 ? -1.0 : 1.0)), false);
    }
  }
  if (place.held[3] || place.held[4] || place.held[5]) drawn += square(at);
  const auto outside = [&](const Eigen::Vector3d& direction, double distance) -> Eigen::Vector2d {
    // Arrows that point into the body end at it.
    const Eigen::Vector2d way = view.way(direction);
    return at + (direction.dot(outward) < -1e-3 ? -(kArrow + distance) * way : distance * way);
  };
  if (place.movement.norm() > 0.0) {
    const Eigen::Vector2d from = outside(place.movement, 4.0);
    drawn += arrow(from, from + kArrow * view.way(place.movement), kMovement);
  }
  if (place.pressed) {
    const Eigen::Vector3d push = -place.pressure_sign * outward;
    const Eigen::Vector2d from = outside(push, 4.0);
    drawn += arrow(from, from + kArrow * view.way(push), kLoad);
  }
  if (place.pull.norm() > 0.0) {
    const Eigen::Vector2d from = outside(place.pull, 6.0);
    drawn += arrow(from, from + kArrow * view.way(place.pull), kLoad);
  }
  return drawn;
}

/// Normals of a place at its nodes, from its own faces where it has faces.
std::map<int, OuterNode> outer_nodes(const std::vector<OutlineSide<3>>& faces, const std::string& name,
                                     const View& view) {
  std::map<int, OuterNode> nodes;
  for (const OutlineSide<3>& face : faces) {
    if (!name.empty() && std::ranges::find(face.names, name) == face.names.end()) continue;
    for (const int node : face.corners) {
      nodes[node].normal += face.size * face.normal;
      if (view.sees(face.normal)) nodes[node].is_seen = true;
    }
  }
  return nodes;
}

std::string symbols_of(const PlaceConditions<3>& place, const fem::Mesh<3>& mesh,
                       const std::vector<OutlineSide<3>>& faces, const View& view) {
  const std::map<int, OuterNode> outer = outer_nodes(faces, place.is_boundary ? place.name : "", view);
  std::string drawn;
  std::vector<Eigen::Vector2d> taken;
  const double apart =
      place.is_boundary ? 2.0 * kSpacing : kSpacing;  // a face has far more nodes than an edge
  for (const int node : place.nodes) {
    const auto found = outer.find(node);
    if (found == outer.end() || !found->second.is_seen) continue;
    const Eigen::Vector2d at = view.at(mesh.nodes[static_cast<std::size_t>(node)]);
    const auto is_near = [&](const Eigen::Vector2d& other) { return (at - other).norm() < apart; };
    if (std::ranges::any_of(taken, is_near)) continue;
    taken.push_back(at);
    drawn += symbols_at(place, at, found->second.normal.normalized(), view);
  }
  return drawn;
}

/// The name of each boundary in the middle of what is seen of it.
std::string names_drawn(const std::vector<PlaceConditions<3>>& places,
                        const std::vector<OutlineSide<3>>& faces, const View& view) {
  std::string drawn;
  for (const PlaceConditions<3>& place : places) {
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    double area = 0.0;
    for (const OutlineSide<3>& face : faces) {
      if (!view.sees(face.normal) || std::ranges::find(face.names, place.name) == face.names.end()) continue;
      sum += face.size * face.centre;
      area += face.size;
    }
    if (area == 0.0) continue;
    const Eigen::Vector2d at = view.at(sum / area);
    drawn += fmt::format(
        "<text x='{:.1f}' y='{:.1f}' text-anchor='middle' fill='{}' stroke='#fff' stroke-width='4' "
        "paint-order='stroke'>{}</text>\n",
        at.x(), at.y() + 5.0, place.is_free() ? kFree : "#222", escaped(place.name));
  }
  return drawn;
}

std::string axes_drawn(const View& view) {
  const Eigen::Vector2d origin(view.width() - 60.0, view.height() - 50.0);
  std::string drawn;
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector2d way = view.way(Eigen::Vector3d::Unit(k));
    const Eigen::Vector2d name = origin + 46.0 * way;
    drawn += arrow(origin, origin + 34.0 * way, "#222") +
             fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='middle'>x{}</text>\n", name.x(),
                         name.y() + 5.0, k + 1);
  }
  return drawn;
}

std::string figure(const fem::Mesh<3>& mesh, const std::vector<SceneRegion>& regions,
                   const std::vector<PlaceConditions<3>>& places, const std::vector<OutlineSide<3>>& faces,
                   const Eigen::Vector3d& towards, const char* caption) {
  const View view(towards, mesh);
  std::set<std::string> free;
  for (const PlaceConditions<3>& place : places)
    if (place.is_free()) free.insert(place.name);
  std::string drawn = faces_drawn(mesh, regions, faces, free, view);
  for (const PlaceConditions<3>& place : places) drawn += symbols_of(place, mesh, faces, view);
  drawn += names_drawn(places, faces, view) + axes_drawn(view) +
           scale_bar(view.extent(), view.scale(), view.height());
  return fmt::format(
      "<figure class='grains scene'>\n<div><svg viewBox='0 0 {0:.0f} {1:.0f}' style='min-width:{2:.0f}px' role='img' "
      "aria-label='mesh, supports and loads, {4}' font-size='14' font-weight='bold' fill='#222'>\n{3}</svg></div>\n"
      "<figcaption>{4}: <span class='held'>&#9650; held</span> (filled: all displacements; a square: "
      "micro-rotations), <span class='moved'>&#10140; moved</span>, <span class='loaded'>&#10140; loaded</span>, <span "
      "class='free'>free</span>. Arrows show directions alone.</figcaption>\n</figure>\n",
      view.width(), view.height(), kLeastScale * view.width(), drawn, caption);
}

}  // namespace

std::string space_drawing(const fem::Mesh<3>& mesh, const std::vector<SceneRegion>& regions,
                          const std::vector<PlaceConditions<3>>& places) {
  const std::vector<OutlineSide<3>> faces = outline_of(mesh);
  const Eigen::Vector3d before(0.55, -0.85, 0.5);
  return figure(mesh, regions, places, faces, before, "From the front, right and above") +
         figure(mesh, regions, places, faces, -before, "From behind, left and below");
}

}  // namespace polargrain::app
