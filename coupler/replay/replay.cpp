// SPDX-License-Identifier: GPL-2.0-or-later
#include "coupler/replay/replay.hpp"

#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <numbers>
#include <span>

#include "common/elementary_functions.hpp"
#include "common/error.hpp"
#include "common/plane_in_space.hpp"
#include "common/record_values.hpp"
#include "grains_io/neighbour_distance.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::coupler {
namespace {

constexpr const char* kScript = "cell.in";
constexpr const char* kPacking = "packing.data";
constexpr const char* kPackingState = "packing.state";
constexpr const char* kState = "start.state";

class Folder {
 public:
  explicit Folder(const std::filesystem::path& directory) : directory_(directory) {
    std::error_code error;
    std::filesystem::create_directories(directory, error);
    for (const char* name : {kPackingState, kState}) std::filesystem::remove(directory / name, error);
  }
  void write(const char* name, const std::string& text) const {
    write(name, std::as_bytes(std::span(text.data(), text.size())));
  }
  void write(const char* name, std::span<const std::byte> bytes) const {
    const std::filesystem::path file = directory_ / name;
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    out.close();
    if (!out) throw RunError(fmt::format("the replay cannot be written: {}", file.string()));
  }

 private:
  std::filesystem::path directory_;
};

/// The mean grain, by the very additions by which the cell finds it: mass, radius, density.
std::string mean_grain(const Packing& packing) {
  const auto grains = static_cast<int>(packing.grains.size());
  double radius = 0.0;
  double mass = 0.0;
  double area = 0.0;
  for (const Grain& grain : packing.grains) {
    radius += grain.radius / grains;
    mass += grain.mass / grains;
    area += std::numbers::pi * grain.radius * grain.radius;
  }
  const double volume = packing.dimension == 3 ? packing.grain_volume() : area * packing.thickness;
  return fmt::format("{:.17g} {:.17g} {:.17g}", mass, radius, grains * mass / volume);
}

/// The numbers of an increment in the order of its description, which is that of `fix cell/load`.
std::string words_of(const CellIncrement& increment) {
  RecordValues values;
  append(values, increment, false);
  return fmt::format("{:.17g}", fmt::join(values.numbers, " "));
}

/// The commands of one increment: loading, then rest, then the answer on the screen.
std::string increment_commands(const CellIncrement& increment, std::size_t number) {
  return fmt::format(
      "\nprint           \"increment {0}\"\n"
      "fix_modify      cell increment {1}\n"
      "run             ${{loading}} post no\n"
      "label           rest{0}\n"
      "if              \"${{done}} == 1\" then \"jump SELF done{0}\"\n"
      "run             20 pre no post no\n"
      "jump            SELF rest{0}\n"
      "label           done{0}\n"
      "fix_modify      cell report {0}\n",
      number, words_of(increment));
}

/// How a replay is started, in its folder.
std::string command_of(const CellDefinition& definition) {
  return definition.contact_library.path.empty()
             ? "polargrain-liggghts -in in.replay"
             : fmt::format("polargrain-liggghts -contact {} -in in.replay", definition.contact_library.path);
}

std::string driver(const CellDefinition& definition, const Replay& replay) {
  const CellControl& control = definition.control;
  std::string text = fmt::format(
      "# Replays a cell of the material '{}' as a coupled run evaluates it.\n"
      "#   {}\n"
      "# The README beside this file explains it and names the results to expect. You may add dumps and thermo output behind\n"
      "# the fix: they leave the results as they are.\n\n"
      "variable        packing index {}\n"
      "variable        neighbour_distance index {}\n"
      "include         {}\n\n",
      definition.name, command_of(definition), kPacking, neighbour_distance(definition.packing), kScript);
  const bool controlled = definition.control.rotations == CellRotations::controlled;
  text += fmt::format(
      "fix             cell all cell/load version {} &\n"
      "                inertial_number {:.17g} damping {:.17g} least_steps {} &\n"
      "                unbalanced {:.17g} {:.17g} most_relaxation_steps {} &\n"
      "                rotations {} mean_grain {}",
      kReplayVersion, control.inertial_number, control.damping, control.least_steps,
      control.unbalanced_force_ratio, control.unbalanced_moment_ratio, control.most_relaxation_steps,
      controlled ? "controlled" : "free", mean_grain(definition.packing));
  const Eigen::Vector2d first = definition.packing.box.col(0);
  if (first.y() != 0.0 && definition.packing.dimension == 3) {
    text += " &\n                frame";
    const Eigen::Matrix3d frame = frame_of_packing_data(definition.packing);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) text += fmt::format(" {:.17g}", frame(i, j));
  } else if (first.y() != 0.0)
    text += fmt::format(" &\n                turned {:.17g}", arc_tangent(first.y(), first.x()));
  if (definition.packing.state) text += fmt::format(" &\n                packing_state {}", kPackingState);
  text +=
      "\nthermo_style    custom step f_cell[1] f_cell[2] f_cell[4] f_cell[5] f_cell[8] f_cell[9]\n"
      "thermo          1000000\n"
      "variable        loading equal f_cell\n"
      "variable        done equal f_cell[10]\n";
  if (replay.start) text += fmt::format("fix_modify      cell state {}\n", kState);
  for (std::size_t k = 0; k < replay.increments.size(); ++k)
    text += increment_commands(replay.increments[k], k + 1);
  return text;
}

std::string readme(const CellDefinition& definition, const Replay& replay) {
  std::string text = fmt::format(
      "Replay of a cell of the material '{}' (script {}).\n\n{}\n\n"
      "Run it in this folder:\n\n    {}\n\n"
      "| file | what |\n|---|---|\n"
      "| {} | the packing, a LIGGGHTS data file |\n"
      "| {} | the input script of the material |\n"
      "| in.replay | drives the cell along the increments |\n",
      definition.name, definition.script_file, replay.reason, command_of(definition), kPacking, kScript);
  if (definition.packing.state)
    text += fmt::format("| {} | velocities and contact histories of the packing |\n", kPackingState);
  if (replay.start)
    text +=
        fmt::format("| {} | the cell before the first increment: box, grains, contact histories |\n", kState);
  const bool space = definition.packing.dimension == 3;
  text +=
      space
          ? "\nAfter each increment it prints a line `cell: increment ...` with the stresses in Pa (s11 s12 s13 s21 "
            "s22 s23 s31 s32 s33)\nand couple stresses in N/m (m11 to m33 the same): tension positive, first "
            "index the normal of the face.\n"
          : "\nAfter each increment it prints a line `cell: increment ...` with the stresses in Pa (s11 s22 s33 "
            "s12 s21)\nand couple stresses in N/m (m1 m2): tension positive, first index the normal of the "
            "face.\n";
  if (replay.answers.empty()) return text + "\nThe cell gave no answer that could be compared.\n";
  text +=
      definition.control.loop == CellLoop::engine
          ? "The cell answered, and the replay prints the same digits:\n\n"
          : fmt::format(
                "The cell answered, stepped by the loop over {} unless run.log says otherwise. The replay runs in "
                "LIGGGHTS's own loop and agrees until\nround-off has grown, to eight digits and more over a "
                "thousand steps; with `loop: engine` in the case to all:\n\n",
                space ? "spheres" : "discs");
  for (std::size_t k = 0; k < replay.answers.size(); ++k) {
    if (space) {
      const Vector18 s = replay.answers[k].components();
      text +=
          fmt::format("    cell: increment {} stress {:.17g} couple_stress {:.17g}\n", k + 1,
                      fmt::join(s.data(), s.data() + 9, " "), fmt::join(s.data() + 9, s.data() + 18, " "));
      continue;
    }
    const Vector7 s = in_plane(replay.answers[k]).stress;
    text += fmt::format(
        "    cell: increment {} stress {:.17g} {:.17g} {:.17g} {:.17g} {:.17g} couple_stress "
        "{:.17g} {:.17g}\n",
        k + 1, s(k11), s(k22), s(k33), s(k12), s(k21), s(kCurvature1), s(kCurvature2));
  }
  return text;
}

}  // namespace

void write_replay(const std::filesystem::path& directory, const CellDefinition& definition,
                  const Replay& replay) {
  const Folder folder(directory);
  folder.write(kPacking, packing_data(definition.packing));
  folder.write(kScript, definition.script);
  if (definition.packing.state) folder.write(kPackingState, definition.packing.state->bytes());
  if (replay.start) folder.write(kState, replay.start->bytes());
  folder.write("in.replay", driver(definition, replay));
  folder.write("README.md", readme(definition, replay));
}

void write_replay(const std::filesystem::path& directory, const CellDefinition& definition,
                  const CellRequest& request, const std::string& reason) {
  write_replay(directory, definition, {request.state, {request.increment}, {}, reason});
}

}  // namespace polargrain::coupler
