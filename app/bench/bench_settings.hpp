// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <string>
#include <vector>

#include "app/bench/bench.hpp"
#include "app/bench/bench_packings.hpp"

namespace polargrain::app {

/// One run of a bench.
struct BenchSetting {
  std::filesystem::path case_file;
  std::string group;                   ///< the quantity varied: "reference", "as given", "equilibrium", ...
  std::string label;                   ///< its value, for people
  std::vector<std::string> overrides;  ///< as --set takes them
  int grains = 0;  ///< of the packing that bench makes for this run; 0: it makes no packing
};

/// A material of the first case that has boxes of grains.
struct MaterialWithCells {
  std::string name;
  std::string model;
  std::string script;           ///< as the case names it
  std::string contact_library;  ///< the same; empty: no library
};

/// @throws InputError when the case cannot be read
std::vector<MaterialWithCells> materials_with_cells(const BenchOptions& options);

/// All runs of a bench in their order, the reference first. The quantities varied depend on what the first case
/// has: equilibrium, loading rate, tangent and adaptivity where it has cells, the step size where it counts
/// steps, packings and keys as the options say.
/// @throws InputError when the case cannot be read or `vary` is no KEY=VALUES
std::vector<BenchSetting> bench_settings(const BenchOptions& options,
                                         const std::vector<BenchPacking>& packings);

}  // namespace polargrain::app
