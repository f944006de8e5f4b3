// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a step of one disc, side by side in one run: a bare loop of the same physics (bare_loop.hpp),
// the loop over discs that cells run, its plain twin, the engine's general loop, and the stock programs
// `liggghts` and `lmp` where they are installed. Processor time, best of several rounds, the variants taking
// turns, because the machine is not alone.
//
//   build/release/bench/step_bench [rounds [words of a name]]     from the root of the project; about two
//   minutes
#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/bare_loop.hpp"
#include "dem/cell/cell_service.hpp"
#include "tests/support/cell_fixture.hpp"
#include "tests/support/plane_cells.hpp"

namespace polargrain {
namespace {

constexpr double kStrain = 1e-3;
constexpr int kSteps = 3000;
constexpr int kProgramSteps = 10000;  // more: their start is taken off
constexpr double kTimeStep = 6e-6;    // s; stable for all of them

/// The material of hooke_radii.in, with rolling resistance.
const bench::BareMaterial kMaterial{6e8, 0.8, 0.5463024898437905, 1.0, 0.2, CellControl{}.damping, kTimeStep};

struct Variant {
  std::string what;
  std::function<double()> seconds_a_step;  ///< of all discs; negative when it failed
  double best = 1e300;
};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

CellDefinition cell_of(const std::string& style, CellLoop loop) {
  CellDefinition definition = test::demo_cell();
  definition.packing.pressure = 0.0;  // another law leaves it at another stress
  std::string& script = definition.script;
  const std::string old = "pair_style      gran model hooke/radii tangential history";
  const auto place = script.find(old);
  if (place == std::string::npos) throw std::logic_error("the script of the demonstration has changed");
  std::string models;
  const auto pair = [&models](const std::string& property, double value) {
    models += fmt::format("fix {0} all property/global {0} peratomtypepair 1 {1:.17g}\n", property, value);
  };
  pair("coefficientRollingFriction", kMaterial.rolling_friction);
  pair("rollingStiffnessRatio", kMaterial.rolling_stiffness);
  pair("coefficientRollingFrictionForce", 0.1);
  pair("rollingFrictionForceStiffnessRatio", 0.2);
  pair("coefficientRestitution", 0.8);
  // As stiff as the linear law at the overlaps of this packing.
  models += "hard_particles yes\nfix youngsModulus all property/global youngsModulus peratomtype 1.5e10\n";
  models += "fix poissonsRatio all property/global poissonsRatio peratomtype 0.2\n";
  models += fmt::format("timestep {:.17g}\n", kTimeStep);
  script.replace(place, old.size(), models + "pair_style gran model " + style);
  definition.control.tangent = CellTangent::none;
  definition.control.loop = loop;
  definition.control.least_steps = kSteps;
  definition.control.inertial_number = 1.0;  // no more steps than these, and
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio =
      1e9;  // no steps at rest
  return definition;
}

coupler::PlaneRequest isochoric() {
  coupler::PlaneRequest request;
  request.increment.displacement_gradient << kStrain, 0.0, 0.0, -kStrain;
  return request;
}

Variant cell_variant(std::string what, const std::string& style, CellLoop loop) {
  return {std::move(what),
          [cell = std::make_shared<dem::PlaneCell>(dem::make_cell_service(cell_of(style, loop)))] {
            const double start = processor_seconds();
            const coupler::PlaneReply reply = cell->evaluate(isochoric());
            return (processor_seconds() - start) / static_cast<double>(reply.diagnostics.dem_steps);
          }};
}

template <bool Rolling>
Variant bare_variant(std::string what, const Packing& packing) {
  return {std::move(what), [loop = bench::BareLoop<Rolling>(packing, kMaterial)]() mutable {
            const double start = processor_seconds();
            loop.run(kStrain, kSteps);
            return (processor_seconds() - start) / kSteps;
          }};
}

/// Ends the bench when the bare loop is not the loop of the cell's physics.
template <bool Rolling>
void hold_to_cell(const Packing& packing, const std::string& style) {
  bench::BareLoop<Rolling> bare(packing, kMaterial);
  bare.run(kStrain, kSteps);
  const coupler::PlaneReply reply =
      dem::PlaneCell(dem::make_cell_service(cell_of(style, CellLoop::automatic))).evaluate(isochoric());
  Eigen::Matrix2d stress;
  stress << reply.response.stress(k11), reply.response.stress(k12), reply.response.stress(k21),
      reply.response.stress(k22);
  const double apart = (bare.stress() - stress).cwiseAbs().maxCoeff() / std::abs(0.5 * stress.trace());
  fmt::print(
      stderr,
      "bare loop against the cell, {}: {:.1e} of the pressure {:.0f} Pa after {} steps, {} and {} contacts, "
      "{:.0f} % slide, {} pairs\n",
      style, apart, -0.5 * stress.trace(), kSteps, bare.contacts(), reply.diagnostics.contacts,
      100.0 * reply.diagnostics.sliding_fraction, bare.pairs());
  if (apart < 1e-6 && bare.contacts() == reply.diagnostics.contacts && !bare.missed_contact()) return;
  fmt::print(stderr, "step_bench: the bare loop computes something else\n");
  std::exit(1);
}

bool installed(const std::string& program) {
  return std::system(fmt::format("command -v {} > /dev/null", program).c_str()) == 0;
}

/// Processor time of a program's run of bench/step.in, s; negative when it failed.
double program_seconds(const std::string& command, int steps) {
  const auto spent = [] {
    rusage usage{};
    getrusage(RUSAGE_CHILDREN, &usage);
    return static_cast<double>(usage.ru_utime.tv_sec) + 1e-6 * static_cast<double>(usage.ru_utime.tv_usec);
  };
  const double before = spent();
  const std::string whole = fmt::format(
      "{} -in bench/step.in -log none -var steps {} -var rate {:.17g} -var step {:.17g} > /dev/null 2>&1",
      command, steps, kStrain / (kProgramSteps * kTimeStep), kTimeStep);
  return std::system(whole.c_str()) == 0 ? spent() - before : -1.0;
}

/// The packing as a data file of the program, in a right box.
std::string data_file(const Packing& packing, const std::string& program) {
  const std::string name = fmt::format("/tmp/step_bench.{}.{}.data", program, getpid());
  std::ofstream file(name);
  file << fmt::format(
      "packing of step_bench\n\n{} atoms\n1 atom types\n\n0 {:.17g} xlo xhi\n0 {:.17g} ylo yhi\n",
      packing.grains.size(), packing.box(0, 0), packing.box(1, 1));
  file << fmt::format("{0:.17g} {1:.17g} zlo zhi\n\nAtoms\n\n", -0.5 * packing.thickness,
                      0.5 * packing.thickness);
  for (const Grain& grain : packing.grains) {
    // In dimension 2 liggghts takes a density for that of discs of unit thickness, lammps for that of
    // spheres.
    const double area = std::numbers::pi * grain.radius * grain.radius;
    const double volume = program == "lammps" ? 4.0 / 3.0 * area * grain.radius : area;
    file << fmt::format("{} 1 {:.17g} {:.17g} {:.17g} {:.17g} 0\n", grain.id + 1, 2.0 * grain.radius,
                        grain.mass / volume, grain.position.x(), grain.position.y());
  }
  return name;
}

Variant program_variant(std::string what, const std::string& command) {
  return {std::move(what), [command] {
            const double start_up = program_seconds(command, 0);
            const double whole = program_seconds(command, kProgramSteps);
            return start_up < 0.0 || whole < 0.0 ? -1.0 : (whole - start_up) / kProgramSteps;
          }};
}

void add_programs(std::vector<Variant>& variants, const std::string& liggghts_data,
                  const std::string& lammps_data) {
  struct Row {
    std::string what, liggghts, lammps;
  };
  const Row rows[] = {
      {"hooke/stiffness history", "hooke/stiffness tangential history absolute_damping on",
       "hooke 3e6 0 tangential linear_history 2.4e6 0 0.5463 damping velocity"},
      {"hooke/stiffness history, rolling epsd2 (lammps: sds)",
       "hooke/stiffness tangential history rolling_friction epsd2 absolute_damping on",
       "hooke 3e6 0 tangential linear_history 2.4e6 0 0.5463 rolling sds 2.4e6 0 0.2 damping velocity"}};
  const bool have_liggghts = installed("liggghts");
  const bool have_lammps = installed("lmp");
  if (!have_liggghts) fmt::print(stderr, "liggghts is not installed: left out\n");
  if (!have_lammps) fmt::print(stderr, "lammps (lmp) is not installed: left out\n");
  const std::string line = "{} -var lammps {} -var packing {} -var models \"{}\"";
  for (const Row& row : rows) {
    if (have_liggghts)
      variants.push_back(
          program_variant("liggghts: " + row.what,
                          fmt::format(fmt::runtime(line), "liggghts", 0, liggghts_data, row.liggghts)));
    if (have_lammps)
      variants.push_back(program_variant(
          "lammps: " + row.what,
          fmt::format(fmt::runtime("OMP_NUM_THREADS=1 " + line), "lmp", 1, lammps_data, row.lammps)));
  }
}

std::vector<Variant> all_variants(const Packing& packing) {
  struct Row {
    std::string what, style;
  };
  const Row rows[] = {
      {"hooke/radii history", "hooke/radii tangential history"},
      {"hooke/radii history, rolling epsd2", "hooke/radii tangential history rolling_friction epsd2"},
      {"hooke/radii history, rolling li_chu", "hooke/radii tangential history rolling_friction li_chu"},
      {"hooke/radii li_chu, rolling li_chu", "hooke/radii tangential li_chu rolling_friction li_chu"},
      {"full: the same with rolling friction force",
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on"},
      {"full, symmetric",
       "hooke/radii tangential li_chu rolling_friction li_chu rollingFrictionForce on symmetricCoupling on"},
      {"hertz history", "hertz tangential history"},
      {"hertz full", "hertz tangential li_chu rolling_friction li_chu rollingFrictionForce on"}};
  std::vector<Variant> variants;
  variants.push_back(bare_variant<true>("bare loop with rolling", packing));
  variants.push_back(bare_variant<false>("bare loop, sliding only", packing));
  for (const Row& row : rows)
    variants.push_back(cell_variant("discs: " + row.what, row.style, CellLoop::automatic));
  for (const Row& row : rows)
    variants.push_back(cell_variant("plain twin: " + row.what, row.style, CellLoop::plain));
  for (const Row& row : rows)
    variants.push_back(cell_variant("engine: " + row.what, row.style, CellLoop::engine));
  return variants;
}

int bench_steps(int rounds, const std::string& words) {
  const Packing packing = test::demo_cell().packing;
  const auto discs = static_cast<double>(packing.grains.size());
  hold_to_cell<false>(packing, "hooke/radii tangential history");
  hold_to_cell<true>(packing, "hooke/radii tangential history rolling_friction li_chu");
  std::vector<Variant> variants = all_variants(packing);
  const std::string liggghts_data = data_file(packing, "liggghts");
  const std::string lammps_data = data_file(packing, "lammps");
  add_programs(variants, liggghts_data, lammps_data);
  std::erase_if(variants, [&words](const Variant& variant) {
    return !variant.what.starts_with("bare") && variant.what.find(words) == std::string::npos;
  });
  for (int round = 0; round < rounds; ++round)
    for (Variant& variant : variants) {
      const double time = variant.seconds_a_step();
      variant.best = time < 0.0 ? time : std::min(variant.best, time);
    }
  std::remove(liggghts_data.c_str());
  std::remove(lammps_data.c_str());
  // The engine talks on standard output; the table goes where it can be told apart.
  fmt::print(stderr, "\n{:66} {:>13} {:>10} {:>10}\n", "", "ns/grain-step", "over bare", "sliding");
  for (const Variant& variant : variants) {
    if (variant.best < 0.0) {
      fmt::print(stderr, "{:66} did not run; start step_bench from the root of the project\n", variant.what);
      continue;
    }
    fmt::print(stderr, "{:66} {:13.1f} {:10.2f} {:10.2f}\n", variant.what, 1e9 * variant.best / discs,
               variant.best / variants[0].best, variant.best / variants[1].best);
  }
  return 0;
}

}  // namespace
}  // namespace polargrain

int main(int count, char** words) {
  polargrain::dem::start_engine_process();
  return polargrain::bench_steps(count > 1 ? std::atoi(words[1]) : 5, count > 2 ? words[2] : "");
}
