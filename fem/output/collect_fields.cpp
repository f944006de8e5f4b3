// SPDX-License-Identifier: GPL-2.0-or-later
#include <algorithm>
#include <cmath>
#include <map>

#include "fem/output/vtu.hpp"

namespace polargrain::fem {
namespace {

/// sqrt(2/3 e_ij e_ij) with e the deviator of the symmetric strain, eps_33 = 0.
double deviatoric_strain(const Vector7& strain) {
  const double mean = (strain(k11) + strain(k22) + strain(k33)) / 3.0;
  const double shear = 0.5 * (strain(k12) + strain(k21));
  double square = 2.0 * shear * shear;
  for (const int i : {k11, k22, k33}) square += (strain(i) - mean) * (strain(i) - mean);
  return std::sqrt(2.0 / 3.0 * square);
}

/// Averages over the volume of each element of a quantity with several components at each point.
template <class Quantity>
Field element_averages(const Solver& solver, std::string name, int components, Quantity quantity) {
  const std::size_t elements = solver.problem().mesh.elements.size();
  const auto width = static_cast<std::size_t>(components);
  Field field{std::move(name), components, std::vector<double>(elements * width, 0.0)};
  std::vector<double> volume(elements, 0.0);
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto e = static_cast<std::size_t>(solver.element_of_point(point));
    volume[e] += solver.volume_of_point(point);
    for (std::size_t i = 0; i < width; ++i) {
      field.values[e * width + i] += solver.volume_of_point(point) * quantity(point, static_cast<int>(i));
    }
  }
  for (std::size_t i = 0; i < field.values.size(); ++i) field.values[i] /= volume[i / width];
  return field;
}

std::vector<Field> nodal_fields(const Solver& solver) {
  Field displacement{"displacement", 3, {}};
  Field rotation{"micro_rotation", 1, {}};
  const Eigen::VectorXd& values = solver.state().displacement;
  for (Eigen::Index i = 0; i < values.size(); i += 3) {
    displacement.values.insert(displacement.values.end(), {values(i), values(i + 1), 0.0});
    rotation.values.push_back(values(i + 2));
  }
  return {std::move(displacement), std::move(rotation)};
}

/// All names that some material shows, each once, in the order of the points.
std::vector<std::string> material_field_names(const Solver& solver) {
  std::vector<const Material*> seen;
  std::vector<std::string> names;
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const Material* material = solver.material_of_point(point).first;
    if (std::find(seen.begin(), seen.end(), material) != seen.end()) continue;
    seen.push_back(material);
    for (std::string& name : material->field_names()) {
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(std::move(name));
    }
  }
  return names;
}

/// Value by point of each named field; 0 where the material does not have it.
std::map<std::string, std::vector<double>> material_values(const Solver& solver,
                                                           const std::vector<std::string>& names) {
  std::map<std::string, std::vector<double>> values;
  for (const std::string& name : names) values[name].assign(solver.points(), 0.0);
  for (std::size_t point = 0; point < solver.points(); ++point) {
    const auto [material, number] = solver.material_of_point(point);
    const std::vector<std::string> own = material->field_names();
    std::vector<double> own_values(own.size(), 0.0);
    material->fields(number, own_values);
    for (std::size_t i = 0; i < own.size(); ++i) values[own[i]][point] = own_values[i];
  }
  return values;
}

}  // namespace

Fields collect_fields(const Solver& solver) {
  const SolverState& state = solver.state();
  const auto stress = [&](std::size_t point, int i) { return state.responses[point].stress(i); };
  const auto strain = [&](std::size_t point, int i) { return state.strain[point](i); };
  Fields fields;
  fields.points = nodal_fields(solver);
  fields.cells.push_back(element_averages(solver, "stress", 5, stress));
  fields.cells.push_back(element_averages(
      solver, "couple_stress", 2, [&](std::size_t point, int i) { return stress(point, kCurvature1 + i); }));
  fields.cells.push_back(element_averages(solver, "strain", 5, strain));
  fields.cells.push_back(element_averages(
      solver, "curvature", 2, [&](std::size_t point, int i) { return strain(point, kCurvature1 + i); }));
  fields.cells.push_back(element_averages(solver, "deviatoric_strain", 1, [&](std::size_t point, int) {
    return deviatoric_strain(state.strain[point]);
  }));
  const std::vector<std::string> names = material_field_names(solver);
  const auto values = material_values(solver, names);
  for (const std::string& name : names) {
    fields.cells.push_back(
        element_averages(solver, name, 1, [&](std::size_t point, int) { return values.at(name)[point]; }));
  }
  return fields;
}

}  // namespace polargrain::fem
