// SPDX-License-Identifier: GPL-2.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>
#include <set>

#include "app/commands/command.hpp"
#include "app/grains/cell_paths.hpp"
#include "app/grains/grain_files.hpp"
#include "app/grains/show_grains.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"

namespace polargrain::app {
namespace {

namespace fs = std::filesystem;

struct GrainsOptions {
  fs::path directory;
  std::vector<std::size_t> points;
  std::vector<int> steps;
  bool last = false;
  fs::path output;
  bool quiet = false;
  ScriptRules scripts;
};

/// @throws InputError when a step asked for is not there
std::set<int> chosen_steps(const GrainsOptions& options, const CellPaths& paths) {
  const std::vector<int> kept = paths.steps();
  if (kept.empty())
    throw InputError({options.directory.string(), 0, "the run has not come to the end of a step yet"});
  if (options.last) return {kept.back()};
  if (options.steps.empty()) return {kept.begin(), kept.end()};
  for (const int step : options.steps)
    if (!std::ranges::binary_search(kept, step))
      throw InputError(
          {options.directory.string(), 0,
           fmt::format(
               "--step {}: the run has the steps {} to {}{}", step, kept.front(), kept.back(),
               kept.back() - kept.front() + 1 == static_cast<int>(kept.size()) ? "" : ", not all of them")});
  return {options.steps.begin(), options.steps.end()};
}

void check_points(const GrainsOptions& options, const CellPaths& paths) {
  for (const std::size_t point : options.points) {
    if (point >= paths.points())
      throw InputError({options.directory.string(), 0,
                        fmt::format("--point {}: the points of this run are 0 to {}, in the order of "
                                    "points-NNNNN.vtu",
                                    point, paths.points() - 1)});
    if (paths.cell(point) == nullptr)
      throw InputError(
          {options.directory.string(), 0, fmt::format("--point {}: its material has no grains", point)});
  }
}

int grains(const GrainsOptions& options, const WorkerEngine& engine) {
  const CellPaths paths(options.directory);
  check_points(options, paths);
  const std::set<int> steps = chosen_steps(options, paths);
  const fs::path output = options.output.empty() ? options.directory / kGrainsFolder : options.output;
  if (!options.output.empty() &&
      fs::weakly_canonical(output) != fs::weakly_canonical(options.directory / kGrainsFolder))
    check_beside_run("-o", output, options.directory);
  fs::create_directories(output);
  for (const std::size_t point : options.points)
    fs::create_directories((output / grains_file(point, 0)).parent_path());
  const fs::path log = output / "engine.log";
  show_grains({paths, options.points, steps, options.scripts, engine, log, !options.quiet},
              [&](std::size_t point, int step, const GrainView& view) {
                write_grains(output / grains_file(point, step), view);
              });
  fs::remove(log);
  for (const std::size_t point : options.points) {
    write_grains_collection(output, point, options.directory / "history.csv");
    if (!options.quiet) tell(stdout, "{}\n", (output / grains_collection(point)).string());
  }
  return 0;
}

}  // namespace

Command add_grains(CLI::App& program, const Grains& of_program) {
  const auto options = std::make_shared<GrainsOptions>();
  CLI::App& command =
      *program.add_subcommand("grains", "The grains and force chains of a point of a run, for ParaView");
  command.add_option("DIR", options->directory, "Result directory of run, which may be at work")->required();
  command
      .add_option("--point", options->points,
                  "Number of an integration point, in the order of points-NNNNN.vtu; may be repeated")
      ->required()
      ->allow_extra_args(false)
      ->type_name("N");
  CLI::Option* const step = command.add_option("--step", options->steps, "A step; may be repeated [all]")
                                ->allow_extra_args(false)
                                ->type_name("K");
  command.add_flag("--last", options->last, "The last step")->excludes(step);
  command.add_option("-o,--output", options->output, "Folder to write [DIR/grains]")->type_name("FOLDER");
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_trust(command, options->scripts, of_program);
  return {&command, [options, &engine = of_program.engine] { return grains(*options, engine); }};
}

}  // namespace polargrain::app
