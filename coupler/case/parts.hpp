// SPDX-License-Identifier: GPL-2.0-or-later
#pragma once
#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "coupler/case/case.hpp"
#include "coupler/case/measured_interface.hpp"
#include "coupler/case/section.hpp"
#include "fem/water/pore_water.hpp"
#include "fem/water/water_across.hpp"

namespace polargrain::coupler {

/// u1, u2, w; in space u1, u2, u3, w1, w2, w3
const std::vector<std::string>& dof_names(int dimension);
/// @param name one of dof_names()
fem::Dof dof_of(const std::string& name);
struct CaseParts;
/// The names of dof_names; both of the plane and of space where the mesh has a fault, which may be of either.
std::vector<std::string> known_dofs(const CaseParts& parts);
/// Of a prescribed value: a length, or an angle.
Dimension dimension_of(fem::Dof dof);

/// The section `water` as it was read, before the boundary is.
struct WaterOfCase {
  const Entry* entry;
  std::map<std::string, fem::WaterOfRegion> regions;
  fem::PoreWaterOptions options;
};

/// How water passes an interface, as its section says.
struct PassageOfInterface {
  const Entry* entry;
  fem::WaterAcrossOptions options;
  bool is_given = false;  ///< and no default
};

/// The common data of the readers of the parts of a case.
struct CaseParts {
  std::filesystem::path directory;  ///< of the case file
  Case result;
  /// The mesh, with the nodes of its structures; while it is false, names of boundaries and regions cannot be checked.
  bool has_mesh = false;
  Faults& faults;
  const Entry* materials = nullptr;  ///< of the document, known before they are read
  bool builds = false;               ///< parts come or go in some stage

  /// The stage of construction whose items are read; by default the case itself.
  struct Now {
    int number = 0;  ///< of the problem
    double start = 0.0;
    std::optional<double> end = {};  ///< nothing: not known before the run
  };
  Now now = {};

  /// The items of the problem that an item of `boundary` or `body` has made: from, and up to, so many of prescribed,
  /// boundary_loads, node_loads, body_loads, prescribed_fields and contributions.
  using Counts = std::array<std::size_t, 6>;
  struct Made {
    Counts from, to;
  };
  std::map<std::string, Made> named = {};  ///< by the `name` of the item
  [[nodiscard]] Counts counts() const;
  /// Calls visit(item) for all of them.
  template <class Visit>
  void for_each(const Made& made, Visit visit) {
    result.with_problem([&](auto& problem) {
      const auto in = [&](auto& items, std::size_t kind) {
        for (std::size_t k = made.from[kind]; k < made.to[kind]; ++k) visit(items[k]);
      };
      in(problem.prescribed, 0);
      in(problem.boundary_loads, 1);
      in(problem.node_loads, 2);
      in(problem.body_loads, 3);
      in(problem.prescribed_fields, 4);
      for (std::size_t k = made.from[5]; k < made.to[5]; ++k) visit(*problem.contributions[k]);
    });
  }
  /// Interfaces against rigid bodies, by their names, which name the nodes of the bodies too; and rotations of nodes without
  /// elements, which are zero unless a support gives them.
  std::vector<std::pair<std::string, const Entry*>> rigid_bodies = {};
  std::vector<std::pair<std::string, fem::Dof>> own_rotations = {};
  std::optional<WaterOfCase> water = {};
  std::map<std::string, PassageOfInterface> passages = {};  ///< by the name of the interface

  /// Of the loading time: with water and in real time it is physical.
  [[nodiscard]] Dimension time() const {
    return water || in_real_time ? Dimension::duration : Dimension::number;
  }
  bool in_real_time = false;  ///< as `steps` says, before they are read

  /// The contributions of an interface, a beam or an anchor, by its name: stages place and remove it.
  struct Structure {
    enum class Kind { interface, beam, anchor } kind;
    std::vector<std::size_t> contributions = {};  ///< numbers in the problem
    std::string along = {};  ///< of an interface: the beam that it lies along, with which it comes
  };
  std::map<std::string, Structure> structures = {};
  /// Names that are taken, by those that are not understood and by sides of walls too.
  std::set<std::string> structure_names = {};
  /// Finds the key of a structure and takes it for its name; a fault when another structure has it.
  void take_structure_name(Section& all, const std::string& name);
  /// Of the contribution to the problem that comes next.
  void add_structure(const std::string& name, Structure::Kind kind, const std::string& along = {});

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
/// Behind the mesh and before all that names parts of it. @param interfaces, beams, anchors null where the case lacks them
void read_structures(const Entry* interfaces, const Entry* beams, const Entry* anchors, CaseParts& parts);
/// Behind the interfaces and beams, whose nodes they may hold.
void read_anchors(const Entry& anchors, CaseParts& parts);
/// Reads `packing` and `roughness` of an interface with `friction: measured`. @returns nothing, with faults, when that was not measured
std::optional<MeasuredWall> read_measured_friction(Section& section, CaseParts& parts);
/// Checks and completes the supports that they need: to be called when these have been read.
void finish_structures(CaseParts& parts);
/// Reads a monitor of an interface, a beam or an anchor. @returns false, with nothing read, when it is one of something else
bool read_structure_monitor(Section& section, CaseParts& parts, Monitor& monitor);
/// Behind the regions and before the boundary.
void read_water(const Entry& entry, CaseParts& parts);
/// Reads the value of a key of an item as a table over the time.
using TableReader = std::function<fem::TimeTable(const std::string& key, Dimension dimension)>;
/// Reads drained, pore_pressure, water_level and flux of an item of `boundary`. @returns whether one of them is there
bool read_water_boundary(Section& item, const std::vector<std::string>& places, CaseParts& parts,
                         const TableReader& table);
/// Gives the problem its pore pressures, when the boundary has been read.
void add_water(CaseParts& parts);
/// Reads `water` and `resistance` of an interface.
void read_passage(Section& section, const std::string& interface, CaseParts& parts);
/// Lets the pore water press on the faces of interfaces and pass them: behind add_pore_water.
void add_water_at_interfaces(CaseParts& parts);
/// Lets free water press on boundaries and walls. @param level of the water @returns those that are boundaries
std::vector<std::string> add_free_water(Section& item, const std::vector<std::string>& places,
                                        const fem::TimeTable& level, CaseParts& parts);
/// @returns false, with nothing read, when it is a monitor of something else
bool read_water_monitor(Section& section, CaseParts& parts, Monitor& monitor);
void read_boundary(const Entry& entry, CaseParts& parts);
void read_body_loads(const Entry& entry, CaseParts& parts);
/// The same lists of a stage. @param name of the stage, for messages
void read_boundary_of_stage(const Entry& entry, const std::string& name, CaseParts& parts);
void read_body_of_stage(const Entry& entry, const std::string& name, CaseParts& parts);
void read_initial_stress(const Entry& entry, CaseParts& parts);
void read_steps(const Entry& entry, CaseParts& parts);
/// The key start_from: checks the run there. To be called when materials, regions and steps are read.
void read_start(Section& top, CaseParts& parts);
void read_profiles(const Entry& entry, CaseParts& parts);
/// The nodes of a curve, along it from its lowest end (the left one, of these the lower one); around a closed one against the clock,
/// back to its lowest place. Of what is no curve, by their coordinates. Nodes at one place are one.
/// In space along the edges of elements; a closed curve begins at its lowest place.
template <int dim>
std::vector<std::vector<double>> places_along(const fem::Mesh<dim>& mesh, const std::string& on);
/// A monitor with the key `at`: a place inside of the body.
void read_place_monitor(Section& section, Monitor& monitor, CaseParts& parts);
/// The list below steps.stages: adds to the plan, and to the problem what begins in its stages.
void read_stages(const Entry& entry, CaseParts& parts);
/// The count of a section, at most as many as a case may have in all. @param before steps of the plan so far
int step_count(Section& section, std::size_t before);
/// Ends of `count` steps from `start` to `end`: equal ones, or from the length of `first` each longer by the same ratio.
std::vector<double> times_of_steps(Section& section, double start, double end, int count,
                                   const CaseParts& parts);
/// Whether parts come or go in some stage; known before the steps are read.
bool builds_in_stages(const Entry& document);
/// The entry of the stage that a message of fem::faults begins with; null where it begins without a stage.
const Entry* stage_in(const Entry& document, const std::string& message);

/// DEM steps that an explicit step of the nodes has, unless the case says otherwise.
inline constexpr int kDemSteps = 5;
/// DEM steps an explicit step; 0 where the case asks for another method. Materials are read before the steps.
int dem_steps_of(const Entry& document);
/// Explicit steps after which the cells of `informed` follow; 0 where the case asks for another method.
int ask_every_of(const Entry& document);
/// Whether steps are balanced by iterations: all, or (`method: automatic`) those that can be.
bool iterates(const Entry& document);
/// Whether its steps are those of real time.
bool is_real_time(const Entry& document);
/// Reads the keys of `method: explicit` or, with those of iterations, `automatic` and gives each step of the plan its explicit
/// steps.
void read_explicit(Section& steps, bool automatic, CaseParts& parts);

}  // namespace polargrain::coupler
