// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "app/bench/bench_results.hpp"

namespace polargrain::app {

/// The shear band of a result directory in the increment between two axial strains. A run that has no frames
/// near them (it stopped before) has no band.
/// @param strain column of history.csv with the axial strain, compression positive
BenchBand bench_band(const std::filesystem::path& directory, const std::string& strain, double from,
                     double to);

}  // namespace polargrain::app
