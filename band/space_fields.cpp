// SPDX-License-Identifier: GPL-2.0-or-later
#include "band/space_fields.hpp"

#include "common/error.hpp"
#include "fem/element/kinematics.hpp"
#include "fem/output/read_vtu.hpp"

namespace polargrain::band {
namespace {

/// The values of a field at the nodes of an element, a row a node.
Eigen::MatrixX3d rows_of(const fem::Field& field, const fem::Element<3>& element) {
  Eigen::MatrixX3d rows(static_cast<Eigen::Index>(element.nodes.size()), 3);
  for (std::size_t a = 0; a < element.nodes.size(); ++a)
    rows.row(static_cast<Eigen::Index>(a)) =
        Eigen::Map<const Eigen::RowVector3d>(&field.values[3 * static_cast<std::size_t>(element.nodes[a])]);
  return rows;
}

/// A field of vectors at the nodes.
const fem::Field* vectors(const fem::FieldFile<3>& file, const char* name) {
  const fem::Field* const field = fem::find_field(file.fields.points, name);
  return field != nullptr && field->components == 3 ? field : nullptr;
}

}  // namespace

bool is_of_space(const std::filesystem::path& file) {
  return fem::dimension_of_vtu(file) == 3;
}

SpaceSamples space_increment(const std::filesystem::path& from, const std::filesystem::path& to,
                             bool current) {
  const fem::FieldFile<3> first = fem::read_vtu<3>(from);
  const fem::FieldFile<3> last = fem::read_vtu<3>(to);
  const fem::Field* const before = vectors(first, "displacement");
  const fem::Field* const after = vectors(last, "displacement");
  if (before == nullptr || after == nullptr)
    throw InputError({(before == nullptr ? from : to).string(), 0,
                      "a field file of `polargrain run` was expected: there are no displacements"});
  if (first.mesh.nodes.size() != last.mesh.nodes.size() ||
      first.mesh.elements.size() != last.mesh.elements.size())
    throw InputError({to.string(), 0, "the mesh differs from the frame before"});
  const fem::Field* const turned_before = vectors(first, "micro_rotation_vector");
  const fem::Field* const turned_after = vectors(last, "micro_rotation_vector");
  SpaceSamples samples;
  for (std::size_t e = 0; e < first.mesh.elements.size(); ++e) {
    const fem::Element<3>& element = first.mesh.elements[e];
    const Eigen::MatrixX3d start = rows_of(*before, element);
    const Eigen::MatrixX3d moved = rows_of(*after, element) - start;
    Eigen::MatrixX3d turned = Eigen::MatrixX3d::Zero(start.rows(), 3);
    if (turned_before != nullptr && turned_after != nullptr)
      turned = rows_of(*turned_after, element) - rows_of(*turned_before, element);
    for (const fem::PointGeometry<3>& point :
         fem::point_geometries<3>(*element.type, first.mesh.element_positions(static_cast<int>(e)))) {
      const Eigen::Matrix3d gradient = moved.transpose() * point.gradient;
      SpaceSample sample;
      sample.position = point.position;
      if (current) sample.position += start.transpose() * point.shape;
      sample.volume = point.volume;
      sample.shear = shear_strain(gradient);
      sample.volume_strain = gradient.trace();
      sample.rotation = turned.transpose() * point.shape;
      samples.push_back(sample);
    }
  }
  return samples;
}

}  // namespace polargrain::band
