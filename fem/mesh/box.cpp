// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/box.hpp"

#include <fmt/format.h>

#include <numeric>

#include "common/error.hpp"
#include "fem/mesh/block.hpp"

namespace polargrain::fem {
namespace {

/// Numbers nodes on a grid of half-element spacing, only where some element has a node.
class HalfGridOfCubes {
 public:
  HalfGridOfCubes(const BoxSpecification& specification, Mesh<3>& mesh)
      : specification_(specification), mesh_(mesh) {
    std::size_t places = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      counts_[i] = 2 * specification.elements[i] + 1;
      places *= static_cast<std::size_t>(counts_[i]);
    }
    numbers_.assign(places, -1);
  }

  int node(const GridPlace& at) {
    int& number = numbers_[index(at)];
    if (number < 0) {
      number = static_cast<int>(mesh_.nodes.size());
      Eigen::Vector3d position = specification_.origin;
      for (std::size_t i = 0; i < 3; ++i)
        position(static_cast<Eigen::Index>(i)) +=
            specification_.size[i] * at[i] / (2.0 * specification_.elements[i]);
      mesh_.nodes.push_back(position);
    }
    return number;
  }

  /// Nodes whose place along each axis is the first (0), the last (1) or any (-1).
  [[nodiscard]] std::vector<int> nodes(const GridPlace& ends) const {
    std::vector<int> found;
    GridPlace at{};
    for (at[2] = 0; at[2] < counts_[2]; ++at[2])
      for (at[1] = 0; at[1] < counts_[1]; ++at[1])
        for (at[0] = 0; at[0] < counts_[0]; ++at[0]) {
          bool wanted = numbers_[index(at)] >= 0;
          for (std::size_t i = 0; i < 3; ++i)
            wanted = wanted && (ends[i] < 0 || at[i] == (ends[i] == 0 ? 0 : counts_[i] - 1));
          if (wanted) found.push_back(numbers_[index(at)]);
        }
    return found;
  }

 private:
  [[nodiscard]] std::size_t index(const GridPlace& at) const {
    return static_cast<std::size_t>((at[2] * counts_[1] + at[1]) * counts_[0] + at[0]);
  }

  const BoxSpecification& specification_;
  Mesh<3>& mesh_;
  GridPlace counts_{};
  std::vector<int> numbers_;
};

void check(const BoxSpecification& specification) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(specification.size[i] > 0.0))
      throw RunError(fmt::format("the size of a box must be positive, not {}", specification.size[i]));
    if (specification.elements[i] < 1)
      throw RunError(
          fmt::format("a box needs at least 1 element each way, not {}", specification.elements[i]));
  }
}

struct Face {
  const char* name;
  std::size_t axis;
  int end;
};
constexpr std::array<Face, 6> kFacesOfBox{
    {{"left", 0, 0}, {"right", 0, 1}, {"front", 1, 0}, {"back", 1, 1}, {"bottom", 2, 0}, {"top", 2, 1}}};

void name_edges_and_corners(const HalfGridOfCubes& grid, Mesh<3>& mesh) {
  // In the order of names: bottom or top, front or back, left or right.
  const std::array<std::array<std::string, 2>, 3> names{
      {{"left", "right"}, {"front", "back"}, {"bottom", "top"}}};
  for (int x = -1; x < 2; ++x)
    for (int y = -1; y < 2; ++y)
      for (int z = -1; z < 2; ++z) {
        const GridPlace ends{x, y, z};
        std::string name;
        int given = 0;
        for (const std::size_t axis : {2U, 1U, 0U}) {
          if (ends[axis] < 0) continue;
          name += (name.empty() ? "" : "_") + names[axis][static_cast<std::size_t>(ends[axis])];
          ++given;
        }
        if (given >= 2) mesh.node_sets[name] = grid.nodes(ends);
      }
}

}  // namespace

Mesh<3> box(const BoxSpecification& specification, std::string_view element) {
  check(specification);
  const ElementType<3>& type = element_type<3>(element);
  const std::vector<std::vector<GridPlace>> parts = elements_of_block(type);
  Mesh<3> mesh;
  HalfGridOfCubes grid(specification, mesh);
  GridPlace block{};
  for (block[2] = 0; block[2] < specification.elements[2]; ++block[2]) {
    for (block[1] = 0; block[1] < specification.elements[1]; ++block[1]) {
      for (block[0] = 0; block[0] < specification.elements[0]; ++block[0]) {
        for (std::vector<GridPlace> places : parts) {
          for (GridPlace& at : places)
            for (std::size_t i = 0; i < 3; ++i) at[i] += 2 * block[i];
          const int number = static_cast<int>(mesh.elements.size());
          Element<3>& added = mesh.elements.emplace_back(Element<3>{&type, {}});
          for (const GridPlace& at : places) added.nodes.push_back(grid.node(at));
          for (const Face& face : kFacesOfBox) {
            const int place = face.end == 0 ? 0 : 2 * specification.elements[face.axis];
            for (std::size_t side = 0; side < type.sides.size(); ++side) {
              bool on_face = true;
              for (const int node : type.sides[side].nodes)
                on_face = on_face && places[static_cast<std::size_t>(node)][face.axis] == place;
              if (on_face) mesh.boundaries[face.name].push_back({number, static_cast<int>(side)});
            }
          }
        }
      }
    }
  }
  name_edges_and_corners(grid, mesh);
  mesh.node_sets["all"].resize(mesh.nodes.size());
  std::iota(mesh.node_sets["all"].begin(), mesh.node_sets["all"].end(), 0);
  mesh.regions["all"].resize(mesh.elements.size());
  std::iota(mesh.regions["all"].begin(), mesh.regions["all"].end(), 0);
  return mesh;
}

}  // namespace polargrain::fem
