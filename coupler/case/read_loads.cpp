// SPDX-License-Identifier: GPL-2.0-or-later
// Supports, loads on boundaries and nodes, loads on the body, initial stresses.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdlib>
#include <functional>
#include <set>

#include "common/csv_table.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/parts.hpp"
#include "fem/beam/beam.hpp"
#include "fem/solver/geostatic.hpp"

namespace polargrain::coupler {
namespace {

/// The meaning of a single value in place of a table.
enum class Single {
  constant,  ///< at all times
  ramp       ///< reached in a straight line from 0 at time 0 to time 1; of a stage: from its start to its end
};

/// A value, or a list of [time, value]: straight between them, constant outside.
fem::TimeTable time_table(Section& section, const std::string& key, Dimension dimension, Single single,
                          const CaseParts& parts) {
  const CaseParts::Now& now = parts.now;
  const Entry* entry = section.find(key);
  if (entry == nullptr || entry->kind != Entry::Kind::sequence) {
    const double value = section.quantity(key, dimension, Limit::any);
    if (single == Single::constant || value == 0.0) return fem::TimeTable::constant(value);
    if (now.number == 0 && parts.water)
      section.fault(key, key +
                             ": with water the time is physical, and a single value does not tell when it is "
                             "reached; give a table such as [[0 s, 0], [1 h, VALUE]]");
    if (now.number == 0) return fem::TimeTable::ramp(value);
    if (now.end) return fem::TimeTable({{now.start, 0.0}, {*now.end, value}});
    section.fault(
        key,
        fmt::format("{}: the time at which this stage ends is not known before; give a table over the time",
                    key));
    return fem::TimeTable::constant(0.0);
  }
  std::vector<fem::TimeTable::Point> points;
  for (const auto& [time, value] : section.pairs(key, parts.time(), dimension, Limit::any)) {
    points.push_back({time, value});
  }
  return points.empty() ? fem::TimeTable::constant(0.0) : fem::TimeTable(std::move(points));
}

/// Calls take(dof, table) for each unknown of a node that the map below `key` gives. @returns whether it is there
bool dof_tables(Section& section, const std::string& key, const std::function<Dimension(fem::Dof)>& dimension,
                Single single, CaseParts& parts,
                const std::function<void(fem::Dof, const fem::TimeTable&)>& take) {
  const Entry* entry = section.find(key);
  if (entry == nullptr) return false;
  Section values(*entry, section.name() + ": " + key, parts.faults);
  for (const std::string& name : known_dofs(parts)) {
    if (values.find(name) == nullptr) continue;
    const fem::Dof dof = dof_of(name);
    take(dof, time_table(values, name, dimension(dof), single, parts));
  }
  values.finish();
  return true;
}

/// Refuses a line of names that is a row of numbers, or that names another unit or quantity.
void check_names_of_motion(const CsvTable& table) {
  static constexpr const char* kExpected =
      "expected two columns with their names in the first line: time (s) and acceleration (m/s2)";
  static const std::array<std::set<std::string>, 2> kOthers{
      std::set<std::string>{"ms", "min", "h", "frequency", "hz", "period", "acceleration", "acc"},
      std::set<std::string>{"g", "mg", "gal", "gals", "cm", "mm", "ft", "in", "velocity", "vel", "speed",
                            "displacement", "disp", "time"}};
  if (table.names().size() != 2) table.fail(table.line_of_names(), kExpected);
  for (std::size_t column = 0; column < 2; ++column) {
    const std::string& name = table.names()[column];
    char* end = nullptr;
    static_cast<void>(std::strtod(name.c_str(), &end));
    if (end != name.c_str() && *end == '\0')
      table.fail(table.line_of_names(), fmt::format("'{}' is a number; {}", name, kExpected));
    std::string word;
    for (const char letter : name + " ") {
      if (std::isalpha(static_cast<unsigned char>(letter)) != 0) {
        word += static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
        continue;
      }
      if (kOthers[column].contains(word))
        table.fail(table.line_of_names(),
                   fmt::format("'{}' is {} ({}); {}", name,
                               column == 0 ? "no time in s" : "no acceleration in m/s2", word, kExpected));
      word.clear();
    }
  }
}

/// A table of time (s) and acceleration (m/s2) in a CSV file of two columns.
fem::TimeTable accelerations_of(const CsvTable& table) {
  check_names_of_motion(table);
  std::vector<fem::TimeTable::Point> points;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    points.push_back({table.number(row, 0), table.number(row, 1)});
    if (row > 0 && !(points[row].time > points[row - 1].time))
      table.fail(table.line_of(row), "the times must rise from row to row");
  }
  if (points.size() < 2) table.fail(table.line_of_names(), "expected at least two rows");
  return fem::TimeTable::of_accelerations(points);
}

/// `accelerate: {u1: quake.csv}`. @returns whether it is there
bool read_accelerations(Section& item, CaseParts& parts,
                        const std::function<void(fem::Dof, const fem::TimeTable&)>& take) {
  const Entry* const entry = item.find("accelerate");
  if (entry == nullptr) return false;
  Section files(*entry, item.name() + ": accelerate", parts.faults);
  for (const std::string& name : known_dofs(parts)) {
    if (files.find(name) == nullptr) continue;
    const std::string file = files.text(name, "a CSV file of times and accelerations");
    const auto found = find_data_file(file, parts.directory);
    if (!found) {
      files.fault(name, fmt::format("{}: there is no file {} beside the case", name, file));
      continue;
    }
    try {
      take(dof_of(name), accelerations_of(CsvTable(*found)));
    } catch (const InputError& error) {
      parts.faults.insert(parts.faults.end(), error.faults().begin(), error.faults().end());
    }
  }
  files.finish();
  return true;
}

/// The nodes of beams at a place.
struct NodesOfBeams {
  bool any = false;
  bool all = false;    ///< the place has no others
  bool along = false;  ///< a whole element of a beam
};

NodesOfBeams nodes_of_beams(const std::string& place, const CaseParts& parts) {
  return parts.result.with_problem([&](const auto& problem) {
    const std::size_t field = fem::number_of_field(problem.fields, fem::kBeamRotation);
    if (field == problem.fields.size() || !problem.mesh.has_nodes_on(place)) return NodesOfBeams{};
    const std::vector<int> nodes = problem.mesh.nodes_on(place);
    const std::vector<int>& turning = problem.fields[field].nodes;
    const auto is_here = [&](int node) { return std::ranges::find(nodes, node) != nodes.end(); };
    const auto turns = [&](int node) { return std::ranges::find(turning, node) != turning.end(); };
    const auto is_along = [&](const auto& structure) {
      const auto pairs = problem.contributions[structure.second.contributions.front()]->joined_nodes();
      return structure.second.kind == CaseParts::Structure::Kind::beam &&
             std::ranges::any_of(
                 pairs, [&](const auto& pair) { return is_here(pair.first) && is_here(pair.second); });
    };
    return NodesOfBeams{std::ranges::any_of(nodes, turns), std::ranges::all_of(nodes, turns),
                        std::ranges::any_of(parts.structures, is_along)};
  });
}

/// A rotation of a continuum that has no rotations, below `key` of an item.
void refuse_rotation(Section& item, const std::string& key, fem::Dof dof, CaseParts& parts) {
  if (!parts.has_mesh) return;  // the beam that it is meant for may have a fault
  const std::string name(parts.result.space ? fem::name_of<3>(dof) : fem::name_of<2>(dof));
  const Entry* const map = item.find(key);
  const Entry* const value = map->find(name);
  std::string beams;
  for (const auto& [beam, structure] : parts.structures)
    for (const char* const end : {"_top", "_left"})
      if (structure.kind == CaseParts::Structure::Kind::beam && beams.empty() &&
          parts.result.problem.mesh.has_nodes_on(beam + end))
        beams = fmt::format("; a beam has its own, at its nodes alone, such as '{}{}'", beam, end);
  parts.faults.push_back(
      (value == nullptr ? *map : *value)
          .fault(
              fmt::format("{}: {}: {}: a cauchy continuum has no micro-rotation, and this would do nothing; "
                          "give forces, or 'continuum: cosserat'{}",
                          item.name(), key, name, beams)));
}

bool is_cauchy(const CaseParts& parts) {
  return parts.result.with_problem(
      [](const auto& problem) { return problem.continuum == fem::Continuum::cauchy; });
}

/// Where a node has two rotations, that of a beam and the micro-rotation of the continuum, a support, a movement or a moment on
/// nodes of beams alone is the beam's. A place with others too, such as a plane of symmetry, gives both. Along a whole beam it
/// is the continuum's: the beam bends.
void prescribe(Section& item, const std::string& key, const std::vector<std::string>& places, fem::Dof dof,
               const fem::TimeTable& value, CaseParts& parts) {
  for (const std::string& place : places) {
    const NodesOfBeams beams = fem::is_rotation(dof) ? nodes_of_beams(place, parts) : NodesOfBeams{};
    if (beams.all && beams.along)
      item.fault(key, fmt::format("{}: w on '{}' would hold a beam along its whole length, and it could not "
                                  "bend; name an end of it",
                                  key, place));
    const bool turns_beam = beams.any && !beams.along;
    if (fem::is_rotation(dof) && !turns_beam && value.largest_magnitude() > 0.0 && is_cauchy(parts))
      refuse_rotation(item, key, dof, parts);
    parts.result.with_problem([&](auto& problem) {
      if (!turns_beam || !beams.all) problem.prescribed.push_back({place, dof, value, {}});
      if (turns_beam)
        problem.prescribed_fields.push_back(
            {.field = fem::kBeamRotation, .on = place, .value = value, .from_here = true});
    });
  }
}

bool read_supports(Section& item, const std::vector<std::string>& places, CaseParts& parts) {
  const auto prescribe_by = [&](const std::string& key) {
    return [&, key](fem::Dof dof, const fem::TimeTable& value) {
      prescribe(item, key, places, dof, value, parts);
    };
  };
  bool found = dof_tables(item, "move", dimension_of, Single::ramp, parts, prescribe_by("move"));
  found = read_accelerations(item, parts, prescribe_by("accelerate")) || found;
  if (item.find("fix") == nullptr) return found;
  const std::vector<std::string> known = known_dofs(parts);
  for (const std::string& name : item.words("fix", "a list of " + listed(known))) {
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      const std::string guess = nearest(name, known);
      item.fault("fix", fmt::format("fix: expected one of {}, found '{}'{}", listed(known), name,
                                    guess.empty() ? "" : "; did you mean '" + guess + "'?"));
    } else if (const Entry* const moved = item.find("move");
               moved != nullptr && moved->find(name) != nullptr) {
      item.fault("fix", fmt::format("fix: {} is below 'move' too; keep one of them", name));
    } else {
      prescribe(item, "fix", places, dof_of(name), fem::TimeTable::constant(0.0), parts);
    }
  }
  return true;
}

template <int dim>
bool read_tractions(Section& item, const std::vector<std::string>& places, CaseParts& parts) {
  fem::BoundaryLoad<dim> load;
  const bool pressure = item.find("pressure") != nullptr;
  if (pressure) load.pressure = time_table(item, "pressure", Dimension::pressure, Single::constant, parts);
  const auto dimension = [](fem::Dof dof) {
    return fem::is_rotation(dof) ? Dimension::force_per_length : Dimension::pressure;
  };
  const bool traction = dof_tables(
      item, "traction", dimension, Single::constant, parts, [&](fem::Dof dof, const fem::TimeTable& value) {
        const auto place = static_cast<std::size_t>(fem::place_of<dim>(dof));
        if (fem::is_rotation(dof) && value.largest_magnitude() > 0.0 && is_cauchy(parts))
          refuse_rotation(item, "traction", dof, parts);
        (fem::is_rotation(dof) ? load.couple_traction[place - dim] : load.traction[place]) = value;
      });
  if (!pressure && !traction) return false;
  for (const std::string& place : places) {
    load.on = place;
    parts.result.problem_of<dim>().boundary_loads.push_back(load);
  }
  parts.check_places(item, "on", places, pressure ? "a pressure" : "a traction");
  return true;
}

bool read_node_forces(Section& item, const std::vector<std::string>& places, CaseParts& parts) {
  const bool space = parts.result.dimension() == 3;
  const auto dimension = [space](fem::Dof dof) {
    if (space) return fem::is_rotation(dof) ? Dimension::moment : Dimension::force;
    return fem::is_rotation(dof) ? Dimension::force : Dimension::force_per_length;
  };
  return dof_tables(
      item, "node_force", dimension, Single::constant, parts, [&](fem::Dof dof, const fem::TimeTable& value) {
        for (const std::string& place : places) {
          const bool is_moment = fem::is_rotation(dof);
          const NodesOfBeams beams = is_moment ? nodes_of_beams(place, parts) : NodesOfBeams{};
          if (is_moment && !beams.all && value.largest_magnitude() > 0.0 && is_cauchy(parts))
            refuse_rotation(item, "node_force", dof, parts);
          parts.result.with_problem([&](auto& problem) {
            problem.node_loads.push_back({place, dof, value, {}, beams.any ? fem::kBeamRotation : ""});
          });
        }
      });
}

/// `{on: left, tie: right}`
bool read_tie(Section& item, const std::vector<std::string>& places, CaseParts& parts) {
  if (item.find("tie") == nullptr) return false;
  if (parts.now.number > 0)
    item.fault("tie",
               "tie: sides are tied from the start to the end; put it into the list 'boundary' of the case");
  const std::string to = item.text("tie", "the name of the opposite boundary");
  if (places.size() > 1) item.fault("on", "on: a tie joins one boundary to one other; give one name");
  if (places.size() != 1 || to.empty() || !parts.has_mesh) return true;
  const fem::Tie tie{places.front(), to};
  parts.result.with_problem([&](auto& problem) {
    if (const std::string message = fem::tied_nodes(problem.mesh, tie).fault; !message.empty()) {
      item.fault("tie", "tie: " + message);
    } else {
      problem.ties.push_back(tie);
    }
  });
  return true;
}

/// Gives what an item has made its name and the stage that it begins with. An item of the same name ends.
/// @param before counts of the problem before the item was read
void give_name(Section& item, const CaseParts::Counts& before, CaseParts& parts) {
  const CaseParts::Made made{before, parts.counts()};
  parts.for_each(made, [&](auto& one) { one.life.begin = parts.now.number; });
  if (item.find("name") == nullptr) return;
  const std::string name = item.text("name", "a name, which stages may end it by");
  if (const auto other = parts.named.find(name); other != parts.named.end()) {
    if (parts.now.number == 0) item.fault("name", fmt::format("name: another item is called '{}' too", name));
    parts.for_each(other->second, [&](auto& one) { one.life.end = parts.now.number; });
  }
  parts.named[name] = made;
}

void read_boundary_item(const Entry& entry, const std::string& name, CaseParts& parts) {
  Section item(entry, name, parts.faults);
  const CaseParts::Counts before = parts.counts();
  const std::vector<std::string> places =
      item.words("on", "the name of a boundary or node set, or a list of them");
  const bool supports = read_supports(item, places, parts);
  const bool tractions =
      parts.result.space ? read_tractions<3>(item, places, parts) : read_tractions<2>(item, places, parts);
  const bool forces = read_node_forces(item, places, parts);
  const bool tie = read_tie(item, places, parts);
  const bool water =
      read_water_boundary(item, places, parts, [&](const std::string& key, Dimension dimension) {
        return time_table(item, key, dimension, Single::constant, parts);
      });
  give_name(item, before, parts);
  if (parts.now.number > 0 && item.find("from") != nullptr &&
      item.choice("from", {"here", "start"}) == "start") {
    parts.result.with_problem([&](auto& problem) {
      for (std::size_t k = before[0]; k < problem.prescribed.size(); ++k)
        problem.prescribed[k].from_here = false;
      for (std::size_t k = before[4]; k < problem.prescribed_fields.size(); ++k)
        problem.prescribed_fields[k].from_here = false;
    });
  }
  const bool quiet = item.find("quiet") != nullptr &&
                     item.choice("quiet", {"true", "false", "yes", "no"}).find_first_of("ty") == 0;
  if (quiet) {
    parts.check_places(item, "on", places, "a quiet boundary");
    parts.result.with_problem(
        [&](auto& problem) { problem.quiet.insert(problem.quiet.end(), places.begin(), places.end()); });
  }
  item.finish();
  if (!tractions) parts.check_places(item, "on", places);
  if (!supports && !tractions && !forces && !tie && !quiet && !water && entry.kind == Entry::Kind::map) {
    parts.faults.push_back(entry.fault(
        name +
        ": has no support and no load; give fix, move, accelerate, pressure, traction, node_force, tie or quiet, and "
        "with water drained, pore_pressure, water_level, free_water or flux"));
  }
}

/// A quiet boundary is let go once the start is balanced: a movement that is given there would be dropped.
/// @param first number of the first support of each item
void refuse_motion_of_quiet(const Entry& entry, const std::vector<std::size_t>& first, CaseParts& parts) {
  parts.result.with_problem([&](const auto& problem) {
    for (std::size_t i = 0; i < first.size(); ++i) {
      const std::size_t end = i + 1 < first.size() ? first[i + 1] : problem.prescribed.size();
      for (std::size_t k = first[i]; k < end; ++k) {
        const auto& given = problem.prescribed[k];
        if (fem::is_rotation(given.dof) || !given.value.changes() ||
            std::ranges::find(problem.quiet, given.on) == problem.quiet.end())
          continue;
        parts.faults.push_back(entry.items[i].fault(fmt::format(
            "boundary item {}: '{}' is quiet, which lets it go once the start is balanced: its movement "
            "would be dropped; move another boundary, or leave quiet out",
            i + 1, given.on)));
      }
    }
  });
}

/// Whether `entry` is a list; a fault with the example when it is not.
bool is_list(const Entry& entry, const std::string& key, const std::string& example, Faults& faults) {
  if (entry.kind == Entry::Kind::sequence) return true;
  faults.push_back(entry.fault(fmt::format("{}: expected a list, each item a map such as {}", key, example)));
  return false;
}

template <int dim>
void read_body_item(const Entry& entry, const std::string& name, CaseParts& parts) {
  Section item(entry, name, parts.faults);
  const CaseParts::Counts before = parts.counts();
  const std::string region = parts.region(item, "region");
  const fem::TimeTable factor = item.find("factor") == nullptr
                                    ? fem::TimeTable::constant(1.0)
                                    : time_table(item, "factor", Dimension::number, Single::constant, parts);
  const bool weight = item.find("unit_weight") != nullptr;
  const bool force = item.find("force") != nullptr;
  if (weight == force && entry.kind == Entry::Kind::map) {
    parts.faults.push_back(entry.fault(
        name +
        fmt::format(
            ": expected either 'unit_weight', for example 18 kN/m3, or 'force', a list of its {} components",
            dim)));
  } else if (weight) {
    const double value = item.quantity("unit_weight", Dimension::unit_weight, Limit::not_negative);
    parts.result.problem_of<dim>().body_loads.push_back(fem::gravity<dim>(value, factor, region));
  } else {
    const std::vector<double> b = item.quantities("force", dim, Dimension::unit_weight, Limit::any);
    typename Cosserat<dim>::NodeValues density = Cosserat<dim>::NodeValues::Zero();
    for (int i = 0; i < dim; ++i) density(i) = b[static_cast<std::size_t>(i)];
    parts.result.problem_of<dim>().body_loads.push_back(
        {[density](const typename Cosserat<dim>::Place&) { return density; }, factor, region});
  }
  give_name(item, before, parts);
  item.finish();
}

/// Indices of the components of a given initial stress, in their order.
template <int dim>
std::vector<std::pair<int, int>> given_components() {
  if constexpr (dim == 2) return {{0, 0}, {1, 1}, {2, 2}, {0, 1}};
  return {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
}

template <int dim>
void read_initial_stress_item(const Entry& entry, const std::string& name, CaseParts& parts) {
  Section item(entry, name, parts.faults);
  const std::string region = parts.region(item, "region");
  const bool given = item.find("stress") != nullptr;
  const bool ground = item.find("surface") != nullptr;
  if (given == ground && entry.kind == Entry::Kind::map) {
    parts.faults.push_back(entry.fault(name + ": expected either 'stress', a list of s11, s22, s33, s12, or "
                                              "'surface', the height of level ground"));
  } else if (given) {
    using Counts = Cosserat<dim>;
    const auto components = given_components<dim>();
    const std::vector<double> s =
        item.quantities("stress", components.size(), Dimension::pressure, Limit::any);
    typename Counts::Vector stress = Counts::Vector::Zero();
    for (std::size_t k = 0; k < components.size(); ++k) {
      const auto [i, j] = components[k];
      if (i == 2 && dim == 2) {
        stress(k33) = s[k];
        continue;
      }
      stress(Counts::stress_place(i, j)) = stress(Counts::stress_place(j, i)) = s[k];
    }
    parts.result.problem_of<dim>().initial_stresses.push_back(
        {[stress](const typename Counts::Place&) { return stress; }, region});
  } else {
    fem::Ground level;
    level.surface_height = item.quantity("surface", Dimension::length, Limit::any);
    level.unit_weight = item.quantity("unit_weight", Dimension::unit_weight, Limit::not_negative);
    // No number: the stresses across are those of the material.
    level.earth_pressure_ratio =
        item.quantity_or_word("K0", Dimension::number, Limit::not_negative, {"measured"})
            .value_or(std::nan(""));
    level.surcharge = item.quantity_or("surcharge", Dimension::pressure, Limit::any, 0.0);
    // Stress is effective where the pores hold water, so regions with and without water have items of their own.
    const bool wets = parts.water && parts.water->options.table;
    std::vector<std::string> regions{region};
    if (wets && region.empty()) {
      regions.clear();
      for (const auto& [name, material] : parts.result.regions) regions.push_back(name);
    }
    for (const std::string& name : regions) {
      level.water_level = {};
      if (wets && parts.water->regions.contains(name)) level.water_level = parts.water->options.table;
      if (wets) level.water_weight = parts.water->options.unit_weight;
      parts.result.problem_of<dim>().initial_stresses.push_back(fem::geostatic_stress<dim>(level, name));
    }
  }
  item.finish();
}

}  // namespace

void read_boundary_of_stage(const Entry& entry, const std::string& name, CaseParts& parts) {
  if (!is_list(entry, name + ": boundary", "{on: bottom, fix: [u2]}", parts.faults)) return;
  for (std::size_t i = 0; i < entry.items.size(); ++i)
    read_boundary_item(entry.items[i], fmt::format("{}: boundary item {}", name, i + 1), parts);
}

void read_body_of_stage(const Entry& entry, const std::string& name, CaseParts& parts) {
  const std::string prefix = name.empty() ? name : name + ": ";
  if (!is_list(entry, prefix + "body", "{unit_weight: 18 kN/m3}", parts.faults)) return;
  for (std::size_t i = 0; i < entry.items.size(); ++i) {
    const std::string item = fmt::format("{}body item {}", prefix, i + 1);
    parts.result.space ? read_body_item<3>(entry.items[i], item, parts)
                       : read_body_item<2>(entry.items[i], item, parts);
  }
}

void read_boundary(const Entry& entry, CaseParts& parts) {
  const std::size_t faults_before = parts.faults.size();
  if (!is_list(entry, "boundary", "{on: bottom, fix: [u2]}", parts.faults)) return;
  std::vector<std::size_t> first;
  for (std::size_t i = 0; i < entry.items.size(); ++i) {
    first.push_back(parts.counts()[0]);
    read_boundary_item(entry.items[i], fmt::format("boundary item {}", i + 1), parts);
  }
  refuse_motion_of_quiet(entry, first, parts);
  // Where parts come or go, each stage is looked at when all of them are known.
  if (!parts.has_mesh || parts.faults.size() != faults_before || parts.builds) return;
  const std::vector<std::string> motions = parts.result.with_problem([](const auto& problem) {
    return fem::free_rigid_motions(problem.mesh, problem.continuum, problem.prescribed, problem.ties, {},
                                   fem::joined_nodes(problem));
  });
  for (const std::string& motion : motions) {
    parts.faults.push_back(
        entry.fault(fmt::format("boundary: nothing holds the body against a rigid motion ({}); fix or move a "
                                "displacement that stops it",
                                motion)));
  }
}

void read_body_loads(const Entry& entry, CaseParts& parts) {
  read_body_of_stage(entry, "", parts);
}

void read_initial_stress(const Entry& entry, CaseParts& parts) {
  const std::string example = "{surface: 10 m, unit_weight: 18 kN/m3, K0: 0.5}";
  if (!is_list(entry, "initial_stress", example, parts.faults)) return;
  // The last item counts. An item of a region comes behind those of the whole body, wherever it is written.
  for (const bool has_region : {false, true})
    for (std::size_t i = 0; i < entry.items.size(); ++i) {
      if ((entry.items[i].find("region") != nullptr) != has_region) continue;
      const std::string name = fmt::format("initial_stress item {}", i + 1);
      parts.result.space ? read_initial_stress_item<3>(entry.items[i], name, parts)
                         : read_initial_stress_item<2>(entry.items[i], name, parts);
    }
}

}  // namespace polargrain::coupler
