// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/rectangle.hpp"

#include <fmt/format.h>

#include <numeric>

#include "common/error.hpp"

namespace polargrain::fem {
namespace {

/// Numbers nodes on a grid of half-element spacing, only where some element has a node.
class HalfGridOfSquares {
 public:
  HalfGridOfSquares(const RectangleSpecification& specification, Mesh<2>& mesh)
      : specification_(specification),
        width_(2 * specification.elements[0] + 1),
        numbers_(static_cast<std::size_t>(width_ * (2 * specification.elements[1] + 1)), -1),
        mesh_(mesh) {}

  int node(int i, int j) {
    int& number = numbers_[static_cast<std::size_t>(j * width_ + i)];
    if (number < 0) {
      number = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back(specification_.origin +
                            Eigen::Vector2d(specification_.size[0] * i / (2.0 * specification_.elements[0]),
                                            specification_.size[1] * j / (2.0 * specification_.elements[1])));
    }
    return number;
  }

 private:
  const RectangleSpecification& specification_;
  int width_;
  std::vector<int> numbers_;
  Mesh<2>& mesh_;
};

using GridPlaces = std::vector<std::array<int, 2>>;

/// Grid places of the nodes of the elements of one rectangle, relative to its lower left corner.
std::vector<GridPlaces> places_in_rectangle(const ElementType<2>& type) {
  if (type.corners == 3) {
    return {{{0, 0}, {2, 0}, {2, 2}, {1, 0}, {2, 1}, {1, 1}},
            {{0, 0}, {2, 2}, {0, 2}, {1, 1}, {1, 2}, {0, 1}}};
  }
  GridPlaces places{{0, 0}, {2, 0}, {2, 2}, {0, 2}, {1, 0}, {2, 1}, {1, 2}, {0, 1}};
  places.resize(static_cast<std::size_t>(type.nodes));
  return {places};
}

void check(const RectangleSpecification& specification) {
  for (const int i : {0, 1}) {
    if (!(specification.size[i] > 0.0)) {
      throw RunError(fmt::format("the size of a rectangle must be positive, not {}", specification.size[i]));
    }
    if (specification.elements[i] < 1) {
      throw RunError(
          fmt::format("a rectangle needs at least 1 element each way, not {}", specification.elements[i]));
    }
  }
}

}  // namespace

Mesh<2> rectangle(const RectangleSpecification& specification, std::string_view element) {
  check(specification);
  const ElementType<2>& type = element_type<2>(element);
  const std::vector<GridPlaces> parts = places_in_rectangle(type);
  const auto [columns, rows] = specification.elements;
  Mesh<2> mesh;
  HalfGridOfSquares grid(specification, mesh);
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const int first = static_cast<int>(mesh.elements.size());
      for (const GridPlaces& places : parts) {
        Element<2>& added = mesh.elements.emplace_back(Element<2>{&type, {}});
        for (const auto& [i, j] : places) added.nodes.push_back(grid.node(2 * column + i, 2 * row + j));
      }
      // A rectangle of two triangles: the first has the bottom and right sides, the second top and left.
      const bool triangles = parts.size() == 2;
      if (row == 0) mesh.boundaries["bottom"].push_back({first, 0});
      if (column == columns - 1) mesh.boundaries["right"].push_back({first, 1});
      if (row == rows - 1)
        mesh.boundaries["top"].push_back(triangles ? BoundarySide{first + 1, 1} : BoundarySide{first, 2});
      if (column == 0)
        mesh.boundaries["left"].push_back(triangles ? BoundarySide{first + 1, 2} : BoundarySide{first, 3});
    }
  }
  mesh.node_sets["bottom_left"] = {grid.node(0, 0)};
  mesh.node_sets["bottom_right"] = {grid.node(2 * columns, 0)};
  mesh.node_sets["top_right"] = {grid.node(2 * columns, 2 * rows)};
  mesh.node_sets["top_left"] = {grid.node(0, 2 * rows)};
  mesh.node_sets["all"].resize(mesh.nodes.size());
  std::iota(mesh.node_sets["all"].begin(), mesh.node_sets["all"].end(), 0);
  mesh.regions["all"].resize(mesh.elements.size());
  std::iota(mesh.regions["all"].begin(), mesh.regions["all"].end(), 0);
  return mesh;
}

std::vector<int> elements_between(const Mesh<2>& mesh, const Eigen::Vector2d& low,
                                  const Eigen::Vector2d& high) {
  std::vector<int> found;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const Eigen::Vector2d centre = mesh.element_positions(e).colwise().mean();
    if ((centre.array() >= low.array()).all() && (centre.array() <= high.array()).all()) found.push_back(e);
  }
  return found;
}

}  // namespace polargrain::fem
