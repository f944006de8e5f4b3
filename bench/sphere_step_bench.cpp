// SPDX-License-Identifier: GPL-2.0-or-later
// The cost of a step of one sphere, side by side in one run: a clean scalar loop of the same physics
// (clean_sphere_loop.hpp), the loop over spheres that cells run with each instruction set of this processor, its plain
// twin, the engine's general loop, and LAMMPS (`lmp`) where it is installed. Processor time, best of several rounds, the
// variants taking turns, because the machine is not alone.
//
//   build/release/bench/sphere_step_bench [rounds]     from the root of the project; a minute
#include <fmt/format.h>
#include <time.h>

#include <cstdlib>
#include <fstream>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

#include "bench/clean_sphere_loop.hpp"
#include "bench/stock_programs.hpp"
#include "common/packing.hpp"
#include "common/processor.hpp"
#include "dem/sphere_loop/sphere_box.hpp"
#ifdef POLARGRAIN_WITH_ENGINE
#include "dem/cell/cell_service.hpp"
#endif

namespace polargrain {
namespace {

constexpr int kSteps = 300;
constexpr double kTimeStep = 3e-6;  // s
constexpr double kRate = 1.0;       // 1/s
constexpr double kStrain = kRate * kTimeStep * kSteps;
const bench::CleanMaterial kMaterial{6e8, 0.8, 0.5463024898437905, 1.0, 0.1, 3000.0, kTimeStep};

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

struct Variant {
  std::string what;
  std::function<double()> seconds_a_step;
  double best = 1e300;
};

double timed(const std::function<void()>& steps) {
  const double start = processor_seconds();
  steps();
  return (processor_seconds() - start) / kSteps;
}

Eigen::Vector3d rates() {
  return {kRate, -0.5 * kRate, -0.5 * kRate};
}

template <bool Rolling>
Variant clean(const Packing& packing) {
  using Loop = bench::CleanSphereLoop<Rolling>;
  std::vector<typename Loop::Sphere> spheres;
  for (const Grain& grain : packing.grains) {
    typename Loop::Sphere s{};
    const double place[3] = {grain.position.x(), grain.position.y(), grain.height};
    for (int axis = 0; axis < 3; ++axis) {
      s.x[axis] = place[axis];
      s.v[axis] = rates()(axis) * place[axis];
    }
    s.radius = grain.radius;
    s.inverse_mass = 1.0 / grain.mass;
    s.inverse_inertia = 2.5 / (grain.mass * grain.radius * grain.radius);
    spheres.push_back(s);
  }
  Loop start(spheres, packing.base_vectors(), kMaterial, 0.05 * packing.mean_radius());
  start.run(rates(), kSteps);
  return {"clean scalar loop", [start] {
            Loop loop = start;
            return timed([&loop] { loop.run(rates(), kSteps); });
          }};
}

dem::Spheres spheres_of(const Packing& packing, bool rolling) {
  dem::Spheres spheres;
  dem::LawCombination& laws = spheres.combination;
  laws.tangential = rolling ? dem::TangentialLaw::li_chu : dem::TangentialLaw::history;
  laws.rolling = rolling ? dem::RollingLaw::li_chu : dem::RollingLaw::off;
  laws.settings.torsion = rolling;
  dem::PairParameters pair;
  pair.normal = 2.0 * kMaterial.modulus;
  pair.tangential = kMaterial.tangential;
  pair.friction = kMaterial.friction;
  pair.rolling_stiffness = kMaterial.rolling_stiffness;
  pair.rolling_friction = kMaterial.rolling_friction;
  laws.pairs.push_back(pair);
  for (const Grain& grain : packing.grains) {
    spheres.radii.push_back(grain.radius);
    spheres.masses.push_back(grain.mass);
    spheres.inertias.push_back(dem::sphere_inertia(grain.mass, grain.radius));
    spheres.types.push_back(0);
  }
  return spheres;
}

dem::Snapshot<3> at_rest(const Packing& packing, const dem::Spheres& spheres) {
  dem::Snapshot<3> snapshot;
  snapshot.box = dem::Box<3>::from_base_vectors(packing.base_vectors());
  snapshot.code = spheres.combination.code();
  snapshot.springs = dem::sphere_spring_count(spheres.combination);
  for (const Grain& grain : packing.grains)
    snapshot.grains.push_back({{grain.position.x(), grain.position.y(), grain.height}, {}, {}, {}});
  return snapshot;
}

void lead(dem::SphereBox& box) {
  const Eigen::Matrix3d strain = kStrain * (rates() / kRate).asDiagonal();
  box.begin(dem::BoxPath<3>(box.box(), strain, kSteps), kMaterial.damping_rate, std::nullopt, kTimeStep);
  box.set_up();
}

Variant ours(std::string what, const Packing& packing, bool rolling, const dem::SphereKernels& kernels) {
  const dem::Spheres spheres = spheres_of(packing, rolling);
  auto box = std::make_shared<dem::SphereBox>(spheres, kernels);
  box->restore(at_rest(packing, spheres));
  lead(*box);
  box->run(kSteps);
  const StatePointer start = box->save();
  return {std::move(what), [box, start] {
            box->restore(*start);
            lead(*box);
            return timed([&box] { box->run(kSteps); });
          }};
}

#ifdef POLARGRAIN_WITH_ENGINE
Variant engine(const Packing& packing, bool rolling) {
  CellDefinition definition;
  definition.script_file = "liggghts_inputs/cells/spheres_hooke_radii.in";
  std::ostringstream text;
  text << std::ifstream(definition.script_file).rdbuf();
  definition.script = text.str();
  definition.packing = packing;
  definition.packing.pressure = 0.0;
  const std::string stock = "pair_style      gran model hooke/radii tangential history";
  if (rolling)
    definition.script.replace(
        definition.script.find(stock), stock.size(),
        "fix fr all property/global coefficientRollingFriction peratomtypepair 1 0.1\n"
        "fix kr all property/global rollingStiffnessRatio peratomtypepair 1 1.0\n"
        "pair_style gran model hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on");
  definition.script += fmt::format("\ntimestep {:.17g}\n", kTimeStep);
  definition.control.loop = CellLoop::engine;
  definition.control.tangent = CellTangent::none;
  definition.control.least_steps = kSteps;
  definition.control.inertial_number = 1.0;
  definition.control.unbalanced_force_ratio = definition.control.unbalanced_moment_ratio = 1e9;
  const std::shared_ptr<dem::CellOfGrains> cell = dem::make_cell_service(definition);
  return {"LIGGGHTS's general loop", [cell] {
            CellRequest request;
            request.increment.displacement_gradient = kStrain * (rates() / kRate).asDiagonal();
            return timed([&] { cell->evaluate(request); });
          }};
}
#endif

/// LAMMPS with its nearest models, as stiff as the linear law at the overlaps of this packing.
Variant lammps(const bench::StockPacking& packing, bool rolling) {
  const std::string models = std::string("hooke 3e6 0 tangential linear_history 2.4e6 0 0.5463") +
                             (rolling ? " rolling sds 2.4e6 0 0.1 twisting sds 15 0 0.1" : "") +
                             " damping velocity";
  return {"lammps", [&packing, models] {
            constexpr int kStockSteps = 3000;
            return packing.seconds_a_step(
                true, models, {kStrain / (kStockSteps * kTimeStep), kTimeStep, 12.0}, kStockSteps);
          }};
}

void compare(const std::string& laws, const Packing& packing, bool rolling, int rounds) {
  std::vector<Variant> variants;
  variants.push_back(rolling ? clean<true>(packing) : clean<false>(packing));
  variants.push_back(
      ours("plain twin", packing, rolling, dem::sphere_kernels(dem::InstructionSet::baseline, true)));
  for (const auto set :
       {dem::InstructionSet::baseline, dem::InstructionSet::avx2, dem::InstructionSet::avx512})
    if (dem::is_supported(set))
      variants.push_back(ours(std::string(dem::name_of(set)), packing, rolling, dem::sphere_kernels(set)));
#ifdef POLARGRAIN_WITH_ENGINE
  variants.push_back(engine(packing, rolling));
#endif
  const bench::StockPacking for_lammps(packing, true);
  if (bench::is_installed("lmp")) variants.push_back(lammps(for_lammps, rolling));
  for (int round = 0; round < rounds; ++round)
    for (Variant& variant : variants) {
      const double time = variant.seconds_a_step();
      variant.best = time < 0.0 ? time : std::min(variant.best, time);
    }
  fmt::print("\n{}\n{:<28} {:>12} {:>12}\n", laws, "", "ns a sphere", "over clean");
  const auto spheres = static_cast<double>(packing.grains.size());
  for (const Variant& variant : variants)
    if (variant.best < 0.0)
      fmt::print("{:<28} did not run\n", variant.what);
    else
      fmt::print("{:<28} {:>12.1f} {:>12.2f}\n", variant.what, 1e9 * variant.best / spheres,
                 variant.best / variants.front().best);
}

int main_of_bench(int rounds) {
#ifdef POLARGRAIN_WITH_ENGINE
  setenv("OMPI_MCA_ess_singleton_isolated", "1", 1);
  setenv("OMPI_MCA_btl", "self", 1);
  dem::start_engine_process();
#endif
  const Packing packing = read_packing("cases/spheres/packing1000.csv");
  fmt::print("{}\n{} spheres, {} steps\n", processor_model(), packing.grains.size(), kSteps);
  compare("hooke/radii, history", packing, false, rounds);
  compare("hooke/radii, li_chu with bending and torsion", packing, true, rounds);
  return 0;
}

}  // namespace
}  // namespace polargrain

int main(int count, char** words) {
  return polargrain::main_of_bench(count > 1 ? std::atoi(words[1]) : 10);
}
