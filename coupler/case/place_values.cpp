// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/place_values.hpp"

#include <algorithm>

#include "common/cosserat.hpp"
#include "fem/element/dofs.hpp"

namespace polargrain::coupler {
namespace {

template <int dim>
std::vector<PlaceValue> all_values() {
  std::vector<PlaceValue> values;
  for (const fem::Dof dof : fem::node_dofs<dim>())
    values.push_back({std::string(fem::name_of<dim>(dof)), false, static_cast<int>(fem::place_of<dim>(dof)),
                      fem::is_rotation(dof) ? "rad" : "m"});
  const std::vector<std::string> stresses =
      dim == 2 ? std::vector<std::string>{"s11", "s22", "s33", "s12", "s21"}
               : std::vector<std::string>{"s11", "s12", "s13", "s21", "s22", "s23", "s31", "s32", "s33"};
  const std::vector<std::string> couples =
      dim == 2 ? std::vector<std::string>{"m1", "m2"}
               : std::vector<std::string>{"m11", "m12", "m13", "m21", "m22", "m23", "m31", "m32", "m33"};
  int component = 0;
  for (const std::string& name : stresses) values.push_back({name, true, component++, "Pa"});
  for (const std::string& name : couples) values.push_back({name, true, component++, "N/m"});
  return values;
}

}  // namespace

const std::vector<PlaceValue>& place_values(int dimension) {
  static const std::vector<PlaceValue> plane = all_values<2>();
  static const std::vector<PlaceValue> space = all_values<3>();
  return dimension == 2 ? plane : space;
}

const PlaceValue* place_value(const std::string& name, int dimension) {
  const std::vector<PlaceValue>& known = place_values(dimension);
  const auto found = std::ranges::find(known, name, &PlaceValue::name);
  return found == known.end() ? nullptr : &*found;
}

std::vector<std::string> names_of_place_values(int dimension) {
  std::vector<std::string> names;
  for (const PlaceValue& value : place_values(dimension)) names.push_back(value.name);
  return names;
}

template <int dim>
std::vector<int> numbers_of_materials(const fem::Mesh<dim>& mesh,
                                      const std::map<std::string, std::string>& regions) {
  std::map<std::string, int> numbers;
  std::vector<int> of_elements(mesh.elements.size(), 0);
  for (const auto& [region, material] : regions) {
    const auto known = mesh.regions.find(region);
    if (known == mesh.regions.end()) continue;
    const int number = numbers.try_emplace(material, static_cast<int>(numbers.size()) + 1).first->second;
    for (const int element : known->second) of_elements[static_cast<std::size_t>(element)] = number;
  }
  return of_elements;
}

template std::vector<int> numbers_of_materials<2>(const fem::Mesh<2>&,
                                                  const std::map<std::string, std::string>&);
template std::vector<int> numbers_of_materials<3>(const fem::Mesh<3>&,
                                                  const std::map<std::string, std::string>&);

}  // namespace polargrain::coupler
