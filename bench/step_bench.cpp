// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a step of one disc, side by side in one run: a bare loop of the same physics (bare_loop.hpp),
// the loop over discs that cells run, its plain twin, the engine's general loop, and the stock programs
// `liggghts` and `lmp` where they are installed. Processor time, best of several rounds, the variants taking
// turns, because the machine is not alone.
//
//   build/release/bench/step_bench [rounds [words of a name]]     from the root of the project; about two
//   minutes
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/bare_loop.hpp"
#include "bench/stock_programs.hpp"
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

void add_programs(std::vector<Variant>& variants, const bench::StockPacking& for_liggghts,
                  const bench::StockPacking& for_lammps) {
  struct Row {
    std::string what, liggghts, lammps;
  };
  const Row rows[] = {
      {"hooke/stiffness history", "hooke/stiffness tangential history absolute_damping on",
       "hooke 3e6 0 tangential linear_history 2.4e6 0 0.5463 damping velocity"},
      {"hooke/stiffness history, rolling epsd2 (lammps: sds)",
       "hooke/stiffness tangential history rolling_friction epsd2 absolute_damping on",
       "hooke 3e6 0 tangential linear_history 2.4e6 0 0.5463 rolling sds 2.4e6 0 0.2 damping velocity"}};
  const bench::StockStrain strain{kStrain / (kProgramSteps * kTimeStep), kTimeStep, 30.0};
  const bool have_liggghts = bench::is_installed("liggghts");
  const bool have_lammps = bench::is_installed("lmp");
  const auto add = [&variants, &strain](const std::string& what, const bench::StockPacking& packing,
                                        bool lammps, const std::string& models) {
    variants.push_back({what, [&packing, lammps, models, strain] {
                          return packing.seconds_a_step(lammps, models, strain, kProgramSteps);
                        }});
  };
  for (const Row& row : rows) {
    if (have_liggghts) add("liggghts: " + row.what, for_liggghts, false, row.liggghts);
    if (have_lammps) add("lammps: " + row.what, for_lammps, true, row.lammps);
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
  const bench::StockPacking for_liggghts(packing, false), for_lammps(packing, true);
  add_programs(variants, for_liggghts, for_lammps);
  std::erase_if(variants, [&words](const Variant& variant) {
    return !variant.what.starts_with("bare") && variant.what.find(words) == std::string::npos;
  });
  for (int round = 0; round < rounds; ++round)
    for (Variant& variant : variants) {
      const double time = variant.seconds_a_step();
      variant.best = time < 0.0 ? time : std::min(variant.best, time);
    }
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
