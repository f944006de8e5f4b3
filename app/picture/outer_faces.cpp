// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/picture/outer_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace polargrain::app {
namespace {

std::vector<int> corners_of(const fem::Mesh<3>& mesh, const fem::BoundarySide& side) {
  std::vector<int> nodes = mesh.side_nodes(side);
  nodes.resize(static_cast<std::size_t>(mesh.side_of(side).type->corners));
  return nodes;
}

OuterFace face_of(const fem::Mesh<3>& mesh, int element, std::vector<int> corners) {
  OuterFace face{element, std::move(corners), {}, Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero(), 0.0};
  const auto at = [&](std::size_t k) -> const Eigen::Vector3d& {
    return mesh.nodes[static_cast<std::size_t>(face.corners[k % face.corners.size()])];
  };
  for (std::size_t k = 0; k < face.corners.size(); ++k) {
    face.centre += at(k) / static_cast<double>(face.corners.size());
    face.normal += 0.5 * at(k).cross(at(k + 1));
  }
  face.area = face.normal.norm();
  if (face.area > 0.0) face.normal /= face.area;
  return face;
}

}  // namespace

std::vector<OuterFace> outer_faces(const fem::Mesh<3>& mesh) {
  std::map<std::vector<int>, int> uses;  // of a face, by its corners in ascending order
  const auto sorted = [](std::vector<int> corners) {
    std::ranges::sort(corners);
    return corners;
  };
  const auto visit = [&](auto&& each) {
    for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
      const auto sides = static_cast<int>(mesh.elements[static_cast<std::size_t>(e)].type->sides.size());
      for (int side = 0; side < sides; ++side) each(fem::BoundarySide{e, side});
    }
  };
  visit([&](const fem::BoundarySide& side) { ++uses[sorted(corners_of(mesh, side))]; });
  std::map<std::pair<int, int>, std::vector<std::string>> names;
  for (const auto& [name, sides] : mesh.boundaries)
    for (const fem::BoundarySide& side : sides) names[{side.element, side.side}].push_back(name);
  std::vector<OuterFace> faces;
  visit([&](const fem::BoundarySide& side) {
    std::vector<int> corners = corners_of(mesh, side);
    if (uses[sorted(corners)] > 1) return;
    faces.push_back(face_of(mesh, side.element, std::move(corners)));
    if (const auto named = names.find({side.element, side.side}); named != names.end())
      faces.back().names = named->second;
  });
  return faces;
}

}  // namespace polargrain::app
