// SPDX-License-Identifier: GPL-2.0-or-later
// `suffix fast` in scripts of all kinds of contacts: the same grains, stepped with LIGGGHTS's own loop and with the kernels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <compute.h>

#include "dem/cell/packing_data.hpp"
#include "dem/contact/force_pass.hpp"
#include "dem/engine/engine.hpp"
#include "dem/engine/engine_part.hpp"
#include "dem/engine/liggghts.hpp"
#include "dem/lanes/instruction_set.hpp"
#include "dem/sphere_loop/engine_pass.hpp"
#include "tests/integration/command.hpp"
#include "tests/support/sphere_models.hpp"

namespace polargrain::dem {
namespace {

using test::kCombinationsOfSphereLoop;
using test::ModelsOfSphereLoop;
using Velocities = std::vector<std::array<double, 6>>;

constexpr double kFastest = 0.5;  // m/s, of the waves below

/// Everything up to the first run: a packing whose layers slide over each other in waves, so that lists are made anew.
std::string scene(const std::string& style, int dimension, const std::string& further = "") {
  std::string script = "units si\ndimension " + std::to_string(dimension) +
                       "\natom_style granular\natom_modify map array\nboundary p p p\nnewton off\n"
                       "communicate single vel yes\nread_data ${packing}\nneighbor 0.00005 bin\n"
                       "neigh_modify delay 0\n" +
                       test::model_commands(style, test::kValuesOfSpheres) + "fix integrate all nve/sphere\n";
  if (dimension == 2) script += "fix plane all enforce2d\n";
  return script + further + "variable wave atom " + std::to_string(kFastest) +
         "*sin(40*y)\nvelocity all set v_wave NULL NULL\nthermo 1000\n";
}

class Scene {
 public:
  Scene(const Packing& packing, const std::string& script, bool fast)
      : data_(packing), grains_(packing.grains.size()) {
    offer_fast_pass(engine_.lammps());
    data_.define_variables(engine_);
    if (fast) engine_.command("suffix fast");
    engine_.script(script, "scene");
  }

  void run(const std::string& script) { engine_.script(script, "scene"); }
  [[nodiscard]] bool is_fast() { return part_of<ForcePasses>(engine_.lammps()).in_use != nullptr; }
  [[nodiscard]] std::string told() { return part_of<ForcePasses>(engine_.lammps()).told; }
  [[nodiscard]] long builds() { return static_cast<long>(engine_.lammps().neighbor->ncalls); }

  /// The values that the engine's table gives for each contact, by the tags of its grains.
  std::map<std::pair<int, int>, std::vector<double>> springs() {
    LAMMPS_NS::Modify& modify = *engine_.lammps().modify;
    LAMMPS_NS::Compute& table = *modify.compute[modify.find_compute("contacts")];
    table.compute_local();
    std::map<std::pair<int, int>, std::vector<double>> found;
    for (int row = 0; row < table.size_local_rows; ++row) {
      const double* const values = table.array_local[row];
      found[{static_cast<int>(values[0]), static_cast<int>(values[1])}].assign(
          values + 3, values + table.size_local_cols);
    }
    return found;
  }

  /// Velocities and, times a radius, spins: m/s, in the order of the tags; zero of grains that have left the box.
  Velocities velocities() {
    LAMMPS_NS::Atom& atom = *engine_.lammps().atom;
    Velocities made(grains_);
    for (int k = 0; k < atom.nlocal; ++k) {
      std::array<double, 6>& to = made[static_cast<std::size_t>(atom.tag[k] - 1)];
      for (int axis = 0; axis < 3; ++axis) {
        to[axis] = atom.v[k][axis];
        to[3 + axis] = atom.omega[k][axis] * atom.radius[k];
      }
    }
    return made;
  }

 private:
  Engine engine_;
  PackingDataFile data_;
  std::size_t grains_;
};

double largest_difference(const Velocities& a, const Velocities& b) {
  double largest = a.size() == b.size() ? 0.0 : 1e300;
  for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k)
    for (std::size_t axis = 0; axis < a[k].size(); ++axis)
      largest = std::max(largest, std::abs(a[k][axis] - b[k][axis]));
  return largest / kFastest;
}

const Packing& packing_of(int dimension) {
  static const Packing discs = read_packing("cases/biaxial/packing400.csv");
  static const Packing spheres = read_packing("cases/spheres/packing1000.csv");
  return dimension == 2 ? discs : spheres;
}

class EnginePass : public ::testing::TestWithParam<ModelsOfSphereLoop> {};

TEST_P(EnginePass, AgreesWithTheEngineOverTwoRuns) {
  for (const int dimension : {2, 3}) {
    const std::string script = scene(GetParam().style, dimension);
    Scene fast(packing_of(dimension), script, true);
    // Models of the engine keep the springs of a contact that opens and closes while a list lasts: a list a step.
    Scene engine(packing_of(dimension), script + "neigh_modify every 1 check no\n", false);
    for (Scene* const scene : {&fast, &engine}) scene->run("run 150 post no\nrun 100 post no\n");
    ASSERT_TRUE(fast.is_fast()) << fast.told();
    EXPECT_FALSE(engine.is_fast());
    EXPECT_GT(fast.builds(), 1);
    const double difference = largest_difference(fast.velocities(), engine.velocities());
    std::printf("[figure] %s, dimension %d: %.1e of the fastest grain, %ld lists\n", GetParam().name.c_str(),
                dimension, difference, fast.builds());
    // Two orders of summation; contacts that slide and close pass round-off on. Springs that are lost change 1e-3 and more.
    EXPECT_LT(difference, 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(Combinations, EnginePass, ::testing::ValuesIn(kCombinationsOfSphereLoop),
                         [](const auto& tested) { return tested.param.name; });

const char* const kFull =
    "hooke/radii tangential li_chu rolling_friction li_chu torsionTorque on rollingDamping on "
    "rollingFrictionForce on rollingFrictionForceDamping on damping on";

TEST(EnginePasses, FreezeGrainsAndMeetWallsAsTheEngineDoes) {
  // Grains of two types, the lowest of them frozen, under a wall of the engine's own; the contacts of the wall and the mass of
  // frozen grains in dashpots are other code.
  for (const int dimension : {2, 3}) {
    const std::string up = dimension == 2 ? "y" : "z";
    std::string script = scene(
        kFull, dimension,
        "region low block INF INF " + std::string(dimension == 2 ? "INF 0.02 INF INF" : "INF INF INF 0.02") +
            " units box\ngroup low region low\nfix hold low freeze\n"
            "fix wall all wall/gran model hooke/radii tangential li_chu rolling_friction li_chu primitive type 1 " +
            up +
            "plane 0.0 allow_special_domain_periodic yes torsionTorque on rollingDamping on rollingFrictionForce on "
            "rollingFrictionForceDamping on damping on\n");
    script.replace(script.find("boundary p p p"), 14, dimension == 2 ? "boundary p f p" : "boundary p p f");
    Scene fast(packing_of(dimension), script, true);
    Scene engine(packing_of(dimension), script, false);
    for (Scene* const scene : {&fast, &engine}) scene->run("run 300 post no\n");
    ASSERT_TRUE(fast.is_fast());
    EXPECT_LT(largest_difference(fast.velocities(), engine.velocities()), 1e-8);
  }
}

// Springs are lent to the kernels: whoever reads or keeps them must find them.
TEST(EnginePasses, HandSpringsToTablesOfContactsAndToRestarts) {
  const testing::Scratch scratch("engine_pass");
  const std::string file = (scratch.path() / "half.restart").string();
  const std::string table =
      "compute contacts all pair/gran/local id history\ncompute most all reduce max c_contacts[4]\n"
      "thermo_style custom step c_most\nthermo 70\n";
  const std::string script = scene(kFull, 3) + table;
  Scene fast(packing_of(3), script, true);
  Scene engine(packing_of(3), script + "neigh_modify every 1 check no\n", false);
  for (Scene* const scene : {&fast, &engine})
    scene->run("run 100\nwrite_restart " + file + (scene == &fast ? "" : ".engine") + "\nrun 100\n");
  ASSERT_TRUE(fast.is_fast());
  EXPECT_LT(largest_difference(fast.velocities(), engine.velocities()), 1e-8);
  const auto springs = fast.springs();
  const auto expected = engine.springs();
  ASSERT_GT(expected.size(), 1000U);
  ASSERT_EQ(springs.size(), expected.size());
  for (const auto& [pair, values] : expected) {
    ASSERT_TRUE(springs.contains(pair));
    for (std::size_t k = 0; k < values.size(); ++k)
      // Springs are of 1e-5 m and 1e-4 rad.
      EXPECT_NEAR(springs.at(pair)[k], values[k], 1e-11);
  }
  // LIGGGHTS goes on from the file of the kernels as from its own.
  std::string again = script.substr(0, script.find("variable wave"));
  again.replace(again.find("read_data ${packing}"), 20, "read_restart " + file);
  Scene from_fast(packing_of(3), again, false);
  again.replace(again.find(file), file.size(), file + ".engine");
  Scene from_engine(packing_of(3), again, false);
  for (Scene* const scene : {&from_fast, &from_engine}) scene->run("run 50 post no\n");
  EXPECT_LT(largest_difference(from_fast.velocities(), from_engine.velocities()), 1e-8);
}

/// 64 equal spheres in rows, each of which touches six.
Packing rows_of_spheres() {
  constexpr int kRows = 4;
  Packing packing = packing_of(3);
  packing.box = kRows * 0.00999 * Eigen::Matrix2d::Identity();
  packing.thickness = kRows * 0.00999;
  packing.lean.setZero();
  packing.state.reset();
  packing.grains.resize(kRows * kRows * kRows);
  int k = 0;
  for (Grain& grain : packing.grains) {
    grain.position = {0.00999 * (k % kRows), 0.00999 * (k / kRows % kRows)};
    grain.height = 0.00999 * (k / kRows / kRows);
    grain.radius = 0.005;
    grain.mass = 1.4e-3;
    ++k;
  }
  return packing;
}

// Grains may grow while a list of neighbours lasts.
TEST(EnginePasses, SeeGrainsThatGrow) {
  const std::string script = scene(
      "hooke/radii tangential li_chu", 3,
      "neighbor 0.002 bin\nvariable size equal 0.01*(1.0+1e-5*step)\nfix grow all adapt 1 atom diameter v_size\n");
  const Packing packing = rows_of_spheres();
  Scene fast(packing, script, true);
  Scene engine(packing, script, false);
  for (Scene* const scene : {&fast, &engine}) scene->run("run 50 post no\n");
  ASSERT_TRUE(fast.is_fast());
  EXPECT_EQ(fast.builds(), 0);  // behind that of the set-up
  EXPECT_LT(largest_difference(fast.velocities(), engine.velocities()), 1e-7);
}

TEST(EnginePasses, SayWhyTheyAreNotTaken) {
  Scene unknown(packing_of(2), scene("hooke/radii tangential no_history", 2) + "run 1\n", true);
  EXPECT_FALSE(unknown.is_fast());
  EXPECT_EQ(
      unknown.told(),
      "contacts in LIGGGHTS's own loop, which is slower: there are no kernels for contact models that it "
      "has not compiled");
  Scene known(packing_of(2), scene("hooke/radii tangential history", 2) + "run 1\n", true);
  // "on" names no style.
  Scene on(packing_of(2), "suffix on\n" + scene("hooke/radii tangential history", 2) + "run 1\n", false);
  EXPECT_FALSE(on.is_fast());
  EXPECT_EQ(known.told(), "contacts by kernels for " + std::string(name_of(best_instruction_set())) +
                              " (hooke/radii, history, off)");
}

}  // namespace
}  // namespace polargrain::dem
