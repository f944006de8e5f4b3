// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/find_place.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace polargrain::fem {
namespace {

/// By how much a place of the reference element lies outside of it. That is a square or cube from -1 to 1, a simplex from 0, or
/// (wedge) a triangle from 0 times a height from -1 to 1.
template <int dim>
double outside_of(const ElementType<dim>& type, const typename Cosserat<dim>::Place& reference) {
  const bool simplex = type.corners == dim + 1;
  if (simplex) return std::max(-reference.minCoeff(), reference.sum() - 1.0);
  const bool wedge = dim == 3 && type.corners == 6;
  if (!wedge) return reference.cwiseAbs().maxCoeff() - 1.0;
  const auto triangle = reference.template head<2>();
  return std::max({-triangle.minCoeff(), triangle.sum() - 1.0, std::abs(reference(dim - 1)) - 1.0});
}

/// Newton's iteration for the reference coordinates of a place; nothing where it does not converge.
template <int dim>
std::optional<typename Cosserat<dim>::Place> reference_of(const ElementType<dim>& type,
                                                          const VectorRows<dim>& nodes,
                                                          const typename Cosserat<dim>::Place& place) {
  constexpr int kMostIterations = 20;
  constexpr double kFound = 1e-12;
  typename Cosserat<dim>::Place reference = Cosserat<dim>::Place::Zero();
  if (type.corners != 1 << dim) reference.setConstant(1.0 / (dim + 1));
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const ShapeFunctions<dim> shape = type.shape_functions(reference);
    const typename Cosserat<dim>::Place missing = place - nodes.transpose() * shape.value;
    const typename Cosserat<dim>::Gradient derivative = nodes.transpose() * shape.derivative;
    const typename Cosserat<dim>::Place step = derivative.partialPivLu().solve(missing);
    reference += step;
    if (!reference.allFinite()) return {};
    if (step.norm() < kFound) return reference;
  }
  return {};
}

}  // namespace

template <int dim>
PlaceFinder<dim>::PlaceFinder(const Mesh<dim>& mesh) : mesh_(mesh) {
  boxes_.reserve(mesh.elements.size());
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const VectorRows<dim> nodes = mesh.element_positions(e);
    const typename Cosserat<dim>::Place low = nodes.colwise().minCoeff();
    const typename Cosserat<dim>::Place high = nodes.colwise().maxCoeff();
    constexpr double kRoom = 0.1;
    const double room = kRoom * (high - low).norm();
    boxes_.push_back({low.array() - room, high.array() + room});
  }
}

template <int dim>
Probe<dim> PlaceFinder<dim>::find(const typename Cosserat<dim>::Place& place, double outside) const {
  Probe<dim> probe;
  for (std::size_t e = 0; e < boxes_.size(); ++e) {
    if ((place.array() < boxes_[e].low.array()).any() || (place.array() > boxes_[e].high.array()).any())
      continue;
    const auto number = static_cast<int>(e);
    const ElementType<dim>& type = *mesh_.elements[e].type;
    const auto reference = reference_of<dim>(type, mesh_.element_positions(number), place);
    if (reference && outside_of<dim>(type, *reference) <= outside)
      probe.elements.push_back({number, *reference});
  }
  return probe;
}

template <int dim>
std::vector<Probe<dim>> sides_at(const Mesh<dim>& mesh, const Probe<dim>& probe,
                                 const std::vector<int>& materials) {
  constexpr double kNoShare = 1e-6;  // a place on a side may lie kOnSide beyond it
  std::map<std::pair<int, std::vector<int>>, Probe<dim>> sides;
  for (const typename Probe<dim>::Inside& inside : probe.elements) {
    const auto number = static_cast<std::size_t>(inside.element);
    const Element<dim>& element = mesh.elements[number];
    const auto shares = element.type->shape_functions(inside.reference).value;
    std::vector<int> carrying;
    for (std::size_t a = 0; a < element.nodes.size(); ++a)
      if (std::abs(shares(static_cast<Eigen::Index>(a))) > kNoShare) carrying.push_back(element.nodes[a]);
    std::ranges::sort(carrying);
    sides[{materials.empty() ? 0 : materials[number], std::move(carrying)}].elements.push_back(inside);
  }
  std::vector<Probe<dim>> found;
  for (auto& [key, side] : sides) found.push_back(std::move(side));
  return found;
}

template <int dim>
typename Cosserat<dim>::Place middle_of(const Mesh<dim>& mesh, const Probe<dim>& probe) {
  typename Cosserat<dim>::Place sum = Cosserat<dim>::Place::Zero();
  for (const typename Probe<dim>::Inside& inside : probe.elements)
    sum += mesh.element_positions(inside.element).colwise().mean().transpose();
  return sum / static_cast<double>(probe.elements.size());
}

template class PlaceFinder<2>;
template class PlaceFinder<3>;
template std::vector<Probe<2>> sides_at<2>(const Mesh<2>&, const Probe<2>&, const std::vector<int>&);
template std::vector<Probe<3>> sides_at<3>(const Mesh<3>&, const Probe<3>&, const std::vector<int>&);
template Eigen::Vector2d middle_of<2>(const Mesh<2>&, const Probe<2>&);
template Eigen::Vector3d middle_of<3>(const Mesh<3>&, const Probe<3>&);

}  // namespace polargrain::fem
