// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/pack.hpp"

namespace polargrain::app {

struct BenchOptions {
  /// The first carries the grid of settings and the reference; the others are run as they are and compared
  /// with the same reference, for example the same problem with other materials.
  std::vector<std::filesystem::path> cases;
  std::filesystem::path directory;  ///< of the results
  int workers = 1;
  bool resume = false;  ///< runs whose checkpoint is in the directory go on from it
  bool quick = false;   ///< fewer settings, and a reference that is less fine
  bool quiet = false;
  std::vector<std::string> settings;  ///< of --set, for every run
  std::vector<std::string> vary;      ///< KEY=A,B,C: further values to try, one at a time
  std::vector<std::string> packings;  ///< further packings, compared with the reference
  std::filesystem::path pack;       ///< specification of packings that bench makes itself; empty: no packings
  std::vector<int> grains;          ///< their numbers of grains; empty: as the specification says
  std::vector<int> seeds{1, 2, 3};  ///< a packing of each size for each seed
  /// Axial strains (of x) between which shear bands are looked for, as `polargrain band` does: first and
  /// last; empty: no band.
  std::vector<double> band;
  std::string x;               ///< monitor along the curve; empty: the first of the case's table
  std::vector<std::string> y;  ///< monitors whose error counts; empty: the others of the case's table
  ScriptRules scripts = {};
};

/// Runs cases over a grid of settings and measures speed against error: bench.csv and bench.html in the
/// directory, a table on standard output. Each setting departs from the first case alone, all else equal; the
/// reference has the finest settings of all. Packings that bench makes are compared among themselves: with
/// the mean of those with the most grains, and with their own mean, which gives their scatter. A run that
/// stops early is compared as far as it came, and said to have stopped.
/// @returns 0 when the reference and at least one other run came to their end, else 1
/// @throws InputError when a case or an option is wrong (nothing has been run), or, with resume, when the
/// checkpoint of a run is of another case; RunError; Interrupted, after which the bench can be resumed
int bench(const BenchOptions& options, const PackingTools& packing_tools);

}  // namespace polargrain::app
