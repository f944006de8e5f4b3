// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "app/remarks/scene.hpp"

namespace polargrain::app {

/// All conditions of one boundary or node set, at the start and at the end of a run.
struct PlaceConditions {
  std::string name;
  bool is_boundary = true;
  std::vector<int> nodes;                       ///< each once
  std::array<bool, Cosserat<2>::dofs> held{};   ///< u1, u2, w: prescribed and zero throughout
  std::array<bool, Cosserat<2>::dofs> moved{};  ///< u1, u2, w: prescribed and not always zero
  Eigen::Vector2d movement{0.0, 0.0};           ///< m, from the start to the end
  bool pressed = false;                         ///< by a pressure, at the start or at the end
  double pressure_sign = 1.0;                   ///< -1: it pulls
  Eigen::Vector2d pull{0.0, 0.0};               ///< direction of tractions and forces of nodes; zero without
  std::string tied_to;                          ///< empty: not tied
  std::string supports;                         ///< in words
  std::string loads_at_start;                   ///< in words
  std::string loads_at_end;                     ///< in words
  [[nodiscard]] bool is_free() const;           ///< neither support, movement, load nor tie
};

/// The conditions of all named boundaries, and of the node sets that have a condition, in the order of their names.
std::vector<PlaceConditions> conditions_of(const Scene& scene);

}  // namespace polargrain::app
