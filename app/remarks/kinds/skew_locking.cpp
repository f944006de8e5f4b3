// SPDX-License-Identifier: GPL-2.0-or-later
// Linear elements between rough plates that hold the micro-rotation: with several points they lock once the ground yields.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "app/remarks/in_units.hpp"
#include "app/remarks/kinds.hpp"
#include "app/remarks/lengths.hpp"
#include "app/remarks/outline.hpp"
#include "app/remarks/stress_scale.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Of the strength, where a remark begins.
constexpr double kMostSkewExcess = 0.1;

/// Whether a material yields, and its skew stress does not. The skew stress of grains has a limit unless the case takes it away.
bool skew_stays_elastic(const Scene& scene, const SceneRegion& region) {
  if (!is_strong(scene, region)) return false;
  if (region.cell != nullptr) {
    const coupler::Entry* const limit = scene.find({"materials", region.material, "skew_limit"});
    return region.cell->control.rotations == CellRotations::free && limit != nullptr && limit->text == "none";
  }
  const coupler::Entry* const weights = scene.find({"materials", region.material, "invariants"});
  if (weights == nullptr || weights->items.size() != 3) return true;
  const auto weight = [&](std::size_t k) {
    return coupler::parse_quantity(weights->items[k].text, coupler::Dimension::number).value_or(0.0);
  };
  return std::abs(weight(0) - weight(1)) < 1e-6;
}

double skew_modulus(const Scene& scene, const SceneRegion& region) {
  const auto given = scene.quantity({"materials", region.material, "Gc"}, coupler::Dimension::pressure);
  return given.value_or(region.packing != nullptr ? region.packing->moduli.cosserat_shear : 0.0);
}

/// About the largest shear stress that a material bears, Pa; 0: not known.
double shear_strength(const Scene& scene, const SceneRegion& region) {
  constexpr double kUsualFriction = 30.0;  // of grains and tables, degrees
  const auto friction =
      scene.quantity({"materials", region.material, "friction_angle"}, coupler::Dimension::angle);
  const auto cohesion =
      scene.quantity({"materials", region.material, "cohesion"}, coupler::Dimension::pressure);
  const double stress = std::max(stress_scale(scene), Scene::pressure_of(region));
  return stress * std::sin(friction.value_or(kUsualFriction * std::numbers::pi / 180.0)) +
         cohesion.value_or(0.0);
}

/// Mean extent along an axis of the linear elements with several points of a region, m; 0 without them.
template <int dim>
double linear_extent(const fem::Mesh<dim>& mesh, const SceneRegion& region, int axis) {
  double sum = 0.0;
  int count = 0;
  for (const int e : region.elements) {
    const fem::Element<dim>& element = mesh.elements[static_cast<std::size_t>(e)];
    if (element.type->nodes != element.type->corners || element.type->quadrature.size() == 1) continue;
    double least = HUGE_VAL;
    double largest = -HUGE_VAL;
    for (const int node : element.nodes) {
      const double at = mesh.nodes[static_cast<std::size_t>(node)](axis);
      least = std::min(least, at);
      largest = std::max(largest, at);
    }
    sum += largest - least;
    ++count;
  }
  return count == 0 ? 0.0 : sum / count;
}

/// The degrees of freedom that are held at the ends of the body.
template <int dim>
class HeldEnds {
 public:
  explicit HeldEnds(const fem::Problem<dim>& problem)
      : problem_(problem), held_(held_nodes(problem)), box_(fem::box_around(problem.mesh)) {}

  [[nodiscard]] double side(int axis) const { return box_.sides()(axis); }

  /// A rough plate: all nodes at an end across an axis are held along it, and cannot rotate about it. @returns the name of the
  /// boundary that holds the rotation; empty: there is no plate
  [[nodiscard]] std::string plate(int axis, bool upper) const {
    const std::vector<int> nodes = at_end(axis, upper);
    for (int along = 0; along < dim; ++along)
      if (along != axis && !are_held(nodes, along)) return {};
    for (const fem::PrescribedDof<dim>& item : problem_.prescribed) {
      if (!fem::is_rotation(item.dof) || (dim == 3 && fem::axis_of(item.dof) == axis)) continue;
      if (!problem_.mesh.has_nodes_on(item.on)) continue;
      std::vector<int> turned = problem_.mesh.nodes_on(item.on);
      std::ranges::sort(turned);
      // Where all of the body is held, it is meant not to rotate.
      if (turned.size() < held_.size() && std::ranges::includes(turned, nodes)) return item.on;
    }
    return {};
  }

  /// The smallest side of the body along another axis, m, of those that may change: one with an end that is held is half of a whole.
  /// HUGE_VAL: nothing gives way sideways.
  [[nodiscard]] double free_side(int axis) const {
    double least = HUGE_VAL;
    for (int along = 0; along < dim && problem_.ties.empty(); ++along) {
      if (along == axis) continue;
      const bool lower = are_held(at_end(along, false), along);
      const bool upper = are_held(at_end(along, true), along);
      if (!lower || !upper) least = std::min(least, side(along) * (lower || upper ? 2.0 : 1.0));
    }
    return least;
  }

 private:
  /// In ascending order.
  [[nodiscard]] std::vector<int> at_end(int axis, bool upper) const {
    const double end = upper ? box_.largest(axis) : box_.least(axis);
    std::vector<int> nodes;
    for (std::size_t node = 0; node < problem_.mesh.nodes.size(); ++node)
      if (std::abs(problem_.mesh.nodes[node](axis) - end) < 1e-6 * side(axis))
        nodes.push_back(static_cast<int>(node));
    return nodes;
  }

  [[nodiscard]] bool are_held(const std::vector<int>& nodes, int axis) const {
    return std::ranges::all_of(nodes, [&](int node) {
      return held_[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
    });
  }

  const fem::Problem<dim>& problem_;
  HeldNodes<dim> held_;
  fem::BoxAround<dim> box_;
};

/// The plates across an axis, and what an excess of shear stress depends on.
struct Sheared {
  std::vector<std::string> plates;
  double strain = 0.0;
  double length =
      0.0;  ///< over which the strain goes from nothing at a plate to its largest value and back, m
};

template <int dim>
Sheared sheared_across(const Scene& scene, const fem::Problem<dim>& problem, const HeldEnds<dim>& ends,
                       int axis) {
  Sheared sheared;
  for (const bool upper : {false, true})
    if (std::string name = ends.plate(axis, upper); !name.empty()) sheared.plates.push_back(std::move(name));
  if (sheared.plates.empty()) return sheared;
  const double across = ends.free_side(axis);
  double largest = 0.0;
  for (const fem::PrescribedDof<dim>& item : problem.prescribed) {
    // Where nothing gives way sideways, a movement along the axis strains the body evenly.
    const bool shears = !fem::is_rotation(item.dof) && (fem::axis_of(item.dof) != axis || across < HUGE_VAL);
    if (shears) largest = std::max(largest, scene.reached(item.value));
  }
  sheared.strain = largest / ends.side(axis);
  sheared.length = std::min(across, ends.side(axis) * 2.0 / static_cast<double>(sheared.plates.size()));
  return sheared;
}

/// The strain of such an element is constant and its rotation linear: no rotation follows a strain that varies, and what is left
/// over strains the skew stress. Between plates at a distance L the shear stress is too high by Gc gamma (h/L)^2, whatever lc
/// is: 552, 179, 87, 64 kPa in place of 56 with 2, 4, 8, 16 elements Q4 and H8 of Gc = 20 MPa at gamma = 0.1.
template <int dim>
void look_across(const Scene& scene, const fem::Problem<dim>& problem, const HeldEnds<dim>& ends, int axis,
                 Remarks& remarks) {
  const Sheared sheared = sheared_across(scene, problem, ends, axis);
  if (sheared.plates.empty()) return;
  for (const SceneRegion& region : scene.regions()) {
    const double element = linear_extent(problem.mesh, region, axis);
    if (element == 0.0 || !skew_stays_elastic(scene, region)) continue;
    const double excess =
        skew_modulus(scene, region) * sheared.strain * std::pow(element / sheared.length, 2);
    const double strength = shear_strength(scene, region);
    if (strength <= 0.0 || excess <= kMostSkewExcess * strength) continue;
    const double share = excess / strength;
    remarks.push_back(
        {Rank::doubtful, share / kMostSkewExcess,
         scene.place({"mesh"}).fault(fmt::format(
             "mesh: the micro-rotation is held at '{}', and linear elements with several points, of {} in region '{}', "
             "lock in shear once '{}' yields: shear stress some {} too high, {:.0f} % of its strength",
             fmt::join(sheared.plates, "' and '"), metres(element), region.name, region.material,
             pascals(excess), 100.0 * share)),
         fmt::format("element: {}, or elements of {}", dim == 2 ? "Q4R or Q8R" : "H8R or H20R",
                     metres(element * std::sqrt(kMostSkewExcess / share)))});
  }
}

}  // namespace

void skew_locking(const Scene& scene, Remarks& remarks) {
  if (scene.is_classical()) return;
  scene.with_problem([&]<int dim>(const fem::Problem<dim>& problem) {
    const HeldEnds<dim> ends(problem);
    for (int axis = 0; axis < dim; ++axis) look_across(scene, problem, ends, axis, remarks);
  });
}

}  // namespace polargrain::app
