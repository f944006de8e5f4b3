// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <string>

#include "app/commands/pack.hpp"
#include "app/layer/shearing.hpp"
#include "common/packing.hpp"

namespace polargrain::app {

/// The contact law of a cell's script, made a layer's: periodic sideways only, contacts damped where their law can be, and
/// specimen/layer_shear.in behind it.
struct LayerScript {
  std::string text;
  double modulus = 0.0;    ///< of the contacts, Pa: contactModulus or youngsModulus
  bool spheres = false;    ///< in space
  int dimension_line = 0;  ///< where the script says so
};

/// @param script of a cell, with its included files @param file its name, for messages
/// @throws InputError where it has no modulus that can be read
LayerScript layer_script(const std::string& script, const std::string& file);

/// @throws InputError where a packing is to be turned with its bedding: plates lie along the sides of its box, which turn along
void refuse_turned_bedding(const PackingSpecification& specification, const std::filesystem::path& file,
                           const std::vector<std::string>& settings);

inline constexpr double kPlateDepth = 3.0;  ///< of rough plates, mean radii

/// How a layer is sheared.
struct LayerShear {
  double pressure = 0.0;  ///< Pa
  double density = 0.0;   ///< of the grains, kg/m^3
  double inertial_number = 2e-4;
  double shear = 0.16;   ///< displacement of the upper plate over the height
  double frame = 0.005;  ///< shear between two frames
  int rest = 4000;       ///< steps to come to rest in, twice
};

/// Opens a packing above and below, glues the outermost grains, three mean radii deep, to rough plates, and shears it
/// between them: history.csv and grains/ in the folder, and a file `done` last. Existing results are not made again.
/// @throws RunError in the engine's words
void shear_layer(const Packing& packing, const LayerScript& script, const LayerShear& shear,
                 const std::filesystem::path& folder, const PackingTools& tools, bool quiet);

/// Grains whose centres lie below and above are the plates, m.
struct Plates {
  double low = 0.0;
  double high = 0.0;
};

/// The same between plates that are given. The packing has no periodic images above and below.
void shear_between(const Packing& packing, const Plates& plates, const LayerScript& script,
                   const LayerShear& shear, const std::filesystem::path& folder, const PackingTools& tools,
                   bool quiet);

/// The result of shear_layer. @throws InputError naming file and line
Shearing read_layer(const std::filesystem::path& folder, double pressure);

}  // namespace polargrain::app
