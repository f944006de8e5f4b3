// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "fem/solver/problem.hpp"

namespace polargrain::app {

/// All conditions of one boundary or node set, at the start and at the end of a run.
template <int dim>
struct PlaceConditions {
  using Direction = Eigen::Matrix<double, dim, 1>;

  std::string name;
  bool is_boundary = true;
  std::vector<int> nodes;                         ///< each once
  std::array<bool, Cosserat<dim>::dofs> held{};   ///< as node_dofs: prescribed and zero throughout
  std::array<bool, Cosserat<dim>::dofs> moved{};  ///< as node_dofs: prescribed and not always zero
  Direction movement = Direction::Zero();         ///< m, from the start to the end
  bool pressed = false;                           ///< by a pressure, at the start or at the end
  double pressure_sign = 1.0;                     ///< -1: it pulls
  Direction pull = Direction::Zero();  ///< direction of tractions and forces of nodes; zero without
  std::optional<double> water_level;   ///< of free water there, at the end of its life or of the run, m
  std::string tied_to;                 ///< empty: not tied
  std::string supports;                ///< in words
  std::string loads_at_start;          ///< in words
  std::string loads_at_end;            ///< in words
  std::vector<std::string>
      elsewhere;               ///< places with conditions that have sides of this one, which has no condition
  bool all_elsewhere = false;  ///< they have all of its sides
  /// Neither support, movement, load nor tie, under this name or others.
  [[nodiscard]] bool is_free() const { return !has_conditions() && !all_elsewhere; }
  /// Under this name.
  [[nodiscard]] bool has_conditions() const {
    return !(supports.empty() && loads_at_start.empty() && loads_at_end.empty() && tied_to.empty());
  }
};

/// The conditions of all named boundaries, and of the node sets that have a condition, in the order of their names.
/// @param end time at which a run ends
template <int dim>
std::vector<PlaceConditions<dim>> conditions_of(const fem::Problem<dim>& problem, double end);

}  // namespace polargrain::app
