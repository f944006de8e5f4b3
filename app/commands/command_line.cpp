// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <thread>

#include "app/bench/bench.hpp"
#include "app/commands/band.hpp"
#include "app/commands/moduli.hpp"
#include "app/commands/pack.hpp"
#include "app/commands/point.hpp"
#include "app/commands/verify.hpp"
#include "app/commands/worker.hpp"
#include "app/run/interrupt.hpp"
#include "app/run/run.hpp"
#include "common/error.hpp"
#include "common/standard_streams.hpp"
#include "coupler/case/case.hpp"
#include "coupler/case/data_files.hpp"
#include "coupler/pool/keys.hpp"

namespace polargrain::app {
namespace {

constexpr int kRunFailed = 1;
constexpr int kInputWrong = 2;
constexpr int kStopped = 3;

constexpr const char* kIntroduction = R"(polargrain - granular materials on two scales
A Cosserat finite element model whose material, where you want it, is a box of grains run by LIGGGHTS.)";

constexpr const char* kExamples = R"(
Try:
  polargrain check cases/biaxial/case.yaml          all faults of a case at once, and what its packings resist with
  polargrain run cases/biaxial/case.yaml -w 2       run it with two workers
  polargrain run cases/biaxial/case.yaml --resume   go on with a run that was stopped or killed
  polargrain run case.yaml --set steps.count=10     change a value for one run
  polargrain verify results/biaxial                 hold a result against its proof, some cells evaluated again
  polargrain point case.yaml sand path.csv          one point of the material 'sand' along a path
  polargrain pack cases/packings/dense400.yaml -o dense400.h5   make a packing of grains
  polargrain pack --settle dense400.h5 soft.in -o soft400.h5    bring one to rest under another script
  polargrain bench --quick                          speed against error of the demo, some minutes

A run writes history.csv (a row a step), fields.pvd (open it in ParaView), costs.csv, summary.json and run.log.
Exit status: 0 done, 1 the run failed, 2 the input is wrong (nothing was run or written), 3 stopped by a signal
(go on with --resume).
The case file is described in docs/user_guide.md.
)";

int default_workers() {
  return static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
}

int keys(const std::string& directory, const std::string& worker) {
  coupler::make_keys(directory, worker);
  tell(stdout,
       "{0}/{1}.key is new: copy it to where workers run, and to nowhere else.\n"
       "  here:  polargrain run CASE.yaml --listen tcp://*:5570 --keys {0}\n"
       "  there: polargrain worker --connect tcp://HOST:5570 --key {1}.key\n",
       directory, worker);
  return 0;
}

int check(const std::string& file, const std::vector<std::string>& settings, const ScriptRules& scripts) {
  const coupler::Case the_case = coupler::read_case(file, settings, scripts);
  tell(stdout, "{}: no faults; {} elements, {} nodes, {} steps, {}\n", file,
       the_case.problem.mesh.elements.size(), the_case.problem.mesh.nodes.size(), the_case.steps(),
       the_case.needs_workers() ? "needs workers" : "needs no workers");
  if (the_case.check_share > 0.0 && the_case.needs_workers())
    tell(stdout, "{:.3g} % of the evaluations are made by two workers; with one worker none can be\n",
         100.0 * the_case.check_share);
  std::vector<const CellDefinition*> cells;
  for (const auto& [name, material] : the_case.materials)
    if (material->needs_workers()) cells.push_back(material->grains());
  const std::vector<std::string> lines = moduli_of(cells, scripts.trusted);
  for (std::size_t k = 0; k < lines.size(); ++k)
    tell(stdout, "material '{}': {}\n", cells[k]->name, lines[k]);
  return 0;
}

/// A case or specification as named, or, where there is none, the one of that name that the program brings along
/// (cases/): what --help tells to try works in any folder.
std::string brought_along(const std::string& name) {
  if (std::filesystem::exists(name)) return name;
  const auto file = coupler::find_data_file(name, {});
  return file ? file->string() : name;
}

/// What bench does when no case is named: the demo with its packings; quickly, on a coarser mesh.
void take_demo(BenchOptions& options) {
  options.cases.emplace_back(brought_along("cases/biaxial/case.yaml"));
  if (options.quick) options.settings.insert(options.settings.begin(), "mesh.rectangle.elements=[2, 4]");
  if (!options.pack.empty()) return;
  options.pack = brought_along("cases/packings/dense400.yaml");
  options.grains =
      options.quick ? std::vector<int>{100, 400, 800} : std::vector<int>{100, 200, 400, 800, 1600};
}

int guarded(const std::function<int()>& command) {
  try {
    return command();
  } catch (const InputError& error) {
    tell(stderr, "{}\n", error.what());
    return kInputWrong;
  } catch (const Interrupted& error) {
    tell(stderr, "{}\n", error.what());
    return kStopped;
  } catch (const std::exception& error) {
    tell(stderr, "error: {}\n", error.what());
    return kRunFailed;
  }
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command
      .add_option("--set", settings,
                  "Change a value of the case, for example steps.count=10; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

/// @param rules of the command, which get what the engine understands too
void add_trust(CLI::App& command, ScriptRules& rules, const WorkerEngine& engine) {
  rules.more_commands = engine.script_commands;
  command.add_flag(
      "--trust-scripts", rules.trusted,
      "Run scripts of cells that can do more than set up a cell (start programs, read and write files), and "
      "libraries of contact laws");
}

}  // namespace

int command_line(int count, char** arguments, const WorkerEngine& engine, const PackingTools& packing_tools) {
  make_signals_of_writes_errors();
  CLI::App app(kIntroduction, "polargrain");
  app.set_version_flag("--version", "polargrain " POLARGRAIN_VERSION);
  app.footer(kExamples);
  app.require_subcommand(1);

  RunOptions run_options;
  run_options.workers = default_workers();
  run_options.state_fault = engine.state_fault;
  CLI::App* run_command = app.add_subcommand("run", "Run a case");
  run_command->add_option("CASE", run_options.case_file, "Case file (YAML)")
      ->required()
      ->transform(brought_along);
  run_command->add_option("-o,--output", run_options.directory, "Result directory [results/NAME]")
      ->type_name("DIR");
  run_command->add_option("-w,--workers", run_options.workers, "Worker processes [one a core]")
      ->type_name("N")
      ->check(CLI::Range(0, 4096));
  CLI::Option* listen = run_command
                            ->add_option("--listen", run_options.listen,
                                         "Where workers of other machines may join, for example tcp://*:5570")
                            ->type_name("URL");
  listen->needs(
      run_command->add_option("--keys", run_options.keys, "Directory of 'polargrain keys', to listen")
          ->type_name("DIR"));
  run_command->add_flag("--resume", run_options.resume, "Go on from the checkpoint in DIR");
  run_command
      ->add_option("--checkpoint-minutes", run_options.checkpoint_minutes,
                   "Least time between two checkpoints; 0: one a step [of the case: 10]")
      ->type_name("MINUTES")
      ->check(CLI::NonNegativeNumber);
  run_command->add_flag("--quiet", run_options.quiet, "Print nothing but errors");
  add_settings(*run_command, run_options.settings);
  add_trust(*run_command, run_options.scripts, engine);

  std::string check_file;
  std::vector<std::string> check_settings;
  CLI::App* check_command = app.add_subcommand("check", "Report all faults of a case; take no step");
  check_command->add_option("CASE", check_file, "Case file (YAML)")->required()->transform(brought_along);
  add_settings(*check_command, check_settings);
  ScriptRules check_scripts;
  add_trust(*check_command, check_scripts, engine);

  PointOptions point_options;
  CLI::App* point_command = app.add_subcommand("point", "Take one point of a material along a path");
  point_command->add_option("CASE", point_options.case_file, "Case file (YAML)")
      ->required()
      ->transform(brought_along);
  point_command->add_option("MATERIAL", point_options.material, "Name of a material of the case")->required();
  point_command
      ->add_option("PATH", point_options.path_file, "CSV: an increment a row, h11,h12,h21,h22,w,k1,k2")
      ->required();
  point_command->add_option("-o,--output", point_options.output, "CSV to write [standard output]")
      ->type_name("FILE");
  point_command
      ->add_option("--replay", point_options.replay,
                   "Also write the path as a folder for polargrain-liggghts (materials of model cell)")
      ->type_name("DIR");
  add_settings(*point_command, point_options.settings);
  add_trust(*point_command, point_options.scripts, engine);

  PackOptions pack_options;
  CLI::App* pack_command = app.add_subcommand("pack", "Make a packing of grains, or export one");
  CLI::Option* pack_specification = pack_command->add_option("SPEC", pack_options.specification_file,
                                                             "What to make (YAML), or a packing to export");
  pack_specification->transform(brought_along);
  CLI::Option* pack_output =
      pack_command->add_option("-o,--output", pack_options.output, "Packing to write (HDF5)")
          ->type_name("FILE.h5");
  CLI::Option* pack_export = pack_command
                                 ->add_option("--export", pack_options.export_file,
                                              "Write the packing SPEC as a LIGGGHTS data file instead")
                                 ->type_name("FILE.data");
  pack_command
      ->add_option(
          "--settle", pack_options.settle,
          "Bring a packing to rest under an input script, under its own pressure or --set pressure=...")
      ->type_name("PACKING SCRIPT")
      ->expected(2)
      ->excludes(pack_specification)
      ->excludes(pack_export);
  pack_output->excludes(pack_export);
  pack_command->add_flag("--quiet", pack_options.quiet, "Print nothing but errors");
  add_settings(*pack_command, pack_options.settings);
  add_trust(*pack_command, pack_options.scripts, engine);

  BandCommandOptions band_options;
  CLI::App* band_command =
      app.add_subcommand("band", "Measure the shear band of a result: inclination, thickness, onset");
  band_command->add_option("DIR", band_options.directory, "Results of run, or of a specimen made of grains")
      ->required();
  band_command->add_option("--from", band_options.from,
                           "Axial strain where the increment begins [2/3 of the last]");
  band_command->add_option("--to", band_options.to, "Axial strain where it ends [the last]");
  band_command
      ->add_option("--window", band_options.window, "Axial strain of the increments for the onset [0.005]")
      ->check(CLI::PositiveNumber);
  band_command
      ->add_option("--contrast", band_options.contrast, "Least shear of a band over the background [2]")
      ->check(CLI::Range(1.0, 1e9));
  band_command
      ->add_option("--strain", band_options.strain_column, "Column of history.csv with the axial strain")
      ->type_name("COLUMN")
      ->capture_default_str();
  band_command->add_flag("--current", band_options.current,
                         "Measure where places are at --from, not at the start");
  band_command->add_option("--fields", band_options.fields, "Write the samples of the increment as CSV")
      ->type_name("FILE");

  BenchOptions bench_options;
  bench_options.workers = default_workers();
  bench_options.directory = "bench-results";
  CLI::App* bench_command =
      app.add_subcommand("bench", "Measure speed against error over a grid of settings");
  bench_command
      ->add_option(
          "CASE", bench_options.cases,
          "Case whose settings are varied; further ones are compared with it [the demo, with packings]")
      ->expected(0, -1)
      ->transform(brought_along);
  bench_command->add_flag("--quick", bench_options.quick,
                          "Fewer settings; some minutes where no case is named");
  bench_command->add_flag("--resume", bench_options.resume,
                          "Go on where a bench with the same settings was broken off");
  bench_command->add_option("-o,--output", bench_options.directory, "Result directory [bench-results]")
      ->type_name("DIR");
  bench_command->add_option("-w,--workers", bench_options.workers, "Worker processes [one a core]")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  bench_command->add_option("--x", bench_options.x, "Monitor along the curve [first of the case's table]")
      ->type_name("NAME");
  bench_command->add_option("--y", bench_options.y, "Monitor to compare; may be repeated [the others]")
      ->type_name("NAME")
      ->allow_extra_args(false);
  bench_command->add_option("--vary", bench_options.vary, "Further values of a key, tried one at a time")
      ->type_name("KEY=A,B,...")
      ->allow_extra_args(false);
  bench_command->add_option("--packing", bench_options.packings, "A further packing to try; may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  CLI::Option* bench_pack =
      bench_command
          ->add_option("--pack", bench_options.pack,
                       "Specification of packings to make and try, in all sizes and for all seeds")
          ->type_name("SPEC");
  bench_command
      ->add_option("--grains", bench_options.grains, "Sizes of these packings [of the specification]")
      ->delimiter(',')
      ->type_name("N,N,...")
      ->allow_extra_args(false)
      ->check(CLI::Range(4, 20000))
      ->needs(bench_pack);
  bench_command->add_option("--seeds", bench_options.seeds, "Their seeds, a packing each [1,2,3]")
      ->delimiter(',')
      ->type_name("K,K,...")
      ->allow_extra_args(false)
      ->check(CLI::NonNegativeNumber)
      ->needs(bench_pack);
  bench_command
      ->add_option("--band", bench_options.band,
                   "Also compare the shear bands that form between these axial strains")
      ->delimiter(',')
      ->expected(2)
      ->type_name("FROM,TO")
      ->check(CLI::NonNegativeNumber);
  bench_command->add_flag("--quiet", bench_options.quiet, "Print nothing but errors");
  add_settings(*bench_command, bench_options.settings);
  add_trust(*bench_command, bench_options.scripts, engine);

  WorkerOptions worker_options;
  CLI::App* worker_command = app.add_subcommand("worker", "Serve cells to a coordinator (started by run)");
  worker_command->add_option("--connect", worker_options.url, "The coordinator's endpoint")
      ->required()
      ->type_name("URL");
  worker_command->add_option("--key", worker_options.key, "Key file of 'polargrain keys', needed for tcp://")
      ->type_name("FILE");
  worker_command
      ->add_option("--patience", worker_options.patience_seconds,
                   "Give up after so long without a coordinator [60]")
      ->type_name("SECONDS");
  worker_command->add_option("--log", worker_options.log, "Append all output to this file")
      ->type_name("FILE");
  add_trust(*worker_command, worker_options.scripts, engine);

  std::string keys_directory;
  std::string keys_worker = "worker";
  CLI::App* keys_command = app.add_subcommand("keys", "Make keys for workers on other machines");
  keys_command->add_option("DIR", keys_directory, "Directory of the keys of a coordinator")->required();
  keys_command->add_option("--worker", keys_worker, "Name of the worker's key to add [worker]")
      ->type_name("NAME");

  VerifyOptions verify_options;
  verify_options.workers = default_workers();
  CLI::App* verify_command = app.add_subcommand(
      "verify", "Hold a result against its proof: files, case, and a sample of cells evaluated again");
  verify_command->add_option("DIR", verify_options.directory, "Results of run")->required();
  verify_command->add_option("-w,--workers", verify_options.workers, "Worker processes [one a core]")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
  add_trust(*verify_command, verify_options.scripts, engine);

  for (CLI::App* command : {verify_command, run_command, band_command, check_command, point_command,
                            pack_command, bench_command, worker_command, keys_command})
    command->footer("");

  try {
    app.parse(count, arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kInputWrong;
  }
  const int status = guarded([&] {
    if (run_command->parsed()) return run(run_options);
    if (check_command->parsed()) return check(check_file, check_settings, check_scripts);
    if (point_command->parsed()) return point(point_options);
    if (band_command->parsed()) return band(band_options);
    if (pack_command->parsed()) {
      pack_options.moduli = [&](const CellDefinition& cell) {
        const CellDefinition* const one = &cell;
        return moduli_of({&one, 1}, pack_options.scripts.trusted).front();
      };
      return pack(pack_options, packing_tools);
    }
    if (bench_command->parsed()) {
      if (bench_options.cases.empty()) take_demo(bench_options);
      return bench(bench_options, packing_tools);
    }
    if (verify_command->parsed()) return verify(verify_options);
    if (keys_command->parsed()) return keys(keys_directory, keys_worker);
    return work(worker_options, engine);
  });
  // What a run says is a comfort; what other commands say is what they were asked for.
  if (status != 0 || run_command->parsed() || std::ferror(stdout) == 0) return status;
  tell(stderr, "error: standard output cannot be written\n");
  return kRunFailed;
}

}  // namespace polargrain::app
