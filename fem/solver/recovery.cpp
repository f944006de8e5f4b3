// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/solver/recovery.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <set>

#include "fem/element/corner_shape.hpp"

namespace polargrain::fem {
namespace {

/// The same place, as a share of the size of an element.
constexpr double kSamePlace = 1e-9;
/// Reference coordinate by which a node may lie outside of the old mesh: where a curve is meshed more finely.
constexpr double kBesideCurve = 0.25;

}  // namespace

template <int dim>
Recovery<dim>::Recovery(const EndOfRun<dim>& end)
    : end_(end),
      points_(end.points()),
      finder_(end.mesh),
      points_of_region_(end.material_of_region.size()),
      elements_of_node_(end.mesh.nodes.size()) {
  std::size_t first = 0;
  for (std::size_t e = 0; e < end.mesh.elements.size(); ++e) {
    first_point_.push_back(first);
    const std::size_t next = first + end.mesh.elements[e].type->quadrature.size();
    if (end.there[e] != 0) {
      for (std::size_t point = first; point < next; ++point)
        points_of_region_[end.region_of_element[e]].push_back(point);
      for (const int node : end.mesh.elements[e].nodes)
        elements_of_node_[static_cast<std::size_t>(node)].push_back(static_cast<int>(e));
    }
    first = next;
  }
  first_point_.push_back(first);
  for (std::vector<std::size_t>& points : points_of_region_)
    std::ranges::stable_sort(points, {}, [&](std::size_t point) { return points_[point].place(0); });
}

template <int dim>
typename Recovery<dim>::Weights Recovery<dim>::fitted(int node, std::size_t region) const {
  const auto& origin = end_.mesh.nodes[static_cast<std::size_t>(node)];
  // Elements around the node; where their points do not span a linear function, those around these too.
  std::set<int> patch;
  const auto add_around = [&](int of) {
    for (const int e : elements_of_node_[static_cast<std::size_t>(of)])
      if (end_.region_of_element[static_cast<std::size_t>(e)] == region) patch.insert(e);
  };
  add_around(node);
  for (std::size_t before = 0;;) {
    std::vector<std::size_t> points;
    double size = 0.0;
    for (const int e : patch)
      for (auto point = first_point_[static_cast<std::size_t>(e)];
           point < first_point_[static_cast<std::size_t>(e) + 1]; ++point) {
        points.push_back(point);
        size = std::max(size, (points_[point].place - origin).norm());
      }
    Eigen::MatrixXd terms(static_cast<Eigen::Index>(points.size()), dim + 1);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto row = static_cast<Eigen::Index>(k);
      terms(row, 0) = 1.0;
      terms.row(row).template tail<dim>() = (points_[points[k]].place - origin).transpose() / size;
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(terms);
    constexpr double kDependent = 1e-6;
    factors.setThreshold(kDependent);
    const bool spans = factors.rank() == dim + 1;
    if (!spans && patch.size() > before) {
      before = patch.size();
      for (const int e : std::set<int>(patch))
        for (const int other : end_.mesh.elements[static_cast<std::size_t>(e)].nodes) add_around(other);
      if (patch.size() > before) continue;
    }
    // At the node all terms but the first are zero. A region of one point, or of points on a line, has their mean.
    Weights weights;
    const Eigen::RowVectorXd first =
        spans
            ? Eigen::RowVectorXd(factors.solve(Eigen::MatrixXd::Identity(terms.rows(), terms.rows())).row(0))
            : Eigen::RowVectorXd::Constant(terms.rows(), 1.0 / static_cast<double>(terms.rows()));
    for (std::size_t k = 0; k < points.size(); ++k) weights[points[k]] = first(static_cast<Eigen::Index>(k));
    return weights;
  }
}

template <int dim>
const typename Recovery<dim>::Weights& Recovery<dim>::of_node(int node, std::size_t region) {
  const auto [place, is_new] = of_nodes_.try_emplace({region, node});
  if (is_new) place->second = fitted(node, region);
  return place->second;
}

template <int dim>
typename Recovery<dim>::Found Recovery<dim>::at(const typename Cosserat<dim>::Place& place,
                                                std::size_t region) {
  const std::vector<std::size_t>& near = points_of_region_[region];
  // Looking away from the place ends where the first coordinate alone is farther than the nearest point found.
  const auto middle = std::ranges::lower_bound(near, place(0), {},
                                               [&](std::size_t point) { return points_[point].place(0); });
  double least = HUGE_VAL;
  std::size_t nearest = 0;
  const auto look = [&](std::size_t point) {
    const double along = points_[point].place(0) - place(0);
    if (along * along > least) return false;
    const double square = (points_[point].place - place).squaredNorm();
    if (square < least || (square == least && point < nearest)) least = square, nearest = point;
    return true;
  };
  for (auto next = middle; next != near.end() && look(*next);) ++next;
  for (auto next = middle; next != near.begin() && look(*(next - 1));) --next;
  Found found{
      {points_[nearest].of_material, {{points_[nearest].of_material, 1.0}}}, true, std::sqrt(least), nearest};
  const VectorRows<dim> around = end_.mesh.element_positions(points_[nearest].element);
  if (found.distance <= kSamePlace * (around.colwise().maxCoeff() - around.colwise().minCoeff()).norm())
    return found;
  for (const auto& inside : finder_.find(place).elements) {
    const auto e = static_cast<std::size_t>(inside.element);
    if (end_.there[e] == 0 || end_.region_of_element[e] != region) continue;
    const Element<dim>& element = end_.mesh.elements[e];
    const Eigen::VectorXd shape = corner_shape_functions<dim>(*element.type, inside.reference).value;
    Weights weights;
    for (int a = 0; a < element.type->corners; ++a)
      for (const auto& [point, weight] : of_node(element.nodes[static_cast<std::size_t>(a)], region))
        weights[points_[point].of_material] += shape(a) * weight;
    found.mean.parts.assign(weights.begin(), weights.end());
    return found;
  }
  found.is_recovered = false;
  return found;
}

template <int dim>
std::optional<typename Probe<dim>::Inside> Recovery<dim>::element_at(
    const typename Cosserat<dim>::Place& place) const {
  for (const Probe<dim>& probe : {finder_.find(place), finder_.find(place, kBesideCurve)})
    for (const auto& inside : probe.elements)
      if (end_.there[static_cast<std::size_t>(inside.element)] != 0) return inside;
  return {};
}

template class Recovery<2>;
template class Recovery<3>;

}  // namespace polargrain::fem
