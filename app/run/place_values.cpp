// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/run/place_values.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "app/commands/csv_file.hpp"
#include "fem/output/probe.hpp"

namespace polargrain::app {

namespace {

template <int dim>
std::vector<double> values_in(const fem::Solver<dim>& solver, const fem::Probe<dim>& probe,
                              const std::vector<coupler::PlaceValue>& values) {
  const auto displacement = fem::displacement_at(solver, probe);
  const auto stress = fem::stress_at(solver, probe);
  std::vector<double> found;
  for (const coupler::PlaceValue& value : values)
    found.push_back(value.is_stress ? stress(value.component) : displacement(value.component));
  return found;
}

/// The sides of a place whose elements are there, in the order in which a way passes them; where no element is there, one empty side.
template <int dim>
std::vector<fem::Probe<dim>> sides_on_way(const fem::Solver<dim>& solver, fem::Probe<dim> probe,
                                          const typename Cosserat<dim>::Place& way,
                                          const std::vector<int>& materials) {
  const std::vector<char> there = fem::elements_in_stage(solver.problem(), solver.state().stage);
  if (!there.empty())
    std::erase_if(probe.elements,
                  [&](const auto& inside) { return there[static_cast<std::size_t>(inside.element)] == 0; });
  const fem::Mesh<dim>& mesh = solver.problem().mesh;
  std::vector<fem::Probe<dim>> sides = fem::sides_at(mesh, probe, materials);
  if (sides.empty()) sides.emplace_back();
  if (sides.size() > 1)
    std::ranges::stable_sort(sides, {},
                             [&](const auto& side) { return way.dot(fem::middle_of(mesh, side)); });
  return sides;
}

}  // namespace

template <int dim>
std::vector<double> values_at(const fem::Solver<dim>& solver, const fem::PlaceFinder<dim>& finder,
                              const std::vector<double>& at, const std::vector<coupler::PlaceValue>& values) {
  const typename Cosserat<dim>::Place place = Eigen::Map<const typename Cosserat<dim>::Place>(at.data());
  return values_in(solver, finder.find(place), values);
}

template <int dim>
void write_profile(const std::filesystem::path& file, const coupler::Profile& profile,
                   const fem::Solver<dim>& solver, const std::map<std::string, std::string>& regions) {
  using Place = typename Cosserat<dim>::Place;
  std::vector<std::string> columns{"distance"};
  for (int i = 0; i < dim; ++i) columns.push_back(fmt::format("x{}", i + 1));
  for (const coupler::PlaceValue& value : profile.values) columns.push_back(value.name);
  CsvFile table(file, columns);
  const fem::PlaceFinder<dim> finder(solver.problem().mesh);
  const std::vector<int> materials = std::ranges::any_of(profile.values, &coupler::PlaceValue::is_stress)
                                         ? coupler::numbers_of_materials(solver.problem().mesh, regions)
                                         : std::vector<int>{};
  const auto place_of = [&](std::size_t k) -> Place {
    return Eigen::Map<const Place>(profile.places[std::min(k, profile.places.size() - 1)].data());
  };
  double distance = 0.0;
  for (std::size_t k = 0; k < profile.places.size(); ++k) {
    const Place place = place_of(k);
    if (k > 0) distance += (place - place_of(k - 1)).norm();
    const Place way = place_of(k + 1) - place_of(k > 0 ? k - 1 : 0);
    for (const fem::Probe<dim>& side : sides_on_way<dim>(solver, finder.find(place), way, materials)) {
      std::vector<std::string> row{exact(distance)};
      for (const double coordinate : place) row.push_back(exact(coordinate));
      for (const double value : values_in(solver, side, profile.values)) row.push_back(exact(value));
      table.add(row);
    }
  }
  table.write();
}

template std::vector<double> values_at<2>(const fem::Solver<2>&, const fem::PlaceFinder<2>&,
                                          const std::vector<double>&,
                                          const std::vector<coupler::PlaceValue>&);
template std::vector<double> values_at<3>(const fem::Solver<3>&, const fem::PlaceFinder<3>&,
                                          const std::vector<double>&,
                                          const std::vector<coupler::PlaceValue>&);
template void write_profile<2>(const std::filesystem::path&, const coupler::Profile&, const fem::Solver<2>&,
                               const std::map<std::string, std::string>&);
template void write_profile<3>(const std::filesystem::path&, const coupler::Profile&, const fem::Solver<3>&,
                               const std::map<std::string, std::string>&);

}  // namespace polargrain::app
