// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/place_values.hpp"

#include <fmt/format.h>

#include <cmath>

#include "app/commands/csv_file.hpp"
#include "fem/output/probe.hpp"

namespace polargrain::app {

template <int dim>
std::vector<double> values_at(const fem::Solver<dim>& solver, const fem::PlaceFinder<dim>& finder,
                              const std::vector<double>& at, const std::vector<coupler::PlaceValue>& values) {
  const typename Cosserat<dim>::Place place = Eigen::Map<const typename Cosserat<dim>::Place>(at.data());
  const fem::Probe<dim> probe = finder.find(place);
  const auto displacement = fem::displacement_at(solver, probe);
  const auto stress = fem::stress_at(solver, probe);
  std::vector<double> found;
  for (const coupler::PlaceValue& value : values)
    found.push_back(value.is_stress ? stress(value.component) : displacement(value.component));
  return found;
}

template <int dim>
void write_profile(const std::filesystem::path& file, const coupler::Profile& profile,
                   const fem::Solver<dim>& solver) {
  std::vector<std::string> columns{"distance"};
  for (int i = 0; i < dim; ++i) columns.push_back(fmt::format("x{}", i + 1));
  for (const coupler::PlaceValue& value : profile.values) columns.push_back(value.name);
  CsvFile table(file, columns);
  const fem::PlaceFinder<dim> finder(solver.problem().mesh);
  double distance = 0.0;
  for (std::size_t k = 0; k < profile.places.size(); ++k) {
    const std::vector<double>& place = profile.places[k];
    if (k > 0) {
      double square = 0.0;
      for (std::size_t i = 0; i < place.size(); ++i) {
        const double part = place[i] - profile.places[k - 1][i];
        square += part * part;
      }
      distance += std::sqrt(square);
    }
    std::vector<std::string> row{exact(distance)};
    for (const double coordinate : place) row.push_back(exact(coordinate));
    for (const double value : values_at(solver, finder, place, profile.values)) row.push_back(exact(value));
    table.add(row);
  }
  table.write();
}

template std::vector<double> values_at<2>(const fem::Solver<2>&, const fem::PlaceFinder<2>&,
                                          const std::vector<double>&,
                                          const std::vector<coupler::PlaceValue>&);
template std::vector<double> values_at<3>(const fem::Solver<3>&, const fem::PlaceFinder<3>&,
                                          const std::vector<double>&,
                                          const std::vector<coupler::PlaceValue>&);
template void write_profile<2>(const std::filesystem::path&, const coupler::Profile&, const fem::Solver<2>&);
template void write_profile<3>(const std::filesystem::path&, const coupler::Profile&, const fem::Solver<3>&);

}  // namespace polargrain::app
