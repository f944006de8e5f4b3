// SPDX-License-Identifier: GPL-2.0-or-later
#include "app/commands/pack.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <cstdio>
#include <fstream>
#include <functional>
#include <memory>

#include "app/commands/command.hpp"
#include "app/commands/in_child.hpp"
#include "app/pack/drawn_sizes.hpp"
#include "app/pack/read_specification.hpp"
#include "app/remarks/packing_at_rest.hpp"
#include "common/error.hpp"
#include "common/packing_file.hpp"
#include "common/plain_text.hpp"
#include "common/seconds.hpp"
#include "common/standard_streams.hpp"
#include "common/stepping_note.hpp"
#include "coupler/pool/log_excerpt.hpp"
#include "fem/output/write_file.hpp"
#include "grains_io/packing_data.hpp"

namespace polargrain::app {
namespace {

/// Whether there is a file of this name that is no packing.
bool is_another_than_a_packing(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file) || std::filesystem::file_size(file) == 0) return false;
  try {
    read_packing_file(file);
    return false;
  } catch (const InputError&) {
    return true;
  }
}

/// @throws InputError unless a packing can be written there, and is not made from a file of this name
void check_packing_output(const PackOptions& options) {
  if (options.output.extension() != ".h5")
    throw InputError(
        {"", 0, fmt::format("-o {}: the name of a packing must end in .h5", options.output.string())});
  check_output("-o", options.output,
               options.settle.empty() ? files_read_with(coupler::DocumentKind::packing,
                                                        options.specification_file, options.settings)
                                      : options.settle);
  if (is_another_than_a_packing(options.output))
    throw InputError(
        {"", 0,
         fmt::format("-o {}: this file is there and is no packing; name another file to write, or "
                     "remove this one",
                     plain_text(options.output.string()))});
}

/// Whether there is a file of this name that is no earlier export of a packing.
bool is_another_file(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return false;
  std::ifstream former(file);
  std::string line;
  std::getline(former, line);
  return !line.starts_with(kPackingDataHead);
}

/// @throws InputError where the export would replace another file
void check_export(const PackOptions& options) {
  std::error_code error;  // of a file that does not exist: it is not the other one
  if (is_another_file(options.export_file) &&
      !std::filesystem::equivalent(options.export_file, options.specification_file, error))
    throw InputError(
        {"", 0,
         fmt::format(
             "--export {0}: this file is there and is no exported packing; name another file to write. The "
             "packing comes first: polargrain pack {1} --export FILE.data",
             plain_text(options.export_file.string()), plain_text(options.specification_file.string()))});
  check_output("--export", options.export_file, {options.specification_file});
}

/// Makes the packing in a process of its own. @returns whether that ended well
bool make_in_child(const PackingWork& make, const std::filesystem::path& output, const PackingTools& tools,
                   bool quiet, const std::filesystem::path& log) {
  const auto work = [&](ProgressLine& line) {
    tools.start_process();
    const auto progress = [&line](const PackingReached& reached) {
      line.say(fmt::format("step {:.0f}: void ratio {:.4f}, pressure {:.4g} kPa, unbalanced {:.1e}",
                           reached.dem_steps, reached.void_ratio, 1e-3 * reached.pressure,
                           reached.unbalanced_force_ratio));
    };
    const PreparedPacking made = make(progress);
    tell(stdout, "{}\n", made.stepping);
    write_packing_file(output, made);
  };
  return run_in_child(log, work, !quiet);
}

/// The line of a log that says which loop has stepped the grains; empty where no such line is there.
std::string stepping_of(const std::filesystem::path& log) {
  std::ifstream stream(log);
  std::string found;
  for (std::string line; std::getline(stream, line);)
    if (line.starts_with(kSteppingNote)) found = without_control_characters(line);
  return found;
}

/// The largest and the smallest eigenvalue of the fabric, each with its direction.
std::string fabric_text(const PackingReached& reached, int dimension) {
  const Eigen::MatrixXd fabric = tensor(reached.fabric).topLeftCorner(dimension, dimension);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(fabric);
  const auto one = [&](int k) {
    Eigen::VectorXd direction = solver.eigenvectors().col(k);
    Eigen::Index largest = 0;
    direction.cwiseAbs().maxCoeff(&largest);
    if (direction(largest) < 0.0) direction = -direction;
    std::string text =
        fmt::format("{:.4f} along ({:.2f}, {:.2f}", solver.eigenvalues()(k), direction(0), direction(1));
    return text + (dimension == 3 ? fmt::format(", {:.2f})", direction(2)) : ")");
  };
  return fmt::format("{}, {}", one(dimension - 1), one(0));
}

/// @param stepping which loop has stepped the grains (kSteppingNote), or nothing
void report(const PreparedPacking& packing, const std::string& stepping, double seconds,
            const std::filesystem::path& file) {
  const PackingReached& reached = packing.reached;
  const double width = packing.packing.box.col(0).norm();  // the bedding may be turned
  tell(stdout,
       "{}: {} grains in {:.6g} m x {:.6g} m{}\n"
       "  void ratio             {:.4f}\n"
       "  coordination number    {:.3f}   (without a contact: {:.1f} % of the grains)\n"
       "  pressure               {:.6g} kPa, anisotropy {:.1e}, shear {:.1e} of it\n"
       "  unbalanced ratio       {:.1e} (forces), {:.1e} (moments)\n"
       "  fabric                 {}\n"
       "  friction while made    {:.4g}{}\n"
       "  DEM steps              {:.0f}\n"
       "  seconds                {:.2f}\n"
       "{}",
       file.string(), packing.packing.grains.size(), width, packing.packing.box.determinant() / width,
       packing.packing.dimension == 3 ? fmt::format(" x {:.6g} m", packing.packing.thickness) : "",
       reached.void_ratio, reached.coordination_number, 100.0 * reached.rattlers, 1e-3 * reached.pressure,
       reached.anisotropy, reached.shear, reached.unbalanced_force_ratio, reached.unbalanced_moment_ratio,
       fabric_text(reached, packing.packing.dimension), reached.friction,
       packing.packing.state ? " (tangential forces are kept)" : "", reached.dem_steps, seconds,
       stepping.empty() ? "" : fmt::format("  {}\n", stepping));
}

/// A packing with what its file records; of a CSV file that is the pressure at most.
PreparedPacking packing_to_settle(const std::filesystem::path& file) {
  if (file.extension() == ".h5") return read_packing_file(file);
  PreparedPacking prepared;
  prepared.packing = read_packing(file);
  prepared.reached.pressure = prepared.packing.pressure;
  return prepared;
}

/// The specification for --settle: the script and the pressure of the packing, or the one set.
PackingSpecification settling(const PackOptions& options) {
  const PreparedPacking packing = packing_to_settle(options.settle.front());
  const double pressure = packing.reached.pressure;
  return read_settling(options.settle.front(), options.settle.back(), packing.packing.dimension, pressure,
                       packing.specification, options.settings, options.scripts);
}

}  // namespace

std::string make_packing_file(const PackingWork& make, const std::filesystem::path& output,
                              const PackingTools& tools, bool quiet) {
  std::filesystem::path log = output;
  log += ".log";
  if (!make_in_child(make, output, tools, quiet, log))
    throw RunError(fmt::format("the packing could not be made (the engine's output is in {}):\n{}",
                               log.string(), coupler::log_excerpt(log)));
  const std::string stepping = stepping_of(log);
  std::filesystem::remove(log);
  return stepping;
}

int pack(const PackOptions& options, const PackingTools& tools) {
  if (!options.export_file.empty()) {
    check_export(options);
    fem::write_file(options.export_file, packing_data(read_packing(options.specification_file)));
    return 0;
  }
  if (options.specification_file.empty() && options.settle.empty())
    throw InputError({"", 0, "pack: name a specification (YAML), or --settle PACKING SCRIPT"});
  const bool settles = options.settle.size() == 2;
  const PackingSpecification specification =
      settles ? settling(options)
              : read_packing_specification(options.specification_file, options.settings, options.scripts);
  check_packing_output(options);
  const PackingWork make = [&](const std::function<void(const PackingReached&)>& progress) {
    if (!settles) return tools.make(specification, progress);
    return tools.settle(specification, packing_to_settle(options.settle.front()), progress);
  };
  const auto start = Clock::now();
  const std::string stepping = make_packing_file(make, options.output, tools, options.quiet);
  const double seconds = seconds_since(start);
  if (options.quiet) return 0;
  const PreparedPacking made = read_packing_file(options.output);
  report(made, stepping, seconds, options.output);
  const std::string sizes = settles ? "" : remark_on_drawn_sizes(specification, made.packing);
  if (!sizes.empty()) tell(stderr, "warning: {}: {}\n", options.output.string(), sizes);
  if (options.moduli)
    tell(stdout, "  {}\n",
         options.moduli({options.output.stem().string(), specification.script_file, specification.script,
                         made.packing, CellControl{}, specification.contact_library}));
  return 0;
}

Command add_pack(CLI::App& program, const Grains& grains) {
  const auto options = std::make_shared<PackOptions>();
  CLI::App& command = *program.add_subcommand("pack", "Make a packing of grains, or export one");
  CLI::Option* specification =
      command.add_option("SPEC", options->specification_file, "Specification (YAML), or a packing to export");
  specification->transform(brought_along);
  CLI::Option* output =
      command.add_option("-o,--output", options->output, "Packing to write (HDF5)")->type_name("FILE.h5");
  CLI::Option* exported = command
                              .add_option("--export", options->export_file,
                                          "Write the packing SPEC as a LIGGGHTS data file instead")
                              ->type_name("FILE.data");
  command
      .add_option(
          "--settle", options->settle,
          "Bring a packing to rest under an input script, under its own pressure or --set pressure=...")
      ->type_name("PACKING SCRIPT")
      ->expected(2)
      ->excludes(specification)
      ->excludes(exported);
  output->excludes(exported);
  command.add_flag("--quiet", options->quiet, "Print nothing but errors");
  add_settings(command, options->settings);
  add_trust(command, options->scripts, grains);
  return {&command, [options, &tools = grains.packing_tools] {
            options->moduli = [trusted = options->scripts.trusted](const CellDefinition& cell) {
              return "moduli of the packing at rest: " + packing_at_rest(cell, trusted).moduli.text();
            };
            return pack(*options, tools);
          }};
}

}  // namespace polargrain::app
