// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

/// Elastic bars, columns and beams whose waves are known.
namespace polargrain::testing::real_time {

using namespace polargrain::fem;

inline constexpr double kDensity = 2000.0;
/// Of the energy: rows have steps of slightly different duration, at each change of which the balance has an error of their square.
inline constexpr double kEnergy = 1e-4;
inline const TimeTable kZeroOfDynamics = TimeTable::constant(0.0);

inline ElasticParameters<2> soil(double pressure = 0.0) {
  ElasticParameters<2> parameters{40e6, 0.3, 10e6, 3e-3, Vector7::Zero()};
  for (const int i : {k11, k22, k33}) parameters.initial_stress(i) = -pressure;
  return parameters;
}

inline double speed_along() {
  return std::sqrt(elastic_stiffness(soil())(k11, k11) / kDensity);
}
inline double speed_across() {
  return std::sqrt(40e6 / 2.6 / kDensity);
}

inline Problem<2> body(const RectangleSpecification& shape, const std::string& element = "Q8R",
                       Continuum continuum = Continuum::cauchy, double pressure = 0.0) {
  Problem<2> problem;
  problem.mesh = rectangle(shape, element);
  problem.continuum = continuum;
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(soil(pressure)));
  problem.densities["all"] = kDensity;
  return problem;
}

/// A bar, held sideways, whose left end is brought to `speed` within `rise` seconds.
inline Problem<2> bar(double speed, double rise, const std::string& element = "Q8R") {
  Problem<2> problem = body({{10.0, 0.2}, {50, 1}}, element);
  const TimeTable pushed =
      TimeTable::of_accelerations({{0.0, 0.0}, {0.5 * rise, 2.0 * speed / rise}, {rise, 0.0}});
  problem.prescribed = {{"bottom", Dof::u2, kZeroOfDynamics, {}},
                        {"top", Dof::u2, kZeroOfDynamics, {}},
                        {"left", Dof::u1, pushed, {}},
                        {"right", Dof::u1, kZeroOfDynamics, {}}};
  return problem;
}

/// A column that shears: its sides move alike.
inline Problem<2> column(int elements, Continuum continuum = Continuum::cauchy) {
  Problem<2> problem = body({{1.0, 10.0}, {1, elements}}, "Q8R", continuum);
  problem.ties = {{"right", "left"}};
  problem.prescribed = {{"left", Dof::u2, kZeroOfDynamics, {}}, {"right", Dof::u2, kZeroOfDynamics, {}}};
  return problem;
}

/// Where the compression falls to half of `height` in front of the wave, from its points.
inline double front_of(const Solver<2>& solver, double height) {
  std::vector<std::pair<double, double>> strains;
  for (std::size_t i = 0; i < solver.points(); ++i)
    strains.emplace_back(solver.position_of_point(i).x(), -solver.state().strain[i](k11));
  std::ranges::sort(strains);
  for (std::size_t i = strains.size() - 1; i > 0; --i) {
    const auto& [x, strain] = strains[i - 1];
    if (strain < 0.5 * height) continue;
    const auto& [next_x, next] = strains[i];
    return x + (next_x - x) * (strain - 0.5 * height) / (strain - next);
  }
  return 0.0;
}

}  // namespace polargrain::testing::real_time
