// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/case/section.hpp"
#include "fem/water/pore_water.hpp"

namespace polargrain::coupler {

/// u1, u2, w; in space u1, u2, u3, w1, w2, w3
const std::vector<std::string>& dof_names(int dimension);
/// @param name one of dof_names()
fem::Dof dof_of(const std::string& name);
/// Of a prescribed value: a length, or an angle.
Dimension dimension_of(fem::Dof dof);

/// The section `water` as it was read, while its boundaries are not known yet.
struct WaterOfCase {
  const Entry* entry;
  std::map<std::string, fem::WaterOfRegion> regions;
  fem::PoreWaterOptions options;
};

/// The common data of the readers of the parts of a case.
struct CaseParts {
  std::filesystem::path directory;  ///< of the case file
  Case result;
  bool has_mesh = false;  ///< while it is false, names of boundaries and regions cannot be checked
  Faults& faults;
  std::optional<WaterOfCase> water = {};

  /// Of the loading time: with water it is physical.
  [[nodiscard]] Dimension time() const { return water ? Dimension::duration : Dimension::number; }
  /// "a, b, c" of the keys of a map, for messages.
  template <class Map>
  static std::string names_of(const Map& map) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : map) keys.push_back(key);
    return listed(keys);
  }

  /// That the mesh has places of these names (given by key `key` of the section), and boundaries where a load
  /// needs edges. @param edge_load the load that needs them, "a pressure"; empty without one
  void check_places(Section& section, const std::string& key, const std::vector<std::string>& places,
                    const std::string& edge_load = "");
  /// The region of `key`, checked; empty (all of the body) when the key is not there.
  std::string region(Section& section, const std::string& key);
};

// Each reads one part of a case into parts.result and lists its faults.
void read_mesh(const Entry& entry, CaseParts& parts);
void read_boundary(const Entry& entry, CaseParts& parts);
void read_body_loads(const Entry& entry, CaseParts& parts);
void read_initial_stress(const Entry& entry, CaseParts& parts);
/// After the regions, before the boundary.
void read_water(const Entry& entry, CaseParts& parts);
/// Reads pore_pressure, water_level and flux of an item of `boundary`. @param table reads the value of a key
void read_water_boundary(Section& item, const std::vector<std::string>& places, CaseParts& parts,
                         const std::function<fem::TimeTable(const std::string&, Dimension)>& table);
/// Gives the problem its pore pressures, when all is read.
void add_water(CaseParts& parts);
void read_steps(const Entry& entry, CaseParts& parts);

/// DEM steps that an explicit step of the nodes has, unless the case says otherwise.
inline constexpr int kDemSteps = 5;
/// DEM steps an explicit step; 0 where the case asks for another method. Materials are read before the steps.
int dem_steps_of(const Entry& document);
/// Explicit steps after which the cells of `informed` follow; 0 where the case asks for another method.
int ask_every_of(const Entry& document);
/// Reads the keys of `method: explicit` and gives each step of the plan its explicit steps.
void read_explicit(Section& steps, CaseParts& parts);

}  // namespace polargrain::coupler
