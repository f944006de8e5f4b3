// SPDX-License-Identifier: GPL-2.0-or-later
#include "fem/element/element_type.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "common/error.hpp"
#include "fem/element/quadrilateral.hpp"
#include "fem/element/triangle.hpp"

namespace polargrain::fem {
namespace {

/// A new element: add its file, declare its function above, and name it here.
const std::vector<ElementType>& element_types() {
  static const std::vector<ElementType> types{quadrilateral8_reduced(), quadrilateral8(), quadrilateral4(),
                                              triangle6()};
  return types;
}

}  // namespace

std::vector<int> ElementType::side_nodes(int side) const {
  std::vector<int> nodes_of_side{side, (side + 1) % corners};
  if (nodes > corners) nodes_of_side.push_back(corners + side);
  return nodes_of_side;
}

const ElementType& element_type(std::string_view name) {
  for (const ElementType& type : element_types()) {
    if (type.name == name) return type;
  }
  throw RunError(
      fmt::format("there is no element '{}'; known are {}", name, fmt::join(element_names(), ", ")));
}

std::vector<std::string> element_names() {
  std::vector<std::string> names;
  for (const ElementType& type : element_types()) names.push_back(type.name);
  return names;
}

}  // namespace polargrain::fem
