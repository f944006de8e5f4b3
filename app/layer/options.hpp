// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "grains_io/script.hpp"

namespace polargrain::app {

/// The options of `polargrain layer` (docs/user_guide.md). Lengths in mean diameters of the grains.
struct LayerOptions {
  std::filesystem::path
      specification;                ///< of the packings; its script is the contact law of both experiments
  std::filesystem::path directory;  ///< of the results
  std::vector<std::filesystem::path> beside;              ///< packings that get the lengths too
  std::vector<std::string> settings;                      ///< of --set, of the specification
  int grains = 1600;                                      ///< of a layer, as high as it is wide
  int cell_grains = 100;                                  ///< of a cell of the columns
  std::vector<int> seeds{1, 2, 3, 4, 5, 6, 7, 8, 9, 10};  ///< a layer each
  std::vector<int> cell_seeds{1, 2, 3, 4, 5};             ///< columns with these cells
  std::vector<double> internal_lengths{0.2, 0.4, 0.8};    ///< lc to try
  std::vector<double> plastic_lengths{0.25, 0.5, 1.0};    ///< lp to try
  std::vector<double> spreads{4.0, 6.0, 9.0};             ///< of slips, to try
  double way = 4.0;               ///< displacement past the peak over which both are compared
  double shear = 0.16;            ///< of a layer: displacement of the upper plate over its height
  double inertial_number = 2e-4;  ///< of a layer
  double column_height = 20.0;
  int elements = 10;  ///< of a column
  int workers = 1;
  bool columns = true;  ///< of cells; without them layers are sheared, and no more
  bool quiet = false;
  ScriptRules scripts = {};
};

}  // namespace polargrain::app
