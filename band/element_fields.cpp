// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <Eigen/LU>

#include "band/frames.hpp"
#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/output/read_vtu.hpp"

namespace polargrain::band {
namespace {

/// The values at the nodes of an element, a row a node.
struct Nodes {
  Eigen::MatrixX2d places;
  Eigen::MatrixX2d displacements;
  Eigen::VectorXd rotations;
};

void add_points(const fem::ElementType<2>& type, const Nodes& nodes, Frame& frame) {
  for (const fem::PointGeometry<2>& point : fem::point_geometries(type, nodes.places)) {
    frame.positions.push_back(point.position);
    frame.displacements.emplace_back(nodes.displacements.transpose() * point.shape);
    frame.strains.emplace_back(nodes.displacements.transpose() * point.gradient);
    frame.areas.push_back(point.volume);
    frame.rotations.push_back(nodes.rotations.dot(point.shape));
  }
}

/// A triangle as a whole: the mean gradient follows from the displacements of its corners, which is what a
/// triangle with straight sides has in the middle.
void add_triangle(const Nodes& nodes, Frame& frame) {
  const auto sides = [](const Eigen::MatrixX2d& rows) {
    Eigen::Matrix2d columns;
    columns << (rows.row(1) - rows.row(0)).transpose(), (rows.row(2) - rows.row(0)).transpose();
    return columns;
  };
  const Eigen::Matrix2d of_places = sides(nodes.places);
  frame.positions.emplace_back(nodes.places.topRows<3>().colwise().mean());
  frame.displacements.emplace_back(nodes.displacements.topRows<3>().colwise().mean());
  frame.strains.emplace_back(sides(nodes.displacements) * of_places.inverse());
  frame.areas.push_back(0.5 * std::abs(of_places.determinant()));
  frame.rotations.push_back(nodes.rotations.head<3>().mean());
}

}  // namespace

Frame read_element_fields(const std::filesystem::path& path) {
  const fem::FieldFile<2> file = fem::read_vtu(path);
  const fem::Field* const displacement = fem::find_field(file.fields.points, "displacement");
  const fem::Field* const rotation = fem::find_field(file.fields.points, "micro_rotation");
  if (displacement == nullptr || displacement->components != 3)
    throw InputError(
        {path.string(), 0, "a field file of `polargrain run` was expected: there are no displacements"});
  Frame frame;
  for (std::size_t e = 0; e < file.mesh.elements.size(); ++e) {
    const fem::Element<2>& element = file.mesh.elements[e];
    const auto count = static_cast<Eigen::Index>(element.nodes.size());
    Nodes nodes{file.mesh.element_positions(static_cast<int>(e)), Eigen::MatrixX2d(count, 2),
                Eigen::VectorXd::Zero(count)};
    for (Eigen::Index a = 0; a < count; ++a) {
      const auto node = static_cast<std::size_t>(element.nodes[static_cast<std::size_t>(a)]);
      nodes.displacements.row(a) << displacement->values[3 * node], displacement->values[3 * node + 1];
      if (rotation != nullptr && rotation->components == 1) nodes.rotations(a) = rotation->values[node];
    }
    element.type->corners == 3 ? add_triangle(nodes, frame) : add_points(*element.type, nodes, frame);
  }
  return frame;
}

}  // namespace polargrain::band
