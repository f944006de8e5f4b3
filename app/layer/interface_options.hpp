// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "grains_io/script.hpp"

namespace polargrain::app {

/// The options of `polargrain interface` (docs/user_guide.md). Lengths in mean diameters of the grains.
struct InterfaceOptions {
  std::filesystem::path specification;                    ///< of the packings; its script is the contact law
  std::filesystem::path directory;                        ///< of the results
  std::vector<std::filesystem::path> beside;              ///< packings that get the friction too
  std::vector<std::string> settings;                      ///< of --set, of the specification
  std::vector<double> roughnesses{0.25, 0.5, 1.0};        ///< diameters of the wall's grains
  int grains = 400;                                       ///< of a packing, as high as it is wide
  double height = 10.0;                                   ///< of a box: the rest of the packing is taken off
  std::vector<int> seeds{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};  ///< a box each on every wall
  double way = 5.0;                                       ///< slip
  double inertial_number = 1e-3;
  bool quiet = false;
  ScriptRules scripts = {};
};

}  // namespace polargrain::app
