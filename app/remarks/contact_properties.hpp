// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "common/cell.hpp"
#include "common/error.hpp"

namespace polargrain::app {

/// `fix ID all property/global NAME ...` of a script.
struct ContactProperty {
  Fault place;  ///< its file and line, no message
  std::string name;
  std::vector<double> values;  ///< those that are plain numbers, or variables of the script
};

/// The contacts and neighbours that a script sets up.
struct ContactScript {
  std::map<std::string, std::string> models;  ///< of `pair_style gran`: model hooke, tangential history, ...
  std::vector<ContactProperty> properties;
  Fault neighbour_place;
  std::optional<double> neighbour_distance;  ///< m; nothing: derived from the radii, or not given
};

ContactScript contact_script_of(const CellDefinition& cell);

/// The models that read a property: "rolling_friction epsd2" and others; empty where nothing is known of the property.
std::vector<std::string> readers_of(const std::string& property);

/// Whether every model that a script names is one of those whose properties are known.
bool knows_models_of(const ContactScript& script);

}  // namespace polargrain::app
