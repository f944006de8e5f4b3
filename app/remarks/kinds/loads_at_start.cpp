// SPDX-License-Identifier: GPL-2.0-or-later
// The load of each boundary at time zero against the stress behind it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "app/remarks/given_stress.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"

namespace polargrain::app {
namespace {

/// A packing is at rest under its pressure to a few per cent, and so is a body under loads that differ by less.
constexpr double kSlack = 0.05;
constexpr double kFar = 0.3;  // of the pressure: the grains rearrange before the first step

/// Mean over a boundary at time zero, tension positive, Pa.
struct Mismatch {
  double carried = 0.0;    ///< pressure of the loads along the normal
  double behind = 0.0;     ///< pressure of the stress behind it
  double along = 0.0;      ///< shear traction that nothing carries, magnitude
  double scale = 0.0;      ///< pressure there
  bool has_cells = false;  ///< whose stress is that of their packing
  const SceneRegion* region = nullptr;
};

using Corners = std::pair<int, int>;

Corners corners_of(const std::vector<int>& nodes) {
  return std::minmax(nodes[0], nodes[1]);
}

/// The loads on the edges of a mesh: one edge may lie on several boundaries, each with a load.
class Edges {
 public:
  explicit Edges(const fem::Problem<2>& problem) : problem_(problem) {
    const fem::Mesh<2>& mesh = problem.mesh;
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e)
      for (int side = 0; side < mesh.elements[static_cast<std::size_t>(e)].type->corners; ++side)
        ++elements_[corners_of(mesh.side_nodes({e, side}))];
    for (const auto& [one, other] : fem::joined_nodes(problem)) {
      if (mesh.nodes[static_cast<std::size_t>(one)] != mesh.nodes[static_cast<std::size_t>(other)]) continue;
      in_interface_.insert(one);
      in_interface_.insert(other);
    }
    for (const fem::BoundaryLoad<2>& load : problem.boundary_loads) {
      std::set<Corners>& under = under_.emplace_back();
      for (const fem::BoundarySide& edge : mesh.boundaries.at(load.on))
        under.insert(corners_of(mesh.side_nodes(edge)));
    }
  }

  /// A line inside the body may have a name too, and along an interface the other side takes the pressure.
  [[nodiscard]] bool is_outer(const OutlineEdge& edge) const {
    return elements_.at(corners_of(edge.nodes)) == 1 &&
           !std::ranges::all_of(edge.nodes, [&](int node) { return in_interface_.contains(node); });
  }
  [[nodiscard]] bool is_loaded(const OutlineEdge& edge) const {
    return std::ranges::any_of(under_,
                               [&](const auto& under) { return under.contains(corners_of(edge.nodes)); });
  }
  /// At time zero.
  [[nodiscard]] Eigen::Vector2d traction(const OutlineEdge& edge) const {
    Eigen::Vector2d t = Eigen::Vector2d::Zero();
    for (std::size_t k = 0; k < under_.size(); ++k) {
      if (!under_[k].contains(corners_of(edge.nodes))) continue;
      const fem::BoundaryLoad<2>& load = problem_.boundary_loads[k];
      t += -load.pressure.at(0.0) * edge.normal +
           Eigen::Vector2d(load.traction[0].at(0.0), load.traction[1].at(0.0));
    }
    return t;
  }

 private:
  const fem::Problem<2>& problem_;
  std::map<Corners, int> elements_;
  std::set<int> in_interface_;  ///< nodes that have another one at their place, joined by an interface
  std::vector<std::set<Corners>> under_;  ///< each load
};

/// Loads may come on to the nodes of a boundary one by one, or it is tied: nothing is known of its traction.
bool is_special(const fem::Problem<2>& problem, const std::string& boundary,
                const std::vector<OutlineEdge>& edges) {
  for (const fem::Tie& tie : problem.ties)
    if (tie.on == boundary || tie.to == boundary) return true;
  for (const fem::NodeLoad& load : problem.node_loads) {
    const std::vector<int> nodes = problem.mesh.nodes_on(load.on);
    for (const OutlineEdge& edge : edges)
      for (const int node : edge.nodes)
        if (std::ranges::binary_search(nodes, node)) return true;
  }
  return false;
}

/// Over the free edges; nothing without a free edge or a known stress.
std::optional<Mismatch> mismatch_of(const Scene& scene, const Edges& all,
                                    const std::vector<OutlineEdge>& edges,
                                    const std::vector<std::array<bool, 2>>& held) {
  Mismatch sum;
  double length = 0.0;
  for (const OutlineEdge& edge : edges) {
    const Held here = held_along({edge}, held);
    const SceneRegion& region = scene.region_of(edge.element);
    const std::optional<Vector7> stress = scene.initial_stress<2>(region, edge.centre);
    if (!stress || (here.all[0] && here.all[1])) continue;
    const Eigen::Vector2d& n = edge.normal;
    const Vector7& s = *stress;
    const Eigen::Vector2d inside(s(k11) * n.x() + s(k21) * n.y(), s(k12) * n.x() + s(k22) * n.y());
    Eigen::Vector2d out = all.traction(edge) - inside;
    for (std::size_t i = 0; i < 2; ++i)
      if (here.all[i]) out(static_cast<Eigen::Index>(i)) = 0.0;
    const double pushed = -inside.dot(n);
    sum.behind += edge.length * pushed;
    sum.carried += edge.length * (pushed - out.dot(n));
    sum.along += edge.length * std::abs(out.x() * n.y() - out.y() * n.x());
    sum.scale += edge.length * std::max(-0.5 * (s(k11) + s(k22)), 0.0);
    sum.has_cells = sum.has_cells || (region.cell != nullptr && !has_given_stress(scene, region.name));
    sum.region = &region;
    length += edge.length;
  }
  if (length == 0.0) return {};
  for (double* const value : {&sum.carried, &sum.behind, &sum.along, &sum.scale}) *value /= length;
  return sum;
}

std::string remedy_of(const Mismatch& m, const std::string& boundary, bool loaded, bool has_weight) {
  if (!loaded && has_weight && m.has_cells)
    return "level ground with weight: initial_stress: [{surface: HEIGHT, unit_weight: ..., K0: measured}] leads the boxes to "
           "their depths; else give it 'pressure', or hold it";
  if (!loaded && boundary.empty())
    return fmt::format(
        "give that part of the outline a name in the mesh and 'pressure: {}' below boundary, or hold it",
        pascals(m.behind));
  if (!loaded)
    return fmt::format("give it 'pressure: {}', or hold it: {{on: {}, fix: [...]}}", pascals(m.behind),
                       boundary);
  if (!m.has_cells) return "let the load at time zero, the weight and initial_stress (surcharge) agree";
  if (m.carried <= 0.0)
    return fmt::format("a pressure pushes into the body where it is positive: write 'pressure: {}'",
                       pascals(m.behind));
  return fmt::format(
      "settle the packing to {0} (polargrain pack --settle PACKING SCRIPT -o NEW.h5 --set pressure='{0}'), or begin where the "
      "packing is: pressure: [[0, {1}], [1, {0}]]{2}",
      pascals(m.carried), pascals(m.behind),
      has_weight
          ? "; level ground with weight begins under its own stress: initial_stress: [{surface: HEIGHT, "
            "unit_weight: ..., K0: measured, surcharge: ...}]"
          : "");
}

void look_at(const Scene& scene, const std::string& boundary, const Edges& all,
             const std::vector<std::array<bool, 2>>& held, Remarks& remarks) {
  std::vector<OutlineEdge> edges = edges_of(scene.mesh(), boundary);
  std::erase_if(edges, [&](const OutlineEdge& edge) { return !all.is_outer(edge); });
  if (edges.empty() || is_special(scene.problem(), boundary, edges)) return;
  const std::optional<Mismatch> m = mismatch_of(scene, all, edges, held);
  if (!m) return;
  const double scale = std::max({m->scale, std::abs(m->carried), std::abs(m->behind)});
  if (scale <= 0.0) return;
  const double off = std::max(std::abs(m->carried - m->behind), m->along) / scale;
  if (off <= kSlack) return;
  const coupler::Entry* value = nullptr;
  for (const char* const key : {"pressure", "traction"})
    if (value == nullptr) value = scene.boundary_value(boundary, key);
  const bool loaded =
      std::ranges::any_of(edges, [&](const OutlineEdge& edge) { return all.is_loaded(edge); });
  const std::string name = boundary.empty() ? "a part of the outline that has no name" : "'" + boundary + "'";
  const std::string who = m->has_cells ? "its grains" : "the initial stress behind it";
  const coupler::Entry& place = value != nullptr ? *value : scene.place({"boundary"});
  const std::string seen =
      m->along > std::abs(m->carried - m->behind)
          ? fmt::format("boundary: along {} nothing carries {} of shear of {} at time zero", name,
                        pascals(m->along), who)
          : fmt::format("boundary: {} carries {} at time zero, {} {}", name,
                        !loaded ? "nothing" : pascals(m->carried), who, pascals(m->behind));
  const double ratio =
      m->carried > 0.0 && m->behind > 0.0 ? std::max(m->carried / m->behind, m->behind / m->carried) : 1e3;
  remarks.push_back(
      {off > kFar ? Rank::wrong : Rank::doubtful, std::max(1.0, ratio),
       place.fault(
           fmt::format("{}: the first step, 0, has to take up {:.0f} % of that pressure", seen, 100.0 * off)),
       remedy_of(*m, boundary, loaded, !scene.problem().body_loads.empty())});
}

}  // namespace

void loads_at_start(const Scene& scene, Remarks& remarks) {
  const auto held = carried_nodes(scene.problem());
  const Edges all(scene.problem());
  for (const auto& [name, edges] : scene.mesh().boundaries) look_at(scene, name, all, held, remarks);
  look_at(scene, "", all, held, remarks);
}

}  // namespace polargrain::app
