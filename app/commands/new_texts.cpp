// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/new_texts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "common/error.hpp"
#include "fem/solver/stages.hpp"

namespace polargrain::app {
namespace {

constexpr const char* kPackingText =
    R"(# The grains of the case. Make them again after a change: polargrain pack packing.yaml -o packing.h5
# All keys: docs/user_guide.md, Packings
title: @GRAINS@ dense @SHAPES@ under @PRESSURE@
grains: @GRAINS@                         # more of them scatter less and cost more
sizes: {law: uniform, radius: [3 mm, 7 mm]}   # or a grading curve: {law: sieve, diameter: [...], passing: [0, ..., 100 %]}
density: 2650                       # of the grains, kg/m^3
@SPACE@
script: cell.in                     # contact model and its parameters, a LIGGGHTS input script
pressure: @PRESSURE@
friction: 0                         # while the packing is made: 0 gives the densest; the script's own afterwards
seed: 1                             # another seed, another packing of the same kind
)";

constexpr const char* kMaterialText = R"(materials:
  sand:
    model: @SCHEME@                 # @SCHEME_MEANING@
    script: cell.in                 # contact model and its parameters, a LIGGGHTS input script
    packing: packing.h5             # made of packing.yaml, at rest under @PRESSURE@
    # G and Gc, stiffness against shear and against rotation of the grains relative to the continuum, are those of the
    # contact network of the packing unless they are given here.
    # Internal length: it sets the width of a shear band. As small as these elements resolve (2.5 lc); the grains alone would
    # have about a mean diameter, and a mesh as fine as that many times the points.
    lc: @LENGTH@
@SCHEME_KEYS@)";

constexpr const char* kBiaxialText =
    R"(# Biaxial compression between rough plates: @POINTS@ points, at each a periodic box of @GRAINS@ discs of its own.
# SI units unless a unit is written. All keys: docs/user_guide.md
title: Biaxial compression of @POINTS@ boxes of @GRAINS@ grains between rough plates

mesh:
  rectangle: {size: [@WIDTH@ m, @HEIGHT@ m], elements: [@COLUMNS@, @ROWS@]}
  element: Q8R                      # 8 nodes, 2x2 points
continuum: cosserat

@MATERIALS@regions: {all: sand}

boundary:                           # left, right, bottom and top are the sides of a rectangle
  - {on: bottom, fix: [u1, u2]}                     # rough plates: no sliding along them
  - {on: top, fix: [u1], move: {u2: -@SHORTENING@ m}}    # 2.3 % of the height
  - {on: [left, right], pressure: @PRESSURE@}         # that of the packing

@STEPS@

monitors:                           # columns of history.csv
  top_force: {on: top, reaction: u2}
  shortening: {on: top, displacement: u2}
  axial_strain: -shortening / @HEIGHT@ m
  stress_ratio: -top_force / (@WIDTH@ m * @PRESSURE@)

output: {every: 3, table: [axial_strain, stress_ratio, volume_strain]}
)";

constexpr const char* kFootingText =
    R"(# A rough strip footing of half width 1 m, pushed into weightless ground of grains under @PRESSURE@.
# The left side is the plane of symmetry. The mesh is made of footing.geo: gmsh -2 footing.geo
# SI units unless a unit is written. All keys: docs/user_guide.md
title: Strip footing on ground of grains

mesh: {file: footing.msh, element: Q8R}

@MATERIALS@regions: {ground: sand}

boundary:                           # the physical groups of the mesh
  - {on: base, fix: [u1, u2]}
  - {on: sides, fix: [u1, w]}       # the plane of symmetry turns nothing, nor does the far side
  - {on: footing, fix: [u1], move: {u2: -@SETTLEMENT@ m}}   # rough
  - {on: surface, pressure: @PRESSURE@}                # that of the packing

@STEPS@

monitors:                           # columns of history.csv
  footing_force: {on: footing, reaction: u2}
  settlement: {on: footing, displacement: u2}
  pressure: -footing_force / 1 m

output: {every: 4, table: [settlement, pressure]}
)";

constexpr const char* kTriaxialInSpaceText =
    R"(# Triaxial compression of a square column between rough plates: @POINTS@ points, at each a periodic box of @GRAINS@ spheres.
# SI units unless a unit is written; x3 points up. All keys: docs/user_guide.md
title: Triaxial compression of @POINTS@ boxes of @GRAINS@ spheres between rough plates

mesh:
  box: {size: [@WIDTH@ m, @WIDTH@ m, @HEIGHT@ m], elements: [@COLUMNS@, @COLUMNS@, @ROWS@]}
  element: H20R                     # 20 nodes, 2x2x2 points
continuum: cosserat

@MATERIALS@regions: {all: sand}

boundary:                           # left and right, front and back, bottom and top are the sides of a box
  - {on: bottom, fix: [u1, u2, u3]}                 # rough plates: no sliding along them
  - {on: top, fix: [u1, u2], move: {u3: -@SHORTENING@ m}}    # 2 % of the height
  - {on: [left, right, front, back], pressure: @PRESSURE@}   # that of the packing

@STEPS@

monitors:                           # columns of history.csv
  top_force: {on: top, reaction: u3}
  shortening: {on: top, displacement: u3}
  axial_strain: -shortening / @HEIGHT@ m
  stress_ratio: -top_force / (@WIDTH@ m * @WIDTH@ m * @PRESSURE@)

output: {every: 2, table: [axial_strain, stress_ratio, volume_strain]}
)";

constexpr const char* kFootingInSpaceText =
    R"(# A quarter of a rough square footing of 1 m, pushed into weightless ground of spheres under @PRESSURE@: @POINTS@ points.
# SI units unless a unit is written; x3 points up. All keys: docs/user_guide.md
title: Square footing on ground of spheres

mesh:
  box: {size: [2 m, 2 m, 1.5 m], elements: [@COLUMNS@, @COLUMNS@, @ROWS@], patch: [0.5 m, 0.5 m, 1.5 m]}   # one element under the plate: a first look
  element: H20R                     # 20 nodes, 2x2x2 points

@MATERIALS@regions: {patch: sand, rest: sand}   # under the footing, and beside it

boundary:                           # top_patch and top_rest: the faces of the top that belong to the patch and to the rest
  - {on: bottom, fix: [u1, u2, u3]}
  - {on: left, fix: [u1, w2, w3]}                   # planes of symmetry
  - {on: front, fix: [u2, w1, w3]}
  - {on: right, fix: [u1]}
  - {on: back, fix: [u2]}
  - {on: top_patch, fix: [u1, u2], move: {u3: -@SETTLEMENT@ m}}   # rough
  - {on: top_rest, pressure: @PRESSURE@}               # that of the packing

@STEPS@

monitors:                           # columns of history.csv
  footing_force: {on: top_patch, reaction: u3}
  settlement: {on: top_patch, displacement: u3}
  pressure: -footing_force / (0.5 m * 0.5 m)

output: {every: 2, table: [settlement, pressure]}
)";

constexpr const char* kElementText =
    R"(# A laboratory test of one box of grains: polargrain element test.yaml -o @TEST@
# All keys, and tests in stages: docs/element_tests.md
title: Dense @SHAPES@ at @PRESSURE@, drained @TEST@ compression
packing: [packing.h5]               # several packings give a mean with its interval: [packing.h5, packing2.h5, ...]
script: cell.in                     # contact model and its parameters, a LIGGGHTS input script
pressure: @PRESSURE@                   # all-round, before the test
test: @TEST@                      # others: polargrain element --help
axial_strain: 4 %                   # negative: extension
rows: 80                            # of the table
)";

constexpr const char* kMeshText =
    R"(# A case on a mesh of your own. SI units unless a unit is written. All keys: docs/user_guide.md
# In @QUOTED_FILE@ (@NODES@ nodes, @ELEMENTS@ elements, @LEFT@ m to @RIGHT@ m along 1, @BELOW@ m to @ABOVE@ m along 2):
#   regions (physical surfaces):   @REGIONS@
#   boundaries (physical curves):  @BOUNDARIES@
#   node sets (physical points):   @NODE_SETS@
title: A case on a mesh of its own

mesh: {file: @QUOTED_FILE@, element: Q8R}

@MATERIALS@regions: {all: sand}                # every element needs one; or a material for each of the regions above

# A start, to be changed. The lowest boundary is held; the others carry the pressure that the grains are packed under,
# which rises by a tenth on the highest one. Parts of the outline that are no physical curve carry nothing: the boxes of
# grains there are then not in balance with what is around them.
#   - {on: NAME, fix: [u1, u2, w]}            what stays zero: displacements, micro-rotation
#   - {on: NAME, move: {u2: -1 mm}}           goes there in a straight line
#   - {on: NAME, traction: {u1: 5 kPa}}       along 1 and 2
boundary:
@LOADS@
@STEPS@

monitors:                           # columns of history.csv
@MONITORS@
output: {every: 4}
)";

using Values = std::vector<std::pair<std::string, std::string>>;

std::string filled(std::string text, const Values& values) {
  for (const auto& [name, value] : values) {
    const std::string mark = "@" + name + "@";
    for (std::size_t at = text.find(mark); at != std::string::npos; at = text.find(mark, at + value.size()))
      text.replace(at, mark.size(), value);
  }
  return text;
}

std::string pascals(double pressure) {
  return fmt::format("{:g} kPa", 1e-3 * pressure);
}

std::string meaning_of(const std::string& scheme) {
  if (scheme == "adaptive")
    return "boxes of grains only where the tolerance asks for them; cell (without tolerance): everywhere";
  if (scheme == "informed") return "a law carries the stress, boxes of grains tell it friction and dilatancy";
  return "a box of grains at every point; adaptive: only where a tolerance asks for them";
}

/// With `informed` no iteration asks grains, so that its line search is free.
std::string steps_text(const NewCase& what, int count, const std::string& tolerance) {
  if (what.scheme == "informed")
    return fmt::format("steps: {{count: {}, cut: 10, iterations: 50, line_search: 5, tolerance: {}}}",
                       2 * count, tolerance);
  return fmt::format("steps: {{count: {}, cut: 6, iterations: 20, tolerance: {}}}", count, tolerance);
}

/// The internal length that elements of a size resolve, rounded up to two digits, m.
std::string resolved_length(double element) {
  constexpr double kElementsOverLength = 2.5;  // docs/settings.md
  const double length = element / kElementsOverLength;
  double unit = 1.0;
  while (unit > length) unit *= 0.1;
  while (10.0 * unit <= length) unit *= 10.0;
  return fmt::format("{:.3g} m", 0.1 * unit * std::ceil(10.0 * length / unit - 1e-6));
}

/// The keys that a scheme has of its own.
std::string keys_of(const std::string& scheme) {
  if (scheme == "adaptive")
    return "    adaptive: {tolerance: 3 %}      # error in stress of a point, of the pressure of the packing\n";
  if (scheme == "cell")
    return "    tangent: secant                 # condensed: boxes find one in each iteration, which takes more time\n";
  return "";
}

std::string materials_text(const NewCase& what, const std::string& length) {
  return filled(kMaterialText, {{"SCHEME", what.scheme},
                                {"SCHEME_MEANING", meaning_of(what.scheme)},
                                {"SCHEME_KEYS", keys_of(what.scheme)},
                                {"PRESSURE", pascals(what.pressure)},
                                {"LENGTH", length}});
}

bool is_plain(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && is_letter(name.front()) && std::ranges::all_of(name, [&](char c) {
    return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '.';
  });
}

/// A name as YAML takes it, on one line whatever is in it.
std::string yaml_name(const std::string& name) {
  if (is_plain(name)) return name;
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"' || c == '\\') text += '\\';
    if (static_cast<unsigned char>(c) < 0x20)
      text += fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    else
      text += c;
  }
  return text + '"';
}

template <typename Map>
std::string names_of(const Map& map) {
  std::string text;
  for (const auto& [name, content] : map) text += (text.empty() ? "" : ", ") + yaml_name(name);
  return text.empty() ? "none" : text;
}

std::string shapes(const NewCase& what) {
  return what.spheres ? "spheres" : "discs";
}

double mean_height(const fem::Mesh<2>& mesh, const std::string& boundary) {
  double sum = 0.0;
  const std::vector<int> nodes = mesh.nodes_on(boundary);
  for (const int node : nodes) sum += mesh.nodes[node].y();
  return sum / static_cast<double>(nodes.size());
}

}  // namespace

std::string packing_text(const NewCase& what) {
  return filled(kPackingText,
                {{"GRAINS", std::to_string(what.grains)},
                 {"SHAPES", shapes(what)},
                 {"SPACE", what.spheres ? "dimension: 3                        # spheres in space"
                                        : "thickness: 100 mm"},
                 {"PRESSURE", pascals(what.pressure)}});
}

std::string biaxial_text(const NewCase& what) {
  return filled(kBiaxialText,
                {{"MATERIALS", materials_text(what, resolved_length(std::sqrt(what.width / what.columns *
                                                                              what.height / what.rows)))},
                 {"STEPS", steps_text(what, 23, "1e-2")},
                 {"POINTS", std::to_string(4 * what.columns * what.rows)},
                 {"GRAINS", std::to_string(what.grains)},
                 {"WIDTH", fmt::format("{:g}", what.width)},
                 {"HEIGHT", fmt::format("{:g}", what.height)},
                 {"SHORTENING", fmt::format("{:g}", 0.023 * what.height)},
                 {"COLUMNS", std::to_string(what.columns)},
                 {"ROWS", std::to_string(what.rows)},
                 {"PRESSURE", pascals(what.pressure)}});
}

std::string footing_text(const NewCase& what) {
  // Contacts are linear, so that what a strain mobilises goes with the pressure: 20 mm at 100 kPa.
  return filled(kFootingText, {{"MATERIALS", materials_text(what, resolved_length(0.41))},
                               {"STEPS", steps_text(what, 8, "1e-3")},
                               {"SETTLEMENT", fmt::format("{:g}", 0.02 * what.pressure / 100e3)},
                               {"PRESSURE", pascals(what.pressure)}});
}

std::string quay_on_grains_text(const NewCase& what, std::string of_law) {
  const auto replace = [&of_law](const std::string& found, const std::string& text) {
    const std::size_t at = of_law.find(found);
    if (at == std::string::npos) throw RunError("cases/quay/case.yaml is not that of this version");
    of_law.replace(at, found.size(), text);
  };
  replace("materials:\n",
          fmt::format("materials:\n"
                      "  grains:                               # {} discs at each of 96 points\n"
                      "    {{model: cell, packing: packing.h5, script: cell.in}}\n",
                      what.grains));
  replace("near: sand", "near: grains");
  replace("tolerance: 1e-4\n", "tolerance: 1e-3\n  line_search: 3                        # boxes jump\n");
  replace("  # behind the wall: a material of its own when you like", "  # behind the wall");
  return of_law;
}

std::string triaxial_in_space_text(const NewCase& what) {
  const double across = what.width / what.columns;
  return filled(
      kTriaxialInSpaceText,
      {{"MATERIALS",
        materials_text(what, resolved_length(std::cbrt(across * across * what.height / what.rows)))},
       {"STEPS", steps_text(what, 20, "1e-2")},
       {"POINTS", std::to_string(8 * what.columns * what.columns * what.rows)},
       {"GRAINS", std::to_string(what.grains)},
       {"WIDTH", fmt::format("{:g}", what.width)},
       {"HEIGHT", fmt::format("{:g}", what.height)},
       {"SHORTENING", fmt::format("{:g}", 0.02 * what.height)},
       {"COLUMNS", std::to_string(what.columns)},
       {"ROWS", std::to_string(what.rows)},
       {"PRESSURE", pascals(what.pressure)}});
}

std::string footing_in_space_text(const NewCase& what) {
  return filled(kFootingInSpaceText,
                {{"MATERIALS", materials_text(what, resolved_length(2.0 / what.columns))},
                 {"STEPS", steps_text(what, 8, "1e-2")},
                 {"POINTS", std::to_string(8 * what.columns * what.columns * what.rows)},
                 {"COLUMNS", std::to_string(what.columns)},
                 {"ROWS", std::to_string(what.rows)},
                 {"SETTLEMENT", fmt::format("{:g}", 0.01 * what.pressure / 100e3)},
                 {"PRESSURE", pascals(what.pressure)}});
}

std::string element_text(const NewCase& what) {
  return filled(kElementText, {{"SHAPES", shapes(what)},
                               {"TEST", what.spheres ? "triaxial" : "biaxial"},
                               {"PRESSURE", pascals(what.pressure)}});
}

std::string mesh_text(const NewCase& what, const fem::Mesh<2>& mesh, const std::string& file) {
  std::vector<std::string> names;
  for (const auto& [name, edges] : mesh.boundaries)
    if (fem::covered_sides(mesh, edges, {}).empty()) names.push_back(name);  // others lie inside of the body
  if (names.empty())
    throw InputError(
        {file, 0,
         "the mesh names no boundary, so that no support or load can be given: in the script for Gmsh "
         "give curves a name, for example Physical Curve(\"base\") = {1};"});
  Eigen::Vector2d least = mesh.nodes.front();
  Eigen::Vector2d largest = least;
  for (const Eigen::Vector2d& node : mesh.nodes) {
    least = least.cwiseMin(node);
    largest = largest.cwiseMax(node);
  }
  std::ranges::stable_sort(names, {}, [&](const std::string& name) { return mean_height(mesh, name); });
  const std::string pressure = pascals(what.pressure);
  std::string loads = fmt::format("  - {{on: {}, fix: [u1, u2]}}\n", yaml_name(names.front()));
  std::string monitors = fmt::format("  base_force: {{on: {}, reaction: u2}}\n", yaml_name(names.front()));
  for (std::size_t k = 1; k < names.size(); ++k) {
    const bool is_highest = k + 1 == names.size();
    loads += fmt::format(
        "  - {{on: {}, pressure: {}}}\n", yaml_name(names[k]),
        is_highest ? fmt::format("[[0, {}], [1, {}]]", pressure, pascals(1.1 * what.pressure)) : pressure);
    if (is_highest)
      monitors += fmt::format("  settlement: {{on: {}, displacement: u2}}\n", yaml_name(names[k]));
  }
  const Eigen::Vector2d size = largest - least;
  const double element = std::sqrt(size.x() * size.y() / static_cast<double>(mesh.elements.size()));
  return filled(kMeshText, {{"MATERIALS", materials_text(what, resolved_length(element))},
                            {"STEPS", steps_text(what, 4, "1e-3")},
                            {"LEFT", fmt::format("{:g}", least.x())},
                            {"RIGHT", fmt::format("{:g}", largest.x())},
                            {"BELOW", fmt::format("{:g}", least.y())},
                            {"ABOVE", fmt::format("{:g}", largest.y())},
                            {"NODES", std::to_string(mesh.nodes.size())},
                            {"ELEMENTS", std::to_string(mesh.elements.size())},
                            {"LOADS", loads},
                            {"MONITORS", monitors},
                            {"REGIONS", names_of(mesh.regions)},
                            {"BOUNDARIES", names_of(mesh.boundaries)},
                            {"NODE_SETS", names_of(mesh.node_sets)},
                            {"QUOTED_FILE", yaml_name(file)}});
}

}  // namespace polargrain::app
