// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/monitor_values.hpp"

#include <algorithm>

#include "app/run/place_values.hpp"
#include "common/error.hpp"
#include "coupler/case/structure_values.hpp"
#include "coupler/case/water_values.hpp"

namespace polargrain::app {

double value_of(const MonitorValues& values, const std::string& name) {
  const auto place =
      std::find_if(values.begin(), values.end(), [&](const auto& value) { return value.first == name; });
  if (place == values.end()) throw RunError("no monitor has the name " + name);
  return place->second;
}

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
      case coupler::Monitor::Kind::structure:
        value = coupler::value_of_structure(solver.problem(), monitor.structure, monitor.value);
        break;
      case coupler::Monitor::Kind::place:
        value =
            values_at(solver, fem::PlaceFinder<dim>(solver.problem().mesh), monitor.at, {monitor.component})
                .front();
        break;
      case coupler::Monitor::Kind::water:
        value = coupler::value_of_water(solver, monitor.on, monitor.value);
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
