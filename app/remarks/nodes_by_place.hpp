// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::app {

/// Some nodes of a mesh, in the order of a tree that halves them along one axis after the other (Bentley 1975): to find those in a
/// small box takes about the logarithm of their number.
template <int dim>
class NodesByPlace {
 public:
  using Place = typename Cosserat<dim>::Place;

  /// @param mesh must outlive this object and keep its nodes
  NodesByPlace(const fem::Mesh<dim>& mesh, std::vector<int> nodes) : mesh_(mesh), nodes_(std::move(nodes)) {
    halve(0, nodes_.size(), 0);
  }

  /// Calls visit(node) for all in the box, its sides included.
  template <class Visit>
  void visit_in_box(const Place& least, const Place& largest, Visit visit) const {
    visit_part(least, largest, visit, 0, nodes_.size(), 0);
  }

 private:
  [[nodiscard]] const Place& place_of(int node) const { return mesh_.nodes[static_cast<std::size_t>(node)]; }

  void halve(std::size_t begin, std::size_t end, int axis) {
    if (end - begin < 2) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const auto at = [&](std::size_t k) { return nodes_.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](int a, int b) { return place_of(a)(axis) < place_of(b)(axis); });
    halve(begin, middle, (axis + 1) % dim);
    halve(middle + 1, end, (axis + 1) % dim);
  }

  template <class Visit>
  void visit_part(const Place& least, const Place& largest, Visit& visit, std::size_t begin, std::size_t end,
                  int axis) const {
    if (begin == end) return;
    const std::size_t middle = begin + (end - begin) / 2;
    const Place& place = place_of(nodes_[middle]);
    if (least(axis) <= place(axis)) visit_part(least, largest, visit, begin, middle, (axis + 1) % dim);
    if ((place.array() >= least.array()).all() && (place.array() <= largest.array()).all())
      visit(nodes_[middle]);
    if (place(axis) <= largest(axis)) visit_part(least, largest, visit, middle + 1, end, (axis + 1) % dim);
  }

  const fem::Mesh<dim>& mesh_;
  std::vector<int> nodes_;
};

}  // namespace polargrain::app
