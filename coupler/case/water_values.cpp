// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/case/water_values.hpp"

#include "common/error.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::coupler {

const std::vector<std::string>& values_of_water() {
  static const std::vector<std::string> names{"pressure", "outflow", "flow"};
  return names;
}

bool has_water_at(const Case& the_case, const std::vector<std::string>& on) {
  const auto has = [&]<int dim>(const fem::Problem<dim>& problem) {
    const std::size_t field = fem::number_of_field(problem.fields, fem::kPorePressure);
    if (field == problem.fields.size()) return false;
    const fem::FieldPlaces<dim> places = problem.places();
    for (const int node : problem.mesh.nodes_on(on))
      if (places.entry(field, node) >= 0) return true;
    return false;
  };
  return the_case.with_problem(has);
}

template <int dim>
double value_of_water(const fem::Solver<dim>& solver, const std::vector<std::string>& on,
                      const std::string& value) {
  const fem::Problem<dim>& problem = solver.problem();
  const std::size_t field = fem::number_of_field(problem.fields, fem::kPorePressure);
  const fem::PoreWater<dim>* const water = fem::pore_water_of(problem);
  if (water == nullptr) throw RunError("the case has no water");
  if (value == "pressure") return solver.mean_field(field, on);
  const fem::FieldPlaces<dim> places = problem.places();
  double sum = 0.0;
  for (const int node : problem.mesh.nodes_on(on)) {
    const int entry = places.entry(field, node);
    if (entry >= 0) sum += value == "flow" ? water->flow(entry) : water->outflow(entry);
  }
  return sum;
}

template double value_of_water<2>(const fem::Solver<2>&, const std::vector<std::string>&, const std::string&);
template double value_of_water<3>(const fem::Solver<3>&, const std::vector<std::string>&, const std::string&);

}  // namespace polargrain::coupler
