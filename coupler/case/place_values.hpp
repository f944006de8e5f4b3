// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <string>
#include <vector>

#include "fem/mesh/mesh.hpp"

namespace polargrain::coupler {

/// A value that is read at a place inside of the body: a displacement, a micro-rotation or a component of the stress.
struct PlaceValue {
  std::string name;  ///< "u2", "s22", "m1"
  bool is_stress = false;
  int component = 0;  ///< in the order of node_dofs, or of Cosserat<dim>
  std::string unit;
};

/// All that can be read: the unknowns of a node, then stresses and couple stresses.
const std::vector<PlaceValue>& place_values(int dimension);
/// @returns null where no value has that name
const PlaceValue* place_value(const std::string& name, int dimension);
/// Their names, for messages.
std::vector<std::string> names_of_place_values(int dimension);

/// Of each element, the number of its material: a stress may jump from one to another.
/// @param regions of a case: region to material
template <int dim>
std::vector<int> numbers_of_materials(const fem::Mesh<dim>& mesh,
                                      const std::map<std::string, std::string>& regions);

/// Values along a line, written beside the fields.
struct Profile {
  std::string name;
  std::vector<std::vector<double>> places;  ///< one behind the other, m, on the mesh as it was made
  std::vector<PlaceValue> values;
};

}  // namespace polargrain::coupler
