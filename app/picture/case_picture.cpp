// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/case_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "app/page/page.hpp"
#include "app/picture/conditions.hpp"
#include "app/picture/packing_picture.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/remarks.hpp"

namespace polargrain::app {
namespace {

/// Units of the drawing: pixels at its full size.
constexpr double kLongerSide = 760.0;
constexpr double kLeastScale = 0.6;  ///< its words can still be read; a narrower page scrolls
constexpr double kMargin = 90.0;
constexpr double kArrow = 46.0;
constexpr double kSymbol = 11.0;
constexpr double kSpacing = 34.0;  ///< least, between symbols of one boundary

constexpr std::array<const char*, 6> kRegionColours{"#e9d8a6", "#b8d8ba", "#bcd4e6",
                                                    "#e6c1c1", "#d5c6e0", "#d9d9d9"};
constexpr const char* kSupport = "#1d6996";
constexpr const char* kMovement = "#0f8554";
constexpr const char* kLoad = "#c4432b";
constexpr const char* kFree = "#e17c05";

/// From places on the mesh to places of the drawing, where down is positive.
struct Frame {
  Eigen::Vector2d least;
  Eigen::Vector2d size;
  double scale;

  explicit Frame(const Body& body)
      : least(body.least), size(body.size()), scale(kLongerSide / std::max(size.maxCoeff(), 1e-300)) {}
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

std::string point(const Eigen::Vector2d& p) {
  return fmt::format("{:.1f},{:.1f}", p.x(), p.y());
}

/// All in units of the drawing.
std::string arrow(const Eigen::Vector2d& from, const Eigen::Vector2d& to, const char* colour) {
  const Eigen::Vector2d along = (to - from).normalized();
  const Eigen::Vector2d across(-along.y(), along.x());
  const Eigen::Vector2d neck = to - 9.0 * along;
  return fmt::format(
      "<path d='M{}L{}' stroke='{}' stroke-width='2'/><polygon points='{} {} {}' fill='{}'/>\n", point(from),
      point(neck), colour, point(to), point(neck + 4.0 * across), point(neck - 4.0 * across), colour);
}

/// A triangle whose tip is at the node, with the ground behind it.
std::string support(const Eigen::Vector2d& tip, const Eigen::Vector2d& outward, bool is_filled) {
  const Eigen::Vector2d across(-outward.y(), outward.x());
  const Eigen::Vector2d foot = tip + kSymbol * outward;
  const Eigen::Vector2d ground = foot + 3.0 * outward;
  return fmt::format(
      "<polygon points='{} {} {}' fill='{}' stroke='{}' stroke-width='1.5'/><path d='M{}L{}' stroke='{}' "
      "stroke-width='1.5'/>\n",
      point(tip), point(foot + 0.6 * kSymbol * across), point(foot - 0.6 * kSymbol * across),
      is_filled ? kSupport : "none", kSupport, point(ground + 0.8 * kSymbol * across),
      point(ground - 0.8 * kSymbol * across), kSupport);
}

/// Mean outward normal of the edges of each node on the outline.
std::map<int, Eigen::Vector2d> normals_of(const std::vector<OutlineEdge>& edges) {
  std::map<int, Eigen::Vector2d> normals;
  for (const OutlineEdge& edge : edges)
    for (const int node : edge.nodes) {
      auto& normal = normals.try_emplace(node, Eigen::Vector2d::Zero()).first->second;
      normal += edge.length * edge.normal;
    }
  for (auto& [node, normal] : normals)
    if (normal.norm() > 0.0) normal.normalize();
  return normals;
}

/// The symbols of one place at one of its nodes.
std::string symbols_at(const PlaceConditions& place, const Eigen::Vector2d& at,
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
  if (place.held[2])
    drawn += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='7' height='7' fill='{}'/>\n", at.x() - 3.5,
                         at.y() - 3.5, kSupport);
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

std::string symbols_of(const PlaceConditions& place, const Scene& scene, const Frame& frame) {
  std::map<int, Eigen::Vector2d> normals;
  if (place.is_boundary) normals = normals_of(edges_of(scene.mesh(), place.name));
  const Eigen::Vector2d middle = 0.5 * (scene.body().least + scene.body().largest);
  std::string drawn;
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
  for (const OutlineEdge& edge : edges_of(scene.mesh(), boundary)) {
    const auto& nodes = scene.mesh().nodes;
    path += fmt::format("M{}L{}", point(frame.at(nodes[static_cast<std::size_t>(edge.nodes[0])])),
                        point(frame.at(nodes[static_cast<std::size_t>(edge.nodes[1])])));
  }
  return path.empty() ? path : fmt::format("<path d='{}' fill='none' {}/>\n", path, style);
}

std::string weight_drawn(const Scene& scene, const Frame& frame) {
  std::string drawn;
  const Eigen::Vector2d middle = 0.5 * (scene.body().least + scene.body().largest);
  for (const fem::BodyLoad<2>& load : scene.problem().body_loads) {
    const Eigen::Vector2d force = load.density(middle).head<2>();
    if (!(force.norm() > 0.0)) continue;
    const Eigen::Vector2d from = frame.at(middle);
    drawn += arrow(from, from + 1.4 * kArrow * flipped(force.normalized()), kLoad);
  }
  return drawn;
}

/// The names of boundaries, inside of the body beside the middle of each.
std::string names_drawn(const std::vector<PlaceConditions>& places, const Scene& scene, const Frame& frame) {
  std::string drawn;
  for (const PlaceConditions& place : places) {
    const std::vector<OutlineEdge> edges =
        place.is_boundary ? edges_of(scene.mesh(), place.name) : std::vector<OutlineEdge>{};
    if (edges.empty()) continue;
    const OutlineEdge& edge = edges[edges.size() / 2];
    const Eigen::Vector2d at = frame.at(edge.centre) - 12.0 * flipped(edge.normal);
    const char* const anchor = edge.normal.x() > 0.5 ? "end" : edge.normal.x() < -0.5 ? "start" : "middle";
    drawn += fmt::format("<text x='{:.1f}' y='{:.1f}' text-anchor='{}'>{}</text>\n", at.x(), at.y() + 4.0,
                         anchor, escaped(place.name));
  }
  return drawn;
}

/// A length of 1, 2 or 5 times a power of ten, about a fifth of the drawing, with its value.
std::string scale_bar(const Frame& frame) {
  const double wanted = 0.2 * frame.size.maxCoeff();
  const double power = std::pow(10.0, std::floor(std::log10(wanted)));
  const double length = (wanted >= 5.0 * power ? 5.0 : wanted >= 2.0 * power ? 2.0 : 1.0) * power;
  const double y = frame.height() - 14.0;
  return fmt::format(
      "<path d='M{0:.1f} {1:.1f}h{2:.1f}M{0:.1f} {3:.1f}v8M{4:.1f} {3:.1f}v8' stroke='#222' "
      "stroke-width='2'/><text x='{5:.1f}' y='{6:.1f}'>{7}</text>\n",
      8.0, y, frame.scale * length, y - 4.0, 8.0 + frame.scale * length, 16.0 + frame.scale * length, y + 5.0,
      metres(length));
}

std::string drawing(const Scene& scene, const std::vector<PlaceConditions>& places) {
  const Frame frame(scene.body());
  std::string drawn = elements_drawn(scene, frame);
  // An edge without a name, or with a name and no condition, is free: that is where a base is forgotten.
  const std::string free_style = fmt::format("stroke='{}' stroke-width='3' stroke-dasharray='7 5'", kFree);
  drawn += edges_drawn(scene, frame, "", free_style.c_str());
  for (const PlaceConditions& place : places)
    if (place.is_boundary)
      drawn += edges_drawn(scene, frame, place.name,
                           place.is_free() ? free_style.c_str() : "stroke='#222' stroke-width='2.5'");
  for (const PlaceConditions& place : places) drawn += symbols_of(place, scene, frame);
  drawn += weight_drawn(scene, frame) + names_drawn(places, scene, frame) + scale_bar(frame);
  return fmt::format(
      "<figure class='grains scene'>\n<div><svg viewBox='0 0 {0:.0f} {1:.0f}' style='min-width:{2:.0f}px' role='img' aria-label='mesh, supports and loads' "
      "font-size='14' font-weight='bold' fill='#222'>\n{3}</svg></div>\n<figcaption><span class='held'>&#9650; held</span> (filled: "
      "both displacements; a square: the micro-rotation), <span class='moved'>&#10140; moved</span>, <span "
      "class='loaded'>&#10140; loaded</span>, <span class='free'>&#9476; free</span>. Arrows show directions alone.</figcaption>\n"
      "</figure>\n",
      frame.width(), frame.height(), kLeastScale * frame.width(), drawn);
}

std::string places_table(const Scene& scene, const std::vector<PlaceConditions>& places) {
  std::vector<TableRow> rows;
  const auto or_free = [](const std::string& words) { return words.empty() ? std::string("free") : words; };
  const auto or_nothing = [](const std::string& words) { return words.empty() ? std::string("-") : words; };
  const auto length_of = [&](const std::string& name) {
    double length = 0.0;
    for (const OutlineEdge& edge : edges_of(scene.mesh(), name)) length += edge.length;
    return length;
  };
  for (const PlaceConditions& place : places)
    rows.push_back(
        {{place.name, place.is_boundary ? fmt::format("{:.4g}", length_of(place.name)) : std::string("nodes"),
          fmt::format("{}", place.nodes.size()), or_free(place.supports), or_nothing(place.loads_at_start),
          or_nothing(place.loads_at_end)},
         place.is_free() ? "front" : ""});
  if (const double length = length_of(""); length > 0.0)
    rows.push_back({{"(no name)", fmt::format("{:.4g}", length), "-", "free", "-", "-"}, "front"});
  return table({"place", "length, m", "nodes", "held or moved", "load at the start", "load at the end"}, rows,
               TableOf::text);
}

std::string regions_table(const Scene& scene) {
  std::vector<TableRow> rows;
  for (const SceneRegion& region : scene.regions()) {
    const double pressure = Scene::pressure_of(region);
    rows.push_back({{region.name, region.material, fmt::format("{}", region.elements.size()),
                     region.cell != nullptr ? fmt::format("{}", region.cell->packing.grains.size()) : "-",
                     pressure > 0.0 ? fmt::format("{:.4g}", 1e-3 * pressure) : "-"}});
  }
  return table({"region", "material", "elements", "grains a cell", "pressure of the grains, kPa"}, rows,
               TableOf::text);
}

std::string packings(const Scene& scene) {
  std::string figures;
  std::vector<std::string> shown;
  for (const SceneRegion& region : scene.regions()) {
    if (region.cell == nullptr || std::ranges::find(shown, region.material) != shown.end()) continue;
    shown.push_back(region.material);
    const Packing& packing = region.cell->packing;
    figures +=
        packing_figure(packing, fmt::format("packing{}", shown.size()),
                       fmt::format("{}: {} {}, mean diameter {:.4g} mm, box {:.4g} by {:.4g} mm",
                                   region.material, packing.grains.size(),
                                   packing.dimension == 3 ? "spheres" : "discs", 2e3 * packing.mean_radius(),
                                   1e3 * packing.box.col(0).norm(), 1e3 * packing.box.col(1).norm()));
  }
  return figures.empty() ? figures : "<h2>Packings</h2>\n<div class='grid'>\n" + figures + "</div>\n";
}

std::string remarks_table(const Remarks& remarks) {
  if (remarks.empty()) return "<p>No remarks.</p>\n";
  std::vector<TableRow> rows;
  for (const Remark& remark : remarks)
    rows.push_back(
        {{name_of(remark.rank), fmt::format("line {}", remark.at.line), remark.at.message, remark.remedy}});
  return "<h2>Remarks</h2>\n" + table({"rank", "where", "finding", "remedy"}, rows, TableOf::text);
}

}  // namespace

std::string case_picture(const Scene& scene, const Remarks& remarks) {
  const std::vector<PlaceConditions> places = conditions_of(scene);
  const std::string title =
      scene.the_case().title.empty() ? scene.the_case().file.filename().string() : scene.the_case().title;
  return page(title, "<p>The case before it runs.</p>\n" + drawing(scene, places) +
                         "<h2>Boundaries and node sets</h2>\n" + places_table(scene, places) +
                         "<h2>Regions</h2>\n" + regions_table(scene) + packings(scene) +
                         remarks_table(remarks));
}

}  // namespace polargrain::app
