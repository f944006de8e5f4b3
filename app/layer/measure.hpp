// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/commands/pack.hpp"
#include "app/layer/options.hpp"

namespace polargrain::app {

/// Makes the experiment that a cell cannot make, and finds the lengths of the Cosserat layer that is like it: packings and layers of
/// grains under one contact law, sheared; columns of cells of the same grains with free rotations, for every pair of candidate
/// lengths; lc and lp of each packing of cells, their mean and its 95 % interval. Leaves tables (layers.csv, columns.csv,
/// lengths.csv) and, beside each packing of cells and those named, the file for `lc: measured`. Existing results are not made
/// again. @returns exit status
/// @throws InputError before anything is made, with all faults of the specification or its script; RunError;
/// Interrupted, after which the same command goes on
int measure_layer(const LayerOptions& options, const PackingTools& tools);

}  // namespace polargrain::app
