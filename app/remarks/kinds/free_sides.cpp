// SPDX-License-Identifier: GPL-2.0-or-later
// Vertical sides of ground that nothing holds, under its weight.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

constexpr double kWholeSide = 0.9;  // of a side
constexpr double kUpright = 0.99;   // of a normal
constexpr double kWide = 2.0;       // over the height: narrower bodies may stand free, as specimens do

template <int dim>
bool has_weight(const fem::Problem<dim>& problem) {
  return std::ranges::any_of(problem.body_loads, [&](const fem::BodyLoad<dim>& load) {
    return load.density(problem.mesh.nodes.front())(dim - 1) * load.factor.largest_magnitude() < 0.0;
  });
}

/// Nodes whose displacement along an axis is given, or whose boundary is loaded or tied.
template <int dim>
HeldNodes<dim> nodes_with_conditions(const fem::Problem<dim>& problem) {
  HeldNodes<dim> nodes = carried_nodes(problem);
  const auto carry_all = [&](const std::string& name) {
    for (const int node : problem.mesh.nodes_on(name)) nodes[static_cast<std::size_t>(node)].fill(true);
  };
  for (const fem::BoundaryLoad<dim>& load : problem.boundary_loads) carry_all(load.on);
  for (const fem::Tie& tie : problem.ties)
    for (const std::string& name : {tie.on, tie.to}) carry_all(name);
  return nodes;
}

/// The ends of a body across a horizontal axis.
template <int dim>
class Ends {
 public:
  /// Both must outlive this object.
  Ends(const fem::Problem<dim>& problem, const std::vector<OutlineSide<dim>>& outline)
      : nodes_(nodes_with_conditions(problem)), outline_(outline), box_(fem::box_around(problem.mesh)) {}

  [[nodiscard]] const fem::BoxAround<dim>& box() const { return box_; }

  /// Whether the body ends there in a vertical side that is free.
  [[nodiscard]] bool is_free(int axis, double end) const {
    double all = 0.0;
    double free = 0.0;
    for (const OutlineSide<dim>& side : outline_) {
      if (std::abs(side.centre(axis) - end) > 1e-6 * box_.sides()(axis) ||
          std::abs(side.normal(axis)) < kUpright)
        continue;
      all += side.size;
      const bool is_carried = std::ranges::all_of(side.nodes, [&](int node) {
        return nodes_[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
      });
      if (!is_carried) free += side.size;
    }
    double whole = 1.0;
    for (int i = 0; i < dim; ++i)
      if (i != axis) whole *= box_.sides()(i);
    return all > kWholeSide * whole && free > kWholeSide * all;
  }

 private:
  HeldNodes<dim> nodes_;
  const std::vector<OutlineSide<dim>>& outline_;
  fem::BoxAround<dim> box_;
};

template <int dim>
void look_at_sides(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  // An elastic body cannot flow.
  const bool may_flow = std::ranges::any_of(
      scene.regions(), [&](const SceneRegion& region) { return is_strong(scene, region); });
  if (!has_weight(problem) || !may_flow) return;
  const Ends<dim> ends(problem, scene.outline<dim>());
  const auto sides = ends.box().sides();
  for (int axis = 0; axis < dim - 1; ++axis) {
    const bool lower = ends.is_free(axis, ends.box().least(axis));
    const bool upper = ends.is_free(axis, ends.box().largest(axis));
    if (!lower && !upper) continue;
    if (lower && upper && sides(axis) < kWide * sides(dim - 1)) continue;
    const std::string which =
        lower && upper ? fmt::format("both ends of the mesh along {} are", axis + 1)
                       : fmt::format("its {} end along {} is", lower ? "lower" : "upper", axis + 1);
    remarks.push_back(
        {Rank::wrong, 5.0,
         scene.place({"boundary"})
             .fault(fmt::format(
                 "boundary: {} free over the whole height ({:.3g} m) under weight: the ground flows out there",
                 which, sides(dim - 1))),
         fmt::format("hold such a side, as rollers do: {{on: SIDE, fix: [u{}]}}; or load it", axis + 1)});
  }
}

}  // namespace

void free_sides(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_sides(scene, problem, remarks); });
}

}  // namespace polargrain::app
