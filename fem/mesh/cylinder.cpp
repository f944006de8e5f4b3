// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/mesh/cylinder.hpp"

#include <fmt/format.h>

#include <array>
#include <map>
#include <numbers>
#include <numeric>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "fem/mesh/block.hpp"

namespace polargrain::fem {
namespace {

using Sector = CylinderSpecification::Sector;

/// Half the side of the inner square over the radius, and by how much of it the sides bulge: the three elements that meet at its
/// corners then have angles near 120 degrees.
constexpr double kSquare = 0.45;
constexpr double kBulge = 0.12;

/// Planes and surfaces that a node lies on.
struct PlaceInCylinder {
  bool bottom, top, side;
  int x1, x2;  ///< signs of the coordinates: -1, 0 or 1
};

/// Numbers the nodes on two grids of half-element spacing: of the inner square, and of the rings (outwards, around).
class Grids {
 public:
  Grids(const CylinderSpecification& specification, Mesh<3>& mesh)
      : specification_(specification), mesh_(mesh) {}

  /// @param at places from the corner at -x1, -x2, and the height
  int in_square(const GridPlace& at) {
    const int n = specification_.quarter;
    return number({0, at[0], at[1], at[2]}, in_square(at[0] - n, at[1] - n), at[2], false);
  }

  /// @param at rings from the square, places around from the corner at +x1, -x2 counter-clockwise, and the height
  int in_rings(const GridPlace& at) {
    const int n = specification_.quarter;
    const int around = at[1] % (8 * n);
    const int turns = around / (2 * n);
    const int along = around % (2 * n) - n;
    if (at[0] == 0) {
      const std::array<int, 2> square = turned<int>({n, along}, turns);
      return in_square(GridPlace{square[0] + n, square[1] + n, at[2]});
    }
    const double angle = 0.25 * std::numbers::pi * along / n;
    const double share = at[0] / (2.0 * specification_.rings);
    const std::array<double, 2> inner = in_square(n, along);
    const std::array<double, 2> outer{specification_.radius * cosine(angle),
                                      specification_.radius * sine(angle)};
    const std::array<double, 2> place = turned<double>(
        {(1.0 - share) * inner[0] + share * outer[0], (1.0 - share) * inner[1] + share * outer[1]}, turns);
    return number({1, at[0], around, at[2]}, place, at[2], at[0] == 2 * specification_.rings);
  }

  [[nodiscard]] const PlaceInCylinder& place_of(int node) const {
    return places_[static_cast<std::size_t>(node)];
  }

 private:
  /// Quarter turns counter-clockwise, without rounding.
  template <class Number>
  static std::array<Number, 2> turned(std::array<Number, 2> place, int turns) {
    for (; turns > 0; --turns) place = {-place[1], place[0]};
    return place;
  }

  /// Position in the inner square of places counted from its middle.
  [[nodiscard]] std::array<double, 2> in_square(int first, int second) const {
    const double s = static_cast<double>(first) / specification_.quarter;
    const double t = static_cast<double>(second) / specification_.quarter;
    const double half = kSquare * specification_.radius;
    return {half * s * (1.0 + kBulge * (1.0 - t * t)), half * t * (1.0 + kBulge * (1.0 - s * s))};
  }

  int number(const std::array<int, 4>& key, const std::array<double, 2>& at, int level, bool side) {
    const auto [found, is_new] = numbers_.try_emplace(key, static_cast<int>(mesh_.nodes.size()));
    if (is_new) {
      const int levels = 2 * specification_.layers;
      mesh_.nodes.emplace_back(at[0], at[1], specification_.height * level / levels);
      const auto sign = [](double x) { return x > 0.0 ? 1 : x < 0.0 ? -1 : 0; };
      places_.push_back({level == 0, level == levels, side, sign(at[0]), sign(at[1])});
    }
    return found->second;
  }

  const CylinderSpecification& specification_;
  Mesh<3>& mesh_;
  std::map<std::array<int, 4>, int> numbers_;
  std::vector<PlaceInCylinder> places_;
};

void check(const CylinderSpecification& specification, const ElementType<3>& type) {
  for (const auto& [name, value] :
       {std::pair("radius", specification.radius), std::pair("height", specification.height)})
    if (!(value > 0.0))
      throw RunError(fmt::format("the {} of a cylinder must be positive, not {}", name, value));
  if (specification.quarter < 2 || specification.quarter % 2 != 0)
    throw RunError(
        fmt::format("a quarter of the circumference of a cylinder needs an even number of elements, not {}",
                    specification.quarter));
  if (specification.rings < 1 || specification.layers < 1)
    throw RunError(fmt::format("a cylinder needs at least 1 ring and 1 layer of elements, not {} and {}",
                               specification.rings, specification.layers));
  if (type.corners != 8)
    throw RunError(fmt::format("a cylinder is made of hexahedra (H20R, H20, H8, H8R), not of {}", type.name));
}

void name_sides(const Grids& grids, Sector sector, Mesh<3>& mesh) {
  const std::vector<std::pair<std::string, bool (*)(const PlaceInCylinder&)>> all{
      {"bottom", [](const PlaceInCylinder& at) { return at.bottom; }},
      {"top", [](const PlaceInCylinder& at) { return at.top; }},
      {"side", [](const PlaceInCylinder& at) { return at.side; }},
      {"front", [](const PlaceInCylinder& at) { return at.x2 == 0; }},
      {"left", [](const PlaceInCylinder& at) { return at.x1 == 0; }}};
  const std::size_t named = sector == Sector::whole ? 3 : sector == Sector::half ? 4 : 5;
  for (std::size_t e = 0; e < mesh.elements.size(); ++e)
    for (std::size_t side = 0; side < mesh.elements[e].type->sides.size(); ++side) {
      const BoundarySide found{static_cast<int>(e), static_cast<int>(side)};
      const std::vector<int> nodes = mesh.side_nodes(found);
      for (std::size_t face = 0; face < named; ++face)
        if (std::ranges::all_of(nodes, [&](int node) { return all[face].second(grids.place_of(node)); }))
          mesh.boundaries[all[face].first].push_back(found);
    }
}

void name_nodes(const Grids& grids, Mesh<3>& mesh) {
  for (int node = 0; node < static_cast<int>(mesh.nodes.size()); ++node) {
    const PlaceInCylinder& at = grids.place_of(node);
    const auto add = [&](const std::string& name) {
      mesh.node_sets[name].push_back(node);
      if (at.bottom) mesh.node_sets["bottom_" + name].push_back(node);
      if (at.top) mesh.node_sets["top_" + name].push_back(node);
    };
    if (at.x1 == 0 && at.x2 == 0) add("axis");
    if (!at.side) continue;
    if (at.bottom) mesh.node_sets["bottom_side"].push_back(node);
    if (at.top) mesh.node_sets["top_side"].push_back(node);
    if (at.x2 == 0) add(at.x1 > 0 ? "side_right" : "side_left");
    if (at.x1 == 0) add(at.x2 > 0 ? "side_back" : "side_front");
  }
}

}  // namespace

double number_of_elements(const CylinderSpecification& specification) {
  const double quarter = specification.quarter;
  const double whole = quarter * (quarter + 4.0 * specification.rings) * specification.layers;
  return whole / (specification.sector == Sector::whole ? 1 : specification.sector == Sector::half ? 2 : 4);
}

Mesh<3> cylinder(const CylinderSpecification& specification, std::string_view element) {
  const ElementType<3>& type = element_type<3>(element);
  check(specification, type);
  Mesh<3> mesh;
  Grids grids(specification, mesh);
  const std::vector<GridPlace> places = elements_of_block(type).front();
  const auto add = [&](const GridPlace& block, auto number) {
    Element<3>& added = mesh.elements.emplace_back(Element<3>{&type, {}});
    for (const GridPlace& at : places)
      added.nodes.push_back(
          number(GridPlace{at[0] + 2 * block[0], at[1] + 2 * block[1], at[2] + 2 * block[2]}));
  };
  const int n = specification.quarter;
  const bool half = specification.sector != Sector::whole;
  const bool quarter = specification.sector == Sector::quarter;
  // The plane x2 = 0 meets the rings in the middle of the first and of the third side of the square, x1 = 0 in between.
  const int first_around = half ? n / 2 : 0;
  const int end_around = quarter ? 3 * n / 2 : half ? 5 * n / 2 : 4 * n;
  for (int layer = 0; layer < specification.layers; ++layer) {
    for (int j = half ? n / 2 : 0; j < n; ++j)
      for (int i = quarter ? n / 2 : 0; i < n; ++i)
        add({i, j, layer}, [&](const GridPlace& at) { return grids.in_square(at); });
    for (int around = first_around; around < end_around; ++around)
      for (int ring = 0; ring < specification.rings; ++ring)
        add({ring, around, layer}, [&](const GridPlace& at) { return grids.in_rings(at); });
  }
  name_sides(grids, specification.sector, mesh);
  name_nodes(grids, mesh);
  mesh.node_sets["all"].resize(mesh.nodes.size());
  std::iota(mesh.node_sets["all"].begin(), mesh.node_sets["all"].end(), 0);
  mesh.regions["all"].resize(mesh.elements.size());
  std::iota(mesh.regions["all"].begin(), mesh.regions["all"].end(), 0);
  return mesh;
}

}  // namespace polargrain::fem
