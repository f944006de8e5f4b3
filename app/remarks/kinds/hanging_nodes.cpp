// SPDX-License-Identifier: GPL-2.0-or-later
// Nodes within the side of an element that does not have them: elements of several sizes or kinds that touch and do not hold
// each other.
#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "app/remarks/nodes_by_place.hpp"
#include "fem/solver/stages.hpp"

namespace polargrain::app {
namespace {

/// Of a mean element: a nearer node is on the side, or at the place of a node.
constexpr double kOnASide = 1e-6;

/// Whether a place lies on a side, or face, but for a small distance. Gauss-Newton for the nearest point of the side.
template <int dim>
bool is_on_side(const fem::ElementType<dim - 1>& type, const fem::VectorRows<dim>& nodes,
                const typename Cosserat<dim>::Place& place, double near) {
  using Reference = Eigen::Matrix<double, dim - 1, 1>;
  constexpr int kMostIterations = 20;
  constexpr double kFound = 1e-10;
  constexpr double kBeyond = 1e-8;
  Reference reference = Reference::Zero();
  for (int corner = 0; corner < type.corners; ++corner)
    reference += type.node_positions[static_cast<std::size_t>(corner)] / type.corners;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const fem::ShapeFunctions<dim - 1> shape = type.shape_functions(reference);
    const typename Cosserat<dim>::Place missing = place - nodes.transpose() * shape.value;
    const Eigen::Matrix<double, dim, dim - 1> along = nodes.transpose() * shape.derivative;
    const Eigen::Matrix<double, dim - 1, dim - 1> square = along.transpose() * along;
    const Reference step = square.ldlt().solve(along.transpose() * missing);
    reference += step;
    if (!reference.allFinite()) return false;
    if (step.norm() > kFound) continue;
    const bool is_triangle = type.corners == 3;  // from 0; else from -1 to 1
    const double beyond = is_triangle ? std::max(-reference.minCoeff(), reference.sum() - 1.0)
                                      : reference.cwiseAbs().maxCoeff() - 1.0;
    return beyond <= kBeyond && missing.norm() <= near;
  }
  return false;
}

/// Whether two parts of the mesh are there at once, in any stage.
template <int dim>
class Together {
 public:
  explicit Together(const fem::Problem<dim>& problem) {
    const int stages = std::max(1, static_cast<int>(problem.stages.size()));
    for (int stage = 0; stage < stages; ++stage) there_.push_back(fem::elements_in_stage(problem, stage));
  }
  [[nodiscard]] bool are(int element, const std::vector<int>& others) const {
    return std::ranges::any_of(there_, [&](const std::vector<char>& there) {
      const auto is_there = [&](int e) { return there.empty() || there[static_cast<std::size_t>(e)] != 0; };
      return is_there(element) && std::ranges::any_of(others, is_there);
    });
  }

 private:
  std::vector<std::vector<char>> there_;
};

/// The nodes of the outline that lie within a side of it, but for those at a place of its nodes: where an interface parts the body,
/// both sides have nodes at the same places.
template <int dim>
std::set<int> nodes_within_sides(const Scene& scene, const fem::Problem<dim>& problem) {
  const fem::Mesh<dim>& mesh = problem.mesh;
  const std::vector<OutlineSide<dim>>& outline = scene.outline<dim>();
  std::map<int, std::vector<int>> elements;  // of a node of the outline, those with a side there
  for (const OutlineSide<dim>& side : outline)
    for (const int node : side.nodes) elements[node].push_back(side.element);
  std::vector<int> nodes;
  for (const auto& [node, beside] : elements) nodes.push_back(node);
  const NodesByPlace<dim> by_place(mesh, std::move(nodes));
  const Together<dim> together(problem);
  const double near = kOnASide * scene.body().mean_element;
  std::set<int> within;
  for (const OutlineSide<dim>& side : outline) {
    fem::VectorRows<dim> places(static_cast<Eigen::Index>(side.nodes.size()), dim);
    for (std::size_t k = 0; k < side.nodes.size(); ++k)
      places.row(static_cast<Eigen::Index>(k)) =
          mesh.nodes[static_cast<std::size_t>(side.nodes[k])].transpose();
    const typename Cosserat<dim>::Place least = places.colwise().minCoeff().array() - near;
    const typename Cosserat<dim>::Place largest = places.colwise().maxCoeff().array() + near;
    const fem::ElementType<dim - 1>& type = *mesh.side_of({side.element, side.number}).type;
    by_place.visit_in_box(least, largest, [&](int node) {
      const typename Cosserat<dim>::Place& place = mesh.nodes[static_cast<std::size_t>(node)];
      if ((places.rowwise() - place.transpose()).rowwise().norm().minCoeff() <= near) return;
      const std::vector<int>& beside = elements.at(node);
      if (std::ranges::find(beside, side.element) != beside.end()) return;
      if (is_on_side<dim>(type, places, place, near) && together.are(side.element, beside))
        within.insert(node);
    });
  }
  return within;
}

template <int dim>
void look_within_sides(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  const std::set<int> within = nodes_within_sides(scene, problem);
  if (within.empty()) return;
  const auto& first = problem.mesh.nodes[static_cast<std::size_t>(*within.begin())];
  remarks.push_back(
      {Rank::wrong, static_cast<double>(within.size()),
       scene.place({"mesh"}).fault(fmt::format(
           "mesh: elements do not meet node to node at {} m: {} nodes lie within sides of elements that do not have them, "
           "and the parts that meet there do not hold each other",
           fem::place_text<dim>(first), within.size())),
       "mesh both parts together, so that they share all nodes: in Gmsh, Coherence, or BooleanFragments before Physical "
       "groups; no tetrahedra beside hexahedra"});
}

}  // namespace

void hanging_nodes(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_within_sides(scene, problem, remarks); });
}

}  // namespace polargrain::app
