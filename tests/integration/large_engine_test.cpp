// SPDX-License-Identifier: GPL-2.0-or-later
// Large deformation is objective with grains run by LIGGGHTS too: one element strained while it is turned.
#include <gtest/gtest.h>

#include <cmath>
#include <iostream>

#include "coupler/adaptivity/adaptive_material.hpp"
#include "coupler/cells/cell_material.hpp"
#include "coupler/cells/informed_material.hpp"
#include "tests/integration/command.hpp"
#include "tests/support/turned_block.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;

class LargeEngineTest : public ::testing::Test {
 protected:
  LargeEngineTest() : scratch_("LargeEngine"), pool_(options()) {
    sand_ = pool_.define({"sand", "hooke_radii.in", content(kSource / "liggghts_inputs/cells/hooke_radii.in"),
                          read_packing(kSource / "cases/biaxial/packing400.csv"), CellControl{}});
  }

  [[nodiscard]] coupler::PoolOptions options() const {
    coupler::PoolOptions options;
    options.workers = 2;
    options.directory = scratch_.path();
    options.worker_command = {POLARGRAIN, "worker"};
    return options;
  }

  std::shared_ptr<fem::Material<2>> material(const std::string& model) {
    const coupler::CosseratParameters cosserat{15e6, 10e6, 0.01, 0.004, 1.1};
    if (model == "cell") return std::make_shared<coupler::CellMaterial<2>>(pool_, sand_, cosserat);
    if (model == "adaptive") {
      coupler::AdaptivityOptions options;
      options.tolerance = 0.02;
      return std::make_shared<coupler::AdaptiveMaterial<2>>(coupler::calls_of<2>(pool_, sand_), cosserat,
                                                            options);
    }
    coupler::InformedParameters<2> informed;
    informed.elastic.poisson_ratio = 0.25;
    informed.set_moduli(cosserat);
    informed.mobilisation.cohesion = 100.0;
    informed.mobilisation.initial_friction = 0.4;
    if (model == "informed, fixed point") informed.update = coupler::InformedUpdate::fixed_point;
    return std::make_shared<coupler::InformedMaterial<2>>(coupler::calls_of<2>(pool_, sand_), informed);
  }

  double error(const std::string& model, double degrees, int steps, bool free_rotations = false) {
    Path path;
    path.gradient << 0.004, 0.003, 0.003, -0.01;
    const auto run = [&](double angle) {
      return turned_block(material(model), {"Q8R", 1, 1e-6, free_rotations}, path, angle, steps);
    };
    const double angle = degrees * M_PI / 180.0;
    const std::vector<Response<2>> straight = run(0.0);
    const double found = error_of_turning(straight, run(angle), angle);
    std::cout << "[figure] " << model << ", " << degrees << " degrees in " << steps
              << (free_rotations ? " steps, rotations free" : " steps") << ": stress off by " << found
              << '\n';
    return found;
  }

  Scratch scratch_;
  coupler::Pool pool_;
  std::uint32_t sand_ = 0;
};

TEST_F(LargeEngineTest, EveryModelTurnedByAQuarterIn20Steps) {
  for (const char* model : {"cell", "adaptive", "informed, frozen", "informed, fixed point"})
    EXPECT_LT(error(model, 90.0, 20), 1e-4) << model;
}

// A step of 18 degrees turns a cell at once, which changes no contact.
TEST_F(LargeEngineTest, EveryModelGoesAFullTurnIn20Steps) {
  for (const bool free_rotations : {false, true}) {
    for (const char* model : {"cell", "informed, frozen", "informed, fixed point"})
      EXPECT_LT(error(model, 360.0, 20, free_rotations), 1e-6) << model;
    // Its cells are asked for several steps together, in parts of 0.4 rad: a twentieth of its tolerance.
    EXPECT_LT(error("adaptive", 360.0, 20, free_rotations), 1e-3);
  }
}

TEST_F(LargeEngineTest, EveryModelWithFreeRotationsTurnedBy4DegreesAStep) {
  for (const char* model : {"cell", "adaptive", "informed, frozen", "informed, fixed point"})
    EXPECT_LT(error(model, 90.0, 20, true), 1e-6) << model;
}

}  // namespace
}  // namespace polargrain::testing
