// SPDX-License-Identifier: GPL-2.0-or-later
// Cost and error of an evaluation of a cell, over eight packings of 400 discs: accuracy over cost
// on an isochoric path before the peak, the bias of rate and tolerance at the peak and in softening, and the cost of an
// evaluation besides its steps. Processor time.
//
//   build/release/bench/cell_bench > cell.log      from the root of the project; the tables go to standard error
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <vector>

#include "dem/cell/cell_service.hpp"
#include "dem/pack/prepare.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain {
namespace {

constexpr int kBeforePeak = 10;     ///< increments of 1e-3
constexpr int kSoftening = 50;      ///< to 5 %
constexpr int kMorePackings = 7;    ///< beside the demonstration's
constexpr double kStudent = 2.365;  ///< 95 %, eight samples

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Settings {
  std::string name;
  CellControl control;
  double time_step = 0.0;  ///< s; 0: the program's
};

Settings settings(double inertial_number, double damping, double tolerance, const std::string& name = "") {
  Settings made;
  made.name = name;
  made.control.inertial_number = inertial_number;
  made.control.damping = damping;
  made.control.unbalanced_force_ratio = made.control.unbalanced_moment_ratio = tolerance;
  made.control.tangent = CellTangent::none;
  return made;
}

/// The usual settings when discs weighed 142 times too much, in today's units: LIGGGHTS's own loop at a tenth of the
/// stable time step.
Settings yardstick() {
  Settings made = settings(2.4e-3, 0.24, 5e-3, "yardstick");
  made.control.loop = CellLoop::engine;
  made.time_step = 3.8e-6;
  return made;
}

std::vector<CellDefinition> cells() {
  std::vector<CellDefinition> made{test::demo_cell()};
  PackingSpecification asked;
  asked.script_file = made[0].script_file;
  asked.script = made[0].script;
  asked.grains = 400;
  asked.sizes.radii = {3e-3, 7e-3};
  asked.density = 2650.0;
  asked.thickness = 0.1;
  asked.pressure = 1e5;
  for (int k = 0; k < kMorePackings; ++k) {
    asked.seed = static_cast<std::uint64_t>(101 + k);
    made.push_back(made[0]);
    made.back().packing = dem::prepare_packing(asked, {}).packing;
  }
  return made;
}

struct Run {
  std::vector<Vector7> stresses;
  double milliseconds = 0.0;  ///< an evaluation
  double dem_steps = 0.0;     ///< an evaluation
};

Run isochoric(CellDefinition definition, const Settings& asked, int increments) {
  definition.control = asked.control;
  if (asked.time_step > 0.0) definition.script += fmt::format("\ntimestep {:.17g}\n", asked.time_step);
  const dem::PlaneCell cell(dem::make_cell_service(definition));
  Run run;
  coupler::PlaneRequest request;
  request.increment.displacement_gradient << 1e-3, 0.0, 0.0, -1e-3;
  for (int k = 0; k < increments; ++k) {
    const double start = processor_seconds();
    const coupler::PlaneReply reply = cell.evaluate(request);
    run.milliseconds += 1e3 * (processor_seconds() - start) / increments;
    if (reply.response.quality != Quality::good)
      fmt::print(stderr, "inertial number {:.1e}, damping {}, tolerance {:.0e}, increment {}: {}\n",
                 asked.control.inertial_number, asked.control.damping, asked.control.unbalanced_force_ratio,
                 k, reply.response.message);
    run.stresses.push_back(reply.response.stress);
    run.dem_steps += static_cast<double>(reply.diagnostics.dem_steps) / increments;
    request.state = reply.state;
  }
  return run;
}

/// Largest relative difference of a normal stress over the first increments, per cent.
double error(const Run& run, const Run& reference, int increments) {
  double worst = 0.0;
  for (int k = 0; k < increments; ++k)
    for (const int component : {k11, k22})
      worst = std::max(worst, std::abs(run.stresses[k](component) / reference.stresses[k](component) - 1.0));
  return 100.0 * worst;
}

/// Mean over the packings and half the width of its 95 % interval.
struct Mean {
  double value = 0.0;
  double half_width = 0.0;

  explicit Mean(const std::vector<double>& samples) {
    const auto count = static_cast<double>(samples.size());
    for (const double sample : samples) value += sample / count;
    double square = 0.0;
    for (const double sample : samples) square += std::pow(sample - value, 2) / (count - 1.0);
    half_width = kStudent * std::sqrt(square / count);
  }
  [[nodiscard]] std::string text() const { return fmt::format("{:.2f} +- {:.2f}", value, half_width); }
};

std::string row(const Settings& asked, const std::vector<CellDefinition>& definitions,
                const std::vector<Run>& references) {
  std::vector<double> early;
  std::vector<double> late;
  double steps = 0.0;
  double milliseconds = 0.0;
  double with_tangent = 0.0;
  const auto count = static_cast<double>(definitions.size());
  for (std::size_t d = 0; d < definitions.size(); ++d) {
    const Run run = isochoric(definitions[d], asked, kBeforePeak);
    early.push_back(error(run, references[d], 3));
    late.push_back(error(run, references[d], kBeforePeak));
    steps += run.dem_steps / count;
    milliseconds += run.milliseconds / count;
    Settings tangent = asked;
    tangent.control.tangent = CellTangent::condensed;
    with_tangent += isochoric(definitions[d], tangent, kBeforePeak).milliseconds / count;
  }
  return fmt::format("{:>10} {:>9.1e} {:>8.2f} {:>10.0e} {:>7.0f} {:>8.2f} {:>8.2f} {:>16} {:>16}\n",
                     asked.name, asked.control.inertial_number, asked.control.damping,
                     asked.control.unbalanced_force_ratio, steps, milliseconds, with_tangent,
                     Mean(early).text(), Mean(late).text());
}

std::string sweep(const std::vector<CellDefinition>& definitions) {
  std::vector<Run> references;
  for (const CellDefinition& definition : definitions)
    references.push_back(isochoric(definition, settings(1e-4, 0.1, 1e-4), kBeforePeak));
  std::string table =
      fmt::format("{:>10} {:>9} {:>8} {:>10} {:>7} {:>8} {:>8} {:>16} {:>16}\n", "", "inertial", "damping",
                  "tolerance", "steps", "ms", "+tangent", "error, 3 (%)", "error, 10 (%)");
  table += row(settings(2e-4, 0.1, 2e-4, "reference"), definitions, references);
  table += row(yardstick(), definitions, references);
  table += row(settings(6e-4, 0.12, 5e-3, "default"), definitions, references);
  for (const double inertial : {2.4e-3, 1.2e-3, 8e-4, 6e-4, 4e-4, 2e-4})
    for (const double damping : {0.06, 0.12, 0.24})
      for (const double tolerance : {2e-2, 5e-3, 1e-3})
        table += row(settings(inertial, damping, tolerance), definitions, references);
  return table;
}

/// Stress ratio s22 / s11 of a run, increment by increment.
double ratio(const Run& run, int increment) {
  const Vector7& s = run.stresses[static_cast<std::size_t>(increment)];
  return s(k22) / s(k11);
}

struct Shape {
  double peak = 0.0;
  double softened = 0.0;  ///< mean of the last fifth

  explicit Shape(const Run& run) {
    const auto count = static_cast<int>(run.stresses.size());
    for (int k = 0; k < count; ++k) peak = std::max(peak, ratio(run, k));
    const int last = count / 5;
    for (int k = count - last; k < count; ++k) softened += ratio(run, k) / last;
  }
};

/// Where contacts slide all the time two runs part whatever their settings. The mean over packings counts,
/// against the slowest runs.
std::string softening(const std::vector<CellDefinition>& definitions) {
  std::vector<Shape> references;
  for (const CellDefinition& definition : definitions)
    references.emplace_back(isochoric(definition, settings(1.5e-4, 0.12, 1e-3), kSoftening));
  std::string table = fmt::format("{:>9} {:>8} {:>10} {:>18} {:>22}\n", "inertial", "damping", "tolerance",
                                  "peak (% off)", "4 to 5 % (% off)");
  for (const Settings& asked :
       {settings(3e-4, 0.12, 1e-3), settings(3e-4, 0.12, 5e-3), settings(6e-4, 0.12, 1e-3),
        settings(6e-4, 0.12, 5e-3), settings(6e-4, 0.12, 2e-2), settings(1.2e-3, 0.12, 5e-3),
        settings(1.2e-3, 0.12, 2e-2), settings(2.4e-3, 0.24, 5e-3)}) {
    std::vector<double> peaks;
    std::vector<double> softened;
    for (std::size_t d = 0; d < definitions.size(); ++d) {
      const Shape shape(isochoric(definitions[d], asked, kSoftening));
      peaks.push_back(100.0 * (shape.peak / references[d].peak - 1.0));
      softened.push_back(100.0 * (shape.softened / references[d].softened - 1.0));
    }
    table += fmt::format("{:>9.1e} {:>8.2f} {:>10.0e} {:>18} {:>22}\n", asked.control.inertial_number,
                         asked.control.damping, asked.control.unbalanced_force_ratio, Mean(peaks).text(),
                         Mean(softened).text());
  }
  return table;
}

/// Evaluations of a single step: they restore, set up, read out and save.
std::string besides(const CellDefinition& definition) {
  Settings one = settings(1e3, 0.12, 1e6);
  one.control.least_steps = 1;
  CellDefinition asked = definition;
  asked.control = one.control;
  const dem::PlaneCell cell(dem::make_cell_service(asked));
  coupler::PlaneRequest request;
  request.increment.displacement_gradient << 1e-6, 0.0, 0.0, -1e-6;
  double least = 1e300;
  for (int k = 0; k < 1000; ++k) {
    const double start = processor_seconds();
    cell.evaluate(request);
    least = std::min(least, 1e3 * (processor_seconds() - start));
  }
  return fmt::format("restore, set-up, one step, read-out and save: {:.3f} ms\n", least);
}

}  // namespace
}  // namespace polargrain

int main() {
  using namespace polargrain;
  dem::start_engine_process();
  const std::vector<CellDefinition> definitions = cells();
  const std::string tables =
      sweep(definitions) + "\n" + softening(definitions) + "\n" + besides(definitions.front());
  // The engine talks on standard output; the tables go where they can be told apart.
  std::fputs(tables.c_str(), stderr);
}
