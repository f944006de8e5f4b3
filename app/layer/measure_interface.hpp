// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include "app/commands/pack.hpp"
#include "app/layer/interface_options.hpp"

namespace polargrain::app {

/// Shears boxes of grains on walls of each roughness and takes their friction over the slip. Leaves tables (walls.csv, curves.csv)
/// and, beside each packing made and those named, the file for `friction: measured`. Existing results are not made again.
/// @returns exit status
/// @throws InputError before anything is made, with all faults of the specification or its script; RunError; Interrupted, after
/// which the same command goes on
int measure_interface(const InterfaceOptions& options, const PackingTools& tools);

}  // namespace polargrain::app
