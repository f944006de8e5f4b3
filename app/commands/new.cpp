// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/new_texts.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "common/write_file.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/case/element_limits.hpp"
#include "coupler/case/quantity.hpp"
#include "fem/mesh/gmsh.hpp"

namespace polargrain::app {
namespace {

struct NewOptions {
  std::string kind;
  std::filesystem::path directory;
  int grains = 0;
  std::string pressure;
  std::vector<std::string> size;
  std::vector<int> elements;
  bool rolling = false;
  std::string scheme;
  std::filesystem::path mesh;
  bool no_pack = false;
  ScriptRules scripts = {};
};

/// A kind of case to make, and the options that it takes beside -o.
struct NewKind {
  std::string name;
  std::string summary;
  std::vector<std::string> options;
  NewCase start = {};
};

constexpr const char* kSlopeHead =
    "# A slope of a law with friction, dilatancy and a cohesion that falls with the plastic shear. The mesh is made\n"
    "# of slope.geo: gmsh -2 slope.geo. Its physical groups are the names under regions and boundary.\n"
    "# SI units unless a unit is written. All keys: docs/user_guide.md\n";

constexpr const char* kExcavationHead =
    "# A pit behind an anchored sheet pile. Names of regions and lines are those of the mesh; each stage names its changes.\n"
    "# SI units unless a unit is written. All keys: docs/user_guide.md\n";

constexpr const char* kQuayHead =
    "# A quay wall in water: at rest, wall and anchor, dredged in cuts, low water, load. Each stage names its changes.\n"
    "# 'sea' presses on the bare wall and the bed; below 'interfaces' is how tight the wall is.\n"
    "# SI units unless a unit is written. All keys: docs/user_guide.md\n";

const std::vector<NewKind>& new_kinds() {
  static const std::vector<NewKind> kinds = [] {
    NewCase sparing;
    sparing.scheme = "adaptive";
    sparing.grains = 100;
    NewCase in_space;
    in_space.spheres = true;
    in_space.grains = 300;
    NewCase wall = sparing;
    wall.scheme = "cell";
    NewCase column = in_space;
    column.scheme = "adaptive";
    column.width = 0.1;
    column.height = 0.2;
    column.columns = 2;
    column.rows = 4;
    NewCase square_footing = column;
    square_footing.columns = 4;
    square_footing.rows = 3;
    const std::vector<std::string> of_packing{"--grains", "--pressure", "--rolling", "--no-pack"};
    const auto with = [&](std::vector<std::string> more) {
      more.insert(more.end(), of_packing.begin(), of_packing.end());
      return more;
    };
    return std::vector<NewKind>{
        {"biaxial", "compression of grains between rough plates", with({"--size", "--elements", "--scheme"})},
        {"footing", "a strip footing pushed into ground of grains", with({"--scheme"}), sparing},
        {"slope", "a slope of an elastoplastic law, no grains: its weight, then a load on its crest", {}},
        {"excavation",
         "a pit behind an anchored sheet pile, dug in stages, in ground of a law, no grains",
         {}},
        {"quay",
         "an anchored quay wall in water, dredged in stages, at low water, in ground of a law; with --grains of boxes behind the wall",
         of_packing, wall},
        {"element", "a laboratory test of one box of grains, for polargrain element", with({})},
        {"triaxial", "a triaxial test of one box of spheres, for polargrain element", with({}), in_space},
        {"triaxial3d", "compression of a square column of spheres between rough plates, in space",
         with({"--size", "--elements", "--scheme"}), column},
        {"footing3d", "a quarter of a square footing on ground of spheres, in space", with({"--scheme"}),
         square_footing},
        {"mesh", "a start on your own mesh (--mesh), its physical groups named in comments",
         with({"--mesh", "--scheme"}), sparing},
    };
  }();
  return kinds;
}

/// Whether it is a ready case of a law, without a packing.
bool is_of_law(const NewKind& kind, const NewOptions& options) {
  return kind.name == "slope" || kind.name == "excavation" || (kind.name == "quay" && options.grains == 0);
}

/// Whether it is a test of one box of grains and no case.
bool is_test(const NewKind& kind) {
  return kind.name == "element" || kind.name == "triaxial";
}

const NewKind& kind_named(const std::string& name) {
  std::string names;
  for (const NewKind& kind : new_kinds()) {
    if (kind.name == name) return kind;
    names += (names.empty() ? "" : ", ") + kind.name;
  }
  throw InputError({"", 0, fmt::format("new: there is no kind '{}'; one of {}", name, names)});
}

void refuse_other_options(const NewKind& kind, const CLI::App& command) {
  for (const CLI::Option* option : command.get_options()) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "KIND" || option->check_name("-o")) continue;
    if (std::ranges::find(kind.options, name) != kind.options.end()) continue;
    throw InputError(
        {"", 0,
         fmt::format(
             "new {}: {} is not for this kind{}", kind.name, name,
             kind.name == "slope"
                 ? "; a slope begins without stress, boxes of grains under the pressure of their packing"
             : kind.options.empty()
                 ? "; its ground begins with the stress of its depth, boxes of grains under one pressure"
                 : fmt::format("; it takes {}", fmt::join(kind.options, ", ")))});
  }
}

double positive(const std::string& option, const std::string& text, coupler::Dimension dimension) {
  const std::optional<double> value = coupler::parse_quantity(text, dimension);
  if (!value || *value <= 0.0)
    throw InputError({"", 0,
                      fmt::format("new: {} {}: expected {}, more than zero", option, text,
                                  coupler::expectation(dimension))});
  return *value;
}

NewCase new_case(const NewOptions& options, const NewKind& kind) {
  NewCase what = kind.start;
  if (options.grains > 0) what.grains = options.grains;
  if (!options.pressure.empty()) {
    what.pressure = positive("--pressure", options.pressure, coupler::Dimension::pressure);
    if (what.pressure < coupler::kLeastPlainPressure && coupler::is_plain_number(options.pressure))
      throw InputError(
          {"", 0,
           fmt::format("new: --pressure {0}: without a unit it is {0} Pa; write '{0}kPa', or '{0}Pa'",
                       options.pressure)});
  }
  if (!options.size.empty()) {
    what.width = positive("--size", options.size[0], coupler::Dimension::length);
    what.height = positive("--size", options.size[1], coupler::Dimension::length);
  }
  if (!options.elements.empty()) {
    what.columns = options.elements[0];
    what.rows = options.elements[1];
    const double across = what.spheres ? what.columns : 1.0;
    if (const std::string fault =
            coupler::too_many_elements(what.spheres ? 3 : 2, across * what.columns * what.rows);
        !fault.empty())
      throw InputError({"", 0, fmt::format("new: --elements {} {}: {}", what.columns, what.rows, fault)});
  }
  if (!options.scheme.empty()) what.scheme = options.scheme;
  what.rolling = options.rolling;
  return what;
}

/// @throws InputError unless the folder can be made or is empty
void check_directory(const std::filesystem::path& directory) {
  std::error_code error;
  if (!std::filesystem::exists(directory, error)) return;
  if (!std::filesystem::is_directory(directory, error))
    throw InputError({"", 0, fmt::format("-o {}: this is a file; name a new folder", directory.string())});
  if (!std::filesystem::is_empty(directory, error))
    throw InputError({"", 0,
                      fmt::format("-o {}: the folder has files in it, which are left alone; name a new one",
                                  directory.string())});
}

std::string brought_file(const std::string& name) {
  const auto file = coupler::find_data_file(name, {});
  if (!file)
    throw RunError(
        fmt::format("{}, which comes with the program, is not found: set POLARGRAIN_DATA to the folder "
                    "that has liggghts_inputs/ and cases/",
                    name));
  return coupler::content_of(*file);
}

struct NewFile {
  std::string name;
  std::string text;
};

/// All files of the folder but the packing, the one that a person begins with first.
std::vector<NewFile> new_files(const NewOptions& options, const NewKind& kind) {
  const NewCase what = new_case(options, kind);
  if (kind.name == "slope") {
    std::vector<NewFile> files;
    for (const std::string name : {"case.yaml", "slope.msh", "slope.geo"})
      files.push_back({name, brought_file("cases/slope/" + name)});
    files.front().text = kSlopeHead + files.front().text;
    return files;
  }
  if (kind.name == "excavation")
    return {{"case.yaml", kExcavationHead + brought_file("cases/excavation/case.yaml")}};
  std::vector<NewFile> files;
  if (kind.name == "quay") {
    const std::string of_law = kQuayHead + brought_file("cases/quay/case.yaml");
    if (is_of_law(kind, options)) return {{"case.yaml", of_law}};
    files.push_back({"case.yaml", quay_on_grains_text(what, of_law)});
  }
  if (kind.name == "biaxial") files.push_back({"case.yaml", biaxial_text(what)});
  if (is_test(kind)) files.push_back({"test.yaml", element_text(what)});
  if (kind.name == "triaxial3d") files.push_back({"case.yaml", triaxial_in_space_text(what)});
  if (kind.name == "footing3d") files.push_back({"case.yaml", footing_in_space_text(what)});
  if (kind.name == "footing") {
    files.push_back({"case.yaml", footing_text(what)});
    for (const std::string name : {"footing.msh", "footing.geo"})
      files.push_back({name, brought_file("cases/footing/" + name)});
  }
  if (kind.name == "mesh") {
    if (options.mesh.empty()) throw InputError({"", 0, "new mesh: name the mesh, --mesh FILE.msh"});
    if (options.mesh.extension() != ".msh")
      throw InputError(
          {"", 0,
           fmt::format("new mesh: --mesh {}: expected a mesh that Gmsh has written, whose name ends in .msh",
                       options.mesh.string())});
    const std::string name = options.mesh.filename().string();
    files.push_back({"case.yaml", mesh_text(what, fem::read_gmsh(options.mesh), name)});
    files.push_back({name, coupler::content_of(options.mesh)});
  }
  files.push_back({"packing.yaml", packing_text(what)});
  const char* const script = what.spheres
                                 ? (what.rolling ? "cells/spheres_li_chu.in" : "cells/spheres_hooke_radii.in")
                             : what.rolling ? "cells/hooke_rolling.in"
                                            : "cells/hooke_radii.in";
  files.push_back({"cell.in", brought_file(script)});
  return files;
}

int write_new(const NewOptions& options, const CLI::App& command, const PackingTools& tools) {
  const NewKind& kind = kind_named(options.kind);
  refuse_other_options(kind, command);
  if (kind.name == "quay" && options.grains == 0 &&
      command.count("--pressure") + command.count("--rolling") > 0)
    throw InputError(
        {"", 0, "new quay: --pressure and --rolling go with --grains; without it a law is the ground"});
  check_directory(options.directory);
  const std::vector<NewFile> files = new_files(options, kind);
  std::filesystem::create_directories(options.directory);
  std::string names;
  for (const NewFile& file : files) {
    write_file(options.directory / file.name, file.text);
    names += (names.empty() ? "" : ", ") + file.name;
  }
  tell(stdout, "{}: {}\n", options.directory.string(), names);
  const std::filesystem::path packing = options.directory / "packing.h5";
  const bool has_packing = !is_of_law(kind, options);
  if (has_packing && !options.no_pack) {
    PackOptions packs;
    packs.specification_file = options.directory / "packing.yaml";
    packs.output = packing;
    packs.scripts = options.scripts;
    pack(packs, tools);
  }
  tell(stdout, "Next, after a look at {}:\n", (options.directory / files.front().name).string());
  if (has_packing && options.no_pack)
    tell(stdout, "  polargrain pack {} -o {}\n", (options.directory / "packing.yaml").string(),
         packing.string());
  const std::string file = (options.directory / files.front().name).string();
  if (is_test(kind))
    tell(stdout, "  polargrain element {} -o {}\n", file,
         (options.directory / (kind.name == "triaxial" ? "triaxial" : "biaxial")).string());
  else
    tell(stdout, "  polargrain check {0}\n  polargrain run {0}\n", file);
  return 0;
}

std::string new_description() {
  std::string text =
      "Write a commented case of your own into a new folder, with all its files; it runs as it is\n\n"
      "  polargrain new biaxial -o mine --grains 100 --elements 3 6\n"
      "  polargrain new footing -o mine --rolling --scheme adaptive\n"
      "  polargrain new mesh --mesh dam.msh -o mine --pressure '200 kPa'\n\n"
      "Kinds:\n";
  for (const NewKind& kind : new_kinds())
    text += fmt::format("  {:<11}{}{}{}\n", kind.name, kind.summary,
                        kind.options.empty() ? "" : "\n             ", fmt::join(kind.options, " "));
  return text +
         "\nThe grains are discs (triaxial and in space: spheres) after packing.yaml: change it and make them again with polargrain pack. A folder with files in "
         "it is refused.";
}

}  // namespace

Command add_new(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<NewOptions>();
  CLI::App& command = *program.add_subcommand("new", "Write a commented case of your own that runs as it is");
  command.description(new_description());
  command.add_option("KIND", options->kind, "Kind of case")->required();
  command.add_option("-o,--output", options->directory, "Folder to write, new or empty")
      ->required()
      ->type_name("DIR");
  command
      .add_option(
          "--grains", options->grains,
          "Grains of the packing [400; footing and mesh 100, triaxial and in space 300; a quay needs it for boxes]")
      ->type_name("N")
      ->check(CLI::Range(4, 20000));
  command
      .add_option("--pressure", options->pressure,
                  "Of the packing and around the body, with its unit [100kPa]")
      ->type_name("P");
  command
      .add_option("--size", options->size,
                  "Width and height of the specimen [0.4m 0.8m; triaxial3d 0.1m 0.2m]")
      ->type_name("W H")
      ->expected(2);
  command.add_option("--elements", options->elements, "Elements along both [5 10; triaxial3d 2 4]")
      ->type_name("NX NY")
      ->expected(2)
      ->check(CLI::Range(1, 10000));
  command.add_flag("--rolling", options->rolling, "Contacts resist rolling");
  command
      .add_option("--scheme", options->scheme,
                  "cell, adaptive or informed [cell; footing, mesh and in space adaptive]")
      ->type_name("NAME")
      ->check(CLI::IsMember({"cell", "adaptive", "informed"}));
  command.add_option("--mesh", options->mesh, "Mesh written by Gmsh")->type_name("FILE.msh");
  command.add_flag("--no-pack", options->no_pack, "Write the specification of the packing, do not make it");
  options->scripts.more_commands = grains.engine.script_commands;
  return {&command,
          [options, &command, &tools = grains.packing_tools] { return write_new(*options, command, tools); }};
}

}  // namespace polargrain::app
