// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/element_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"
#include "fem/element/hexahedron.hpp"
#include "fem/element/quadrilateral.hpp"
#include "fem/element/tetrahedron.hpp"
#include "fem/element/triangle.hpp"
#include "fem/element/wedge.hpp"

namespace polargrain::fem {
namespace {

/// A new element: add its file, declare its function above, and name it here. The first is the one recommended.
template <int dim>
const std::vector<ElementType<dim>>& element_types() {
  if constexpr (dim == 2) {
    static const std::vector<ElementType<2>> types{quadrilateral8_reduced(), quadrilateral8(),
                                                   quadrilateral4(), triangle6(), quadrilateral4_one_point()};
    return types;
  } else {
    static const std::vector<ElementType<3>> types{
        hexahedron20_reduced(), hexahedron20(), hexahedron8(),
        tetrahedron10(),        wedge15(),      hexahedron8_one_point()};
    return types;
  }
}

}  // namespace

template <int dim>
const ElementType<dim>& element_type(std::string_view name) {
  for (const ElementType<dim>& type : element_types<dim>()) {
    if (type.name == name) return type;
  }
  throw RunError(
      fmt::format("there is no element '{}'; known are {}", name, fmt::join(element_names<dim>(), ", ")));
}

template <int dim>
std::vector<std::string> element_names() {
  std::vector<std::string> names;
  for (const ElementType<dim>& type : element_types<dim>()) names.push_back(type.name);
  return names;
}

template const ElementType<2>& element_type<2>(std::string_view name);
template const ElementType<3>& element_type<3>(std::string_view name);
template std::vector<std::string> element_names<2>();
template std::vector<std::string> element_names<3>();

}  // namespace polargrain::fem
