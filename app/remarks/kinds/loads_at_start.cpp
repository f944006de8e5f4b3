// SPDX-License-Identifier: GPL-2.0-or-later
// The load of each boundary at time zero against the stress behind it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "app/remarks/given_stress.hpp"
#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/outline.hpp"

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
};

std::vector<int> sorted(std::vector<int> nodes) {
  std::ranges::sort(nodes);
  return nodes;
}

/// The loads on the sides of a mesh: one side may lie on several boundaries, each with a load.
template <int dim>
class LoadedSides {
 public:
  using Place = typename Cosserat<dim>::Place;

  LoadedSides(const fem::Problem<dim>& problem, const std::vector<OutlineSide<dim>>& outline)
      : problem_(problem) {
    const fem::Mesh<dim>& mesh = problem.mesh;
    for (const OutlineSide<dim>& side : outline) outer_.insert(sorted(side.nodes));
    for (const auto& [one, other] : fem::joined_nodes(problem)) {
      if (mesh.nodes[static_cast<std::size_t>(one)] != mesh.nodes[static_cast<std::size_t>(other)]) continue;
      in_interface_.insert(one);
      in_interface_.insert(other);
    }
    for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) {
      std::set<std::vector<int>>& under = under_.emplace_back();
      for (const fem::BoundarySide& side : mesh.boundaries.at(load.on))
        under.insert(sorted(mesh.side_nodes(side)));
    }
  }

  /// A line or face inside the body may have a name too, and along an interface the other side takes the pressure.
  [[nodiscard]] bool is_outer(const OutlineSide<dim>& side) const {
    return outer_.contains(sorted(side.nodes)) &&
           !std::ranges::all_of(side.nodes, [&](int node) { return in_interface_.contains(node); });
  }
  [[nodiscard]] bool is_loaded(const OutlineSide<dim>& side) const {
    return std::ranges::any_of(under_, [&](const auto& under) { return under.contains(sorted(side.nodes)); });
  }
  /// At time zero.
  [[nodiscard]] Place traction(const OutlineSide<dim>& side) const {
    Place t = Place::Zero();
    for (std::size_t k = 0; k < under_.size(); ++k) {
      if (!under_[k].contains(sorted(side.nodes))) continue;
      const fem::BoundaryLoad<dim>& load = problem_.boundary_loads[k];
      t -= load.pressure.at(0.0) * side.normal;
      for (std::size_t i = 0; i < dim; ++i) t(static_cast<Eigen::Index>(i)) += load.traction[i].at(0.0);
    }
    return t;
  }

 private:
  const fem::Problem<dim>& problem_;
  std::set<std::vector<int>> outer_;
  std::set<int> in_interface_;  ///< nodes that have another one at their place, joined by an interface
  std::vector<std::set<std::vector<int>>> under_;  ///< each load
};

/// Loads may come on to the nodes of a boundary one by one, or it is tied: nothing is known of its traction.
template <int dim>
bool is_special(const fem::Problem<dim>& problem, const std::string& boundary,
                const std::vector<OutlineSide<dim>>& sides) {
  for (const fem::Tie& tie : problem.ties)
    if (tie.on == boundary || tie.to == boundary) return true;
  for (const fem::NodeLoad& load : problem.node_loads) {
    const std::vector<int> nodes = problem.mesh.nodes_on(load.on);
    for (const OutlineSide<dim>& side : sides)
      for (const int node : side.nodes)
        if (std::ranges::binary_search(nodes, node)) return true;
  }
  return false;
}

/// Over the free sides; nothing without a free side or a known stress.
template <int dim>
std::optional<Mismatch> mismatch_of(const Scene& scene, const LoadedSides<dim>& all,
                                    const std::vector<OutlineSide<dim>>& sides, const HeldNodes<dim>& held) {
  using Place = typename Cosserat<dim>::Place;
  Mismatch sum;
  double size = 0.0;
  for (const OutlineSide<dim>& side : sides) {
    const auto is_along = held_along<dim>({side}, held).all;
    const SceneRegion& region = scene.region_of(side.element);
    const auto stress = scene.initial_stress<dim>(region, side.centre);
    if (!stress || std::ranges::all_of(is_along, [](bool there) { return there; })) continue;
    const Place& n = side.normal;
    Place inside = Place::Zero();
    double mean = 0.0;
    for (int j = 0; j < dim; ++j) {
      for (int i = 0; i < dim; ++i) inside(j) += n(i) * (*stress)(Cosserat<dim>::stress_place(i, j));
      mean -= (*stress)(Cosserat<dim>::stress_place(j, j)) / dim;
    }
    Place out = all.traction(side) - inside;
    for (int i = 0; i < dim; ++i)
      if (is_along[static_cast<std::size_t>(i)]) out(i) = 0.0;
    const double pushed = -inside.dot(n);
    sum.behind += side.size * pushed;
    sum.carried += side.size * (pushed - out.dot(n));
    sum.along += side.size * (out - out.dot(n) * n).norm();
    sum.scale += side.size * std::max(mean, 0.0);
    sum.has_cells = sum.has_cells || (region.cell != nullptr && !has_given_stress(scene, region.name));
    size += side.size;
  }
  if (size == 0.0) return {};
  for (double* const value : {&sum.carried, &sum.behind, &sum.along, &sum.scale}) *value /= size;
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

template <int dim>
void look_at_boundary(const Scene& scene, const std::string& boundary, const LoadedSides<dim>& all,
                      const HeldNodes<dim>& held, Remarks& remarks) {
  const fem::Problem<dim>& problem = scene.problem_of<dim>();
  std::vector<OutlineSide<dim>> sides =
      boundary.empty() ? without_names(scene.outline<dim>()) : sides_of(problem.mesh, boundary);
  std::erase_if(sides, [&](const OutlineSide<dim>& side) { return !all.is_outer(side); });
  if (sides.empty() || is_special(problem, boundary, sides)) return;
  const std::optional<Mismatch> m = mismatch_of(scene, all, sides, held);
  if (!m) return;
  const double scale = std::max({m->scale, std::abs(m->carried), std::abs(m->behind)});
  if (scale <= 0.0) return;
  const double off = std::max(std::abs(m->carried - m->behind), m->along) / scale;
  if (off <= kSlack) return;
  const coupler::Entry* value = nullptr;
  for (const char* const key : {"pressure", "traction"})
    if (value == nullptr) value = scene.boundary_value(boundary, key);
  const bool loaded =
      std::ranges::any_of(sides, [&](const OutlineSide<dim>& side) { return all.is_loaded(side); });
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
       remedy_of(*m, boundary, loaded, !problem.body_loads.empty())});
}

}  // namespace

void loads_at_start(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    const HeldNodes<dim> held = carried_nodes(problem);
    const LoadedSides<dim> all(problem, scene.outline<dim>());
    for (const auto& [name, sides] : problem.mesh.boundaries)
      look_at_boundary(scene, name, all, held, remarks);
    look_at_boundary(scene, "", all, held, remarks);
  });
}

}  // namespace polargrain::app
