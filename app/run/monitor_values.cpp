// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/monitor_values.hpp"

#include <algorithm>

#include "common/error.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::app {

double value_of(const MonitorValues& values, const std::string& name) {
  const auto place =
      std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == name; });
  if (place == values.end()) throw RunError("no monitor has the name " + name);
  return place->second;
}

namespace {

/// Volume of water that has left through nodes, each once.
template <int dim>
double outflow(const fem::Solver<dim>& solver, const std::vector<std::string>& on) {
  const fem::Problem<dim>& problem = solver.problem();
  const std::size_t field = fem::number_of_field(problem.fields, fem::kPorePressure);
  const fem::FieldPlaces<dim> places = problem.places();
  double sum = 0.0;
  for (const auto& contribution : problem.contributions) {
    const auto* const water = dynamic_cast<const fem::PoreWater<dim>*>(contribution.get());
    if (water == nullptr) continue;
    for (const int node : problem.mesh.nodes_on(on))
      if (const int entry = places.entry(field, node); entry >= 0) sum += water->outflow(entry);
  }
  return sum;
}

}  // namespace

template <int dim>
MonitorValues monitor_values(const std::vector<coupler::Monitor>& monitors, const fem::Solver<dim>& solver) {
  MonitorValues values{{"time", solver.state().time},
                       {"volume_strain", solver.volume_strain()},
                       {"external_work", solver.state().external_work},
                       {"internal_work", solver.state().internal_work}};
  for (const coupler::Monitor& monitor : monitors) {
    const auto dof = fem::place_of<dim>(monitor.dof);
    double value = 0.0;
    switch (monitor.kind) {
      case coupler::Monitor::Kind::reaction:
        value = solver.reaction(monitor.on)[dof];
        break;
      case coupler::Monitor::Kind::displacement:
        value = solver.mean_displacement(monitor.on)[dof];
        break;
      case coupler::Monitor::Kind::pore_pressure:
        value =
            solver.mean_field(fem::number_of_field(solver.problem().fields, fem::kPorePressure), monitor.on);
        break;
      case coupler::Monitor::Kind::outflow:
        value = outflow(solver, monitor.on);
        break;
      case coupler::Monitor::Kind::formula:
        value = monitor.formula->evaluate([&](const std::string& name) { return value_of(values, name); });
    }
    values.emplace_back(monitor.name, value);
  }
  return values;
}

template MonitorValues monitor_values<2>(const std::vector<coupler::Monitor>& monitors,
                                         const fem::Solver<2>& solver);
template MonitorValues monitor_values<3>(const std::vector<coupler::Monitor>& monitors,
                                         const fem::Solver<3>& solver);

}  // namespace polargrain::app
