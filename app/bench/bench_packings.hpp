// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <vector>

#include "app/bench/bench.hpp"

namespace polargrain::app {

/// A packing that bench makes itself.
struct BenchPacking {
  int grains = 0;
  int seed = 0;
  std::filesystem::path file;  ///< absolute
};

/// The packings that the options ask for, sizes in their order, the seeds of each together. Makes nothing.
/// @throws InputError when the specification is wrong, is of packings that are no cells, or has another
/// script than a material of the first case
std::vector<BenchPacking> bench_packings(const BenchOptions& options);

/// Makes the packings that are missing. Each keeps its specification and script beside it, so that it is made
/// anew when the specification or its script has changed.
/// @throws RunError in the engine's words
void make_packings(const BenchOptions& options, const std::vector<BenchPacking>& packings,
                   const PackingTools& tools);

}  // namespace polargrain::app
