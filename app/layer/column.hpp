// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <optional>

#include "app/layer/shearing.hpp"
#include "grains_io/script.hpp"

namespace polargrain::app {

/// A column of elements whose sides are tied, with cells of free rotations and given lengths, sheared between plates that hold
/// displacement and micro-rotation, or slips that are spread: the layer of a continuum. Lengths in m.
struct ColumnSpecification {
  std::filesystem::path script;   ///< beside the case
  std::filesystem::path packing;  ///< of the cells
  double pressure = 0.0;          ///< Pa
  double diameter = 0.0;          ///< mean one of the grains
  double height = 0.0;
  int elements = 10;
  double internal_length = 0.0;
  std::optional<double> plastic_length;
  /// Of slips in a classical continuum, in the place of both lengths; 0: each point slips by itself.
  double spread = 0.0;
  double way = 0.0;  ///< displacement past the peak, diameters
  /// In place of iterations, which do not balance stiff spheres. The plate is driven all the way then.
  bool explicit_steps = false;
};

/// The case of a column.
std::string column_case(const ColumnSpecification& column);

/// Runs it, or goes on with it: case.yaml and the files of `polargrain run`. A column that has ended or failed is
/// not run again. @throws InputError, RunError, Interrupted
void run_column(const ColumnSpecification& column, const std::filesystem::path& folder, int workers,
                const ScriptRules& scripts);

/// The result of run_column. @throws InputError naming file and line
Shearing read_column(const ColumnSpecification& column, const std::filesystem::path& folder);

}  // namespace polargrain::app
