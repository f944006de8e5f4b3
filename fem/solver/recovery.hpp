// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <optional>
#include <vector>

#include "fem/material/point_mean.hpp"
#include "fem/mesh/find_place.hpp"
#include "fem/solver/end_of_run.hpp"

namespace polargrain::fem {

/// Brings values at the integration points of a mesh to any place: at each node the linear function nearest to the points of the
/// elements around it (Zienkiewicz and Zhu 1992), between nodes the shape functions of the corners. Each region for
/// itself, so that nothing is smeared over a boundary between materials. Linear fields come out as they are.
template <int dim>
class Recovery {
 public:
  /// @param end must outlive this object
  explicit Recovery(const EndOfRun<dim>& end);

  struct Found {
    PointMean mean;      ///< of points of the region's material
    bool is_recovered;   ///< else the place lies outside of the region, and the mean is its nearest point
    double distance;     ///< to the nearest point, m
    std::size_t number;  ///< of the nearest point, in the order of EndOfRun::points
  };
  /// @param place m @param region one that has elements at the end
  [[nodiscard]] Found at(const typename Cosserat<dim>::Place& place, std::size_t region);
  /// Whether elements of the region are there at the end.
  [[nodiscard]] bool has(std::size_t region) const { return !points_of_region_[region].empty(); }
  /// The element at the end that has a place, or is nearest to it where that lies a little outside of the body.
  [[nodiscard]] std::optional<typename Probe<dim>::Inside> element_at(
      const typename Cosserat<dim>::Place& place) const;

 private:
  using Weights = std::map<std::size_t, double>;  ///< by number of the point
  const Weights& of_node(int node, std::size_t region);
  [[nodiscard]] Weights fitted(int node, std::size_t region) const;

  const EndOfRun<dim>& end_;
  std::vector<typename EndOfRun<dim>::Point> points_;
  PlaceFinder<dim> finder_;
  std::vector<std::vector<std::size_t>>
      points_of_region_;                  ///< numbers by the first coordinate, those that are there
  std::vector<std::size_t> first_point_;  ///< of each element
  std::vector<std::vector<int>> elements_of_node_;
  std::map<std::pair<std::size_t, int>, Weights> of_nodes_;  ///< by region and node
};

}  // namespace polargrain::fem
