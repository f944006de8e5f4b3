// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/remarks/body.hpp"

#include <cmath>

#include "fem/element/kinematics.hpp"
#include "fem/mesh/box_around.hpp"

namespace polargrain::app {
namespace {

/// Area, or volume, of an element.
template <int dim>
double size_of(const fem::Mesh<dim>& mesh, int element) {
  double size = 0.0;
  for (const fem::PointGeometry<dim>& point : fem::point_geometries<dim>(
           *mesh.elements[static_cast<std::size_t>(element)].type, mesh.element_positions(element)))
    size += point.volume;
  return size;
}

}  // namespace

template <int dim>
Body body_of(const fem::Mesh<dim>& mesh) {
  const auto [least, largest] = fem::box_around(mesh);
  Body body{{}, 0.0, {}, least(dim - 1), largest(dim - 1)};
  for (int i = 0; i < dim; ++i) body.sides.push_back(largest(i) - least(i));
  const auto side_of = [](double size) { return dim == 2 ? std::sqrt(size) : std::cbrt(size); };
  double sum = 0.0;
  for (int e = 0; e < static_cast<int>(mesh.elements.size()); ++e) {
    const double of = size_of(mesh, e);
    sum += of;
    body.elements.push_back(side_of(of));
  }
  body.mean_element = side_of(sum / static_cast<double>(body.elements.size()));
  return body;
}

template Body body_of(const fem::Mesh<2>&);
template Body body_of(const fem::Mesh<3>&);

}  // namespace polargrain::app
