// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <cstddef>
#include <string>
#include <vector>

namespace polargrain::fem {

/// Where the last attempt at a step that failed was out of balance, and the messages of materials. Empty where it failed
/// before any material was asked.
struct Trouble {
  /// A node with its imbalance.
  struct Node {
    int number;
    double share;  ///< of the sum of the absolute unbalanced forces, 0 to 1
  };
  /// A point whose answer was not good.
  struct Point {
    std::size_t number;
    std::string message;  ///< of its material
  };
  std::string reason;                 ///< why the attempt failed
  std::vector<Node> nodes;            ///< with the largest shares, largest first; at most four
  std::vector<Point> points;          ///< the worst first; at most three
  std::size_t not_good = 0;           ///< number of points whose answer was not good
  double least_force_residual = 0.0;  ///< of all iterations of the attempt, relative; 0: no iteration
  double first_force_residual = 0.0;  ///< after the predictor
  double last_force_residual = 0.0;
  double force_noise = 0.0;    ///< the residual of the noise of the stresses
  bool no_part_helps = false;  ///< even the least part of the step fails, as at a limit load
  bool jumps = false;  ///< the attempts since the last substep show a jump of the stresses (jump_watch.hpp)

  [[nodiscard]] bool is_empty() const { return nodes.empty() && points.empty(); }
};

}  // namespace polargrain::fem
