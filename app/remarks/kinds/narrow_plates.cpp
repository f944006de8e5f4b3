// SPDX-License-Identifier: GPL-2.0-or-later
// Footings and other plates that are pushed into a side of ground with strength: where they end the stress has no bound, and few
// elements make the load of failure too high.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// To each end.
constexpr double kLeastElements = 3.0;
/// Of the load, with one element to each end; of n elements an nth of it. Prandtl's smooth strip on a half body of elements Q8R: 16, 8.8,
/// 4.7, 3.2 % too high with 1, 2, 4, 6 elements without friction; 6.1, 3.2 % with 2, 4 of 25 degrees. A rough square without friction
/// on elements H20R: Nc is 9.2 and 7.9 with 1 and 2 elements, which tend to 6.6.
template <int dim>
constexpr double kErrorOfOne = dim == 2 ? 0.17 : 0.41;

/// The box around sides.
template <int dim>
fem::BoxAround<dim> box_of(const fem::Mesh<dim>& mesh, const std::vector<OutlineSide<dim>>& sides) {
  using Place = typename Cosserat<dim>::Place;
  fem::BoxAround<dim> box{Place::Constant(HUGE_VAL), Place::Constant(-HUGE_VAL)};
  for (const OutlineSide<dim>& side : sides)
    for (const int node : side.corners) {
      const Place& place = mesh.nodes[static_cast<std::size_t>(node)];
      box.least = box.least.cwiseMin(place);
      box.largest = box.largest.cwiseMax(place);
    }
  return box;
}

/// A part of the outline that is flat across an axis.
template <int dim>
class Plate {
 public:
  Plate(const fem::Problem<dim>& problem, const std::vector<OutlineSide<dim>>& sides, int axis)
      : problem_(problem), sides_(sides), axis_(axis), box_(box_of(problem.mesh, sides)) {}

  /// Elements along another axis.
  [[nodiscard]] double elements(int along) const {
    double sum = 0.0;
    for (const OutlineSide<dim>& side : sides_) sum += box_of<dim>(problem_.mesh, {side}).sides()(along);
    return std::round(box_.sides()(along) * static_cast<double>(sides_.size()) / sum);
  }

  /// Its ends along another axis where the same side of the body goes on, and is free to move along its normal.
  [[nodiscard]] int ends(int along, const HeldNodes<dim>& held,
                         const std::vector<OutlineSide<dim>>& outline) const {
    std::set<int> own;
    for (const OutlineSide<dim>& side : sides_) own.insert(side.nodes.begin(), side.nodes.end());
    bool lower = false;
    bool upper = false;
    for (const OutlineSide<dim>& side : outline) {
      if (side.normal.dot(sides_.front().normal) < 1.0 - 1e-6) continue;
      const bool is_free = std::ranges::any_of(side.nodes, [&](int node) {
        return !held[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis_)];
      });
      const bool touches = std::ranges::any_of(side.nodes, [&](int node) { return own.contains(node); });
      if (!is_free || !touches) continue;
      lower = lower || side.centre(along) < box_.least(along);
      upper = upper || side.centre(along) > box_.largest(along);
    }
    return (lower ? 1 : 0) + (upper ? 1 : 0);
  }

 private:
  const fem::Problem<dim>& problem_;
  const std::vector<OutlineSide<dim>>& sides_;
  int axis_;
  fem::BoxAround<dim> box_;
};

/// Whether sides are flat, across an axis, and all on ground with strength.
template <int dim>
bool is_plate(const Scene& scene, const std::vector<OutlineSide<dim>>& sides, int axis) {
  return !sides.empty() && std::ranges::all_of(sides, [&](const OutlineSide<dim>& side) {
    return std::abs(side.normal(axis)) > 1.0 - 1e-6 && side.normal(axis) * sides.front().normal(axis) > 0.0 &&
           is_strong(scene, scene.region_of(side.element));
  });
}

template <int dim>
void look_at_plates(const Scene& scene, const fem::Problem<dim>& problem, Remarks& remarks) {
  std::set<std::string> told;
  const HeldNodes<dim> held = held_nodes(problem);
  const std::vector<OutlineSide<dim>>& outline = scene.outline<dim>();
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    if (fem::is_rotation(item.dof) || item.value.largest_magnitude() == 0.0 ||
        !problem.mesh.boundaries.contains(item.on) || told.contains(item.on))
      continue;
    const int axis = fem::axis_of(item.dof);
    const std::vector<OutlineSide<dim>> sides = sides_of(problem.mesh, item.on);
    if (!is_plate(scene, sides, axis)) continue;
    const Plate<dim> plate(problem, sides, axis);
    double least = HUGE_VAL;  // to each end
    double elements = 0.0;
    int ends = 0;
    for (int along = 0; along < dim; ++along) {
      if (along == axis) continue;
      const int here = plate.ends(along, held, outline);
      if (here == 0 || plate.elements(along) / here >= least) continue;
      elements = plate.elements(along);
      ends = here;
      least = elements / here;
    }
    if (ends == 0 || least >= kLeastElements) continue;
    told.insert(item.on);
    remarks.push_back(
        {Rank::doubtful, kLeastElements / least,
         scene.place({"mesh"}).fault(fmt::format(
             "boundary: '{}' is moved and measures {:.0f} element{}{}: where it ends the stress has no bound, and the load of "
             "failure is up to {:.0f} % too high",
             item.on, elements, elements == 1.0 ? "" : "s", dim == 2 ? "" : " across",
             100.0 * kErrorOfOne<dim> / least)),
         fmt::format("take {} elements or more over it", static_cast<int>(2.0 * kLeastElements) * ends)});
  }
}

}  // namespace

void narrow_plates(const Scene& scene, Remarks& remarks) {
  scene.with_problem([&](const auto& problem) { look_at_plates(scene, problem, remarks); });
}

}  // namespace polargrain::app
