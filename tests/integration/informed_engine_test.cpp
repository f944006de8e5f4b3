// SPDX-License-Identifier: GPL-2.0-or-later
// Both schemes against the cell itself: biaxial compression of one element, grains run by LIGGGHTS (E.8).
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <iostream>
#include <numbers>

#include "coupler/cells/cell_limits.hpp"
#include "coupler/cells/cell_material.hpp"
#include "coupler/cells/informed_material.hpp"
#include "coupler/cells/network_moduli.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"
#include "tests/integration/command.hpp"

namespace polargrain::testing {
namespace {

const std::filesystem::path kSource = POLARGRAIN_SOURCE_DIRECTORY;
constexpr double kConfining = 100e3;  // Pa
constexpr double kEnd = 0.022;        // axial strain: beyond the peak of this packing

/// The highest stress ratio of a run and its mean about there. A peak is the largest of numbers that scatter by 2 to
/// 3 % with the path of the grains to it; the mean scatters less.
struct Peak {
  double ratio = 0.0;
  double strain = 0.0;
  double sum = 0.0;
  int seen = 0;
  void see(double new_ratio, double new_strain) {
    if (new_strain > 0.5 * kEnd) {
      sum += new_ratio;
      ++seen;
    }
    if (new_ratio <= ratio) return;
    ratio = new_ratio;
    strain = new_strain;
  }
  [[nodiscard]] double mean() const { return sum / seen; }
};

class InformedEngineTest : public ::testing::Test {
 protected:
  InformedEngineTest() : scratch_("InformedEngine"), pool_(options()) { use("cases/biaxial/packing400.csv"); }

  void use(const std::string& packing) {
    sand_ = pool_.define({"sand", "hooke_radii.in", content(kSource / "liggghts_inputs/cells/hooke_radii.in"),
                          read_packing(kSource / packing), CellControl{}});
  }

  [[nodiscard]] coupler::PoolOptions options() const {
    coupler::PoolOptions options;
    options.workers = 2;
    options.directory = scratch_.path();
    options.worker_command = {POLARGRAIN, "worker"};
    return options;
  }

  /// The cell alone, in steps of 1e-4, its lateral strain led by its own tangent: no finite elements.
  Peak cell_alone() {
    const coupler::CellCalls<2> calls = coupler::calls_of<2>(pool_, sand_);
    coupler::PlaneReply reply = calls.initial();
    Peak peak;
    constexpr double kStep = 1e-4;
    for (int step = 1; step <= kEnd / kStep; ++step) {
      const Response<2>& before = reply.response;
      Increment<2> increment;
      increment.displacement_gradient(1, 1) = -kStep;
      increment.displacement_gradient(0, 0) =
          (-kConfining - before.stress(k11) + before.tangent(k11, k22) * kStep) / before.tangent(k11, k11);
      const coupler::PlaneRequest request{reply.state, increment};
      const std::size_t point = 0;
      reply = calls.evaluate({&request, 1}, {&point, 1}).front();
      EXPECT_EQ(reply.response.quality, Quality::good) << reply.response.message;
      EXPECT_NEAR(reply.response.stress(k11), -kConfining, 0.1 * kConfining);
      peak.see(reply.response.stress(k22) / reply.response.stress(k11), step * kStep);
    }
    return peak;
  }

  /// One element between smooth plates in steps of 0.1 %.
  static Peak element(std::shared_ptr<fem::Material<2>> material, double tolerance) {
    fem::Problem<2> problem;
    problem.mesh = fem::rectangle({{0.4, 0.4}, {1, 1}});
    problem.materials["all"] = std::move(material);
    problem.prescribed = {{"bottom", fem::Dof::u2, fem::TimeTable::constant(0.0), {}},
                          {"bottom_left", fem::Dof::u1, fem::TimeTable::constant(0.0), {}},
                          {"top", fem::Dof::u2, fem::TimeTable::ramp(-kEnd * 0.4), {}}};
    for (const char* side : {"left", "right"}) {
      problem.boundary_loads.push_back({.on = side, .pressure = fem::TimeTable::constant(kConfining)});
    }
    fem::SolverOptions options;
    options.force_tolerance = options.moment_tolerance = tolerance;
    options.noise_factor = 2.0;
    fem::Solver<2> solver(problem, options);
    EXPECT_TRUE(solver.equilibrate().converged);
    Peak peak;
    const int steps = static_cast<int>(kEnd / 1e-3 + 0.5);
    for (int step = 1; step <= steps; ++step) {
      const fem::StepReport report = solver.advance(static_cast<double>(step) / steps);
      EXPECT_TRUE(report.converged) << "step " << step << ": " << report.message;
      if (!report.converged) break;
      peak.see(-solver.reaction("top")(1) / (0.4 * kConfining), step * 1e-3);
    }
    return peak;
  }

  Scratch scratch_;
  coupler::Pool pool_;
  std::uint32_t sand_ = 0;
};

TEST_F(InformedEngineTest, PeaksOfBothSchemesAreTheCellsOwn) {
  const std::vector<std::string> packings{"cases/biaxial/packing400.csv", "cases/studies/dense400_seed1.h5",
                                          "cases/studies/dense400_seed4.h5"};
  double of_cell = 0.0;
  double of_informed = 0.0;
  for (const std::string& packing : packings) {
    use(packing);
    const Peak own = cell_alone();
    const auto direct = std::make_shared<coupler::CellMaterial<2>>(
        pool_, sand_, coupler::CosseratParameters{16e6, 14e6, 0.02});
    const Peak cell = element(direct, 5e-3);
    coupler::InformedParameters<2> parameters;
    parameters.elastic.young_modulus = 2.0 * 16e6 * 1.2;
    parameters.elastic.poisson_ratio = 0.2;
    parameters.elastic.cosserat_shear_modulus = 14e6;
    parameters.elastic.internal_length = 0.02;
    parameters.mobilisation.initial_friction = 0.09;
    parameters.mobilisation.cohesion = 100.0;
    const auto law =
        std::make_shared<coupler::InformedMaterial<2>>(coupler::calls_of<2>(pool_, sand_), parameters);
    const Peak informed = element(law, 1e-3);
    std::cout << "[figure] peak stress ratio: cell alone " << own.ratio << " at " << own.strain
              << ", model cell " << cell.ratio << " at " << cell.strain << ", model informed "
              << informed.ratio << " at " << informed.strain << '\n';
    for (const fem::Figure& figure : law->figures())
      std::cout << "[figure] " << figure.name << ' ' << figure.value << '\n';
    EXPECT_NEAR(informed.ratio / own.ratio, 1.0, 0.05) << packing;
    of_cell += cell.mean() / own.mean() / static_cast<double>(packings.size());
    of_informed += informed.mean() / own.mean() / static_cast<double>(packings.size());
  }
  std::cout << "[figure] mean about the peak, over packings: cell " << of_cell << ", informed " << of_informed
            << '\n';
  // Asked of the scheme at steps of 0.1 %.
  EXPECT_NEAR(of_informed, 1.0, 0.05);
  // An element takes its cell there by other increments; from packing to packing that makes a standard deviation of
  // 1.5 % of the mean about the peak, so 0.9 % for three.
  EXPECT_NEAR(of_cell, 1.0, 0.02);
}

/// Cells of hooke_li_chu with controlled rotations.
class ControlledInformedTest : public InformedEngineTest {
 protected:
  ControlledInformedTest() {
    CellControl control;
    control.rotations = CellRotations::controlled;
    Packing packing = read_packing(kSource / "cases/biaxial/packing400.csv");
    diameter_ = 2.0 * packing.mean_radius();
    sand_ =
        pool_.define({"sand", "hooke_li_chu.in", content(kSource / "liggghts_inputs/cells/hooke_li_chu.in"),
                      std::move(packing), control});
    std::string note;
    moduli_ = coupler::resolved({}, pool_, pool_.definition(sand_), note);
  }

  coupler::InformedParameters<2> parameters(coupler::InformedUpdate update) const {
    coupler::InformedParameters<2> made;
    made.elastic.poisson_ratio = 0.2;
    made.set_moduli(moduli_);
    made.update = update;
    made.mean_diameter = diameter_;
    made.mobilisation.initial_friction = 0.09;
    made.mobilisation.cohesion = 100.0;
    return made;
  }

  double diameter_ = 0.0;
  coupler::CosseratParameters moduli_;
};

TEST_F(ControlledInformedTest, LimitsAreThoseOfContactsThatSlideAndRoll) {
  const coupler::CellCalls<2> calls = coupler::calls_of<2>(pool_, sand_);
  const coupler::CellLimits limits = coupler::limits_of(calls, calls.initial(), diameter_);
  // C.6 with mu = tan(0.5) and mu_th = 0.2; r_c is half a radius for equal discs, and the polar part of unequal ones
  // adds up to a third (dem_limits_test).
  const double skew = 2.0 * std::tan(0.5);
  const double couple = 4.0 / std::numbers::pi * 0.2 * 0.25 * diameter_;
  std::cout << "[figure] " << limits.text() << ": skew " << limits.skew / skew << ", couple "
            << limits.couple / couple << " of the closed forms\n";
  EXPECT_NEAR(limits.skew / skew, 1.0, 0.03);
  EXPECT_GT(limits.couple / couple, 1.0);
  EXPECT_LT(limits.couple / couple, 1.4);
}

TEST_F(ControlledInformedTest, FreeGrainsGetTheSkewStressThatTheirContactsBear) {
  CellDefinition free = pool_.definition(sand_);
  free.control.rotations = CellRotations::free;
  std::string note;
  const coupler::CosseratParameters found = coupler::resolved({}, pool_, free, note);
  const double bound = 2.0 * std::tan(0.5);
  ASSERT_TRUE(found.skew_limit && found.plastic_length) << note;
  std::cout << "[figure] " << note << ": skew " << *found.skew_limit / bound << " of the closed form\n";
  EXPECT_NEAR(*found.skew_limit / bound, 1.0, 0.03);
  EXPECT_GT(*found.plastic_length, 0.5 * found.internal_length);
  EXPECT_LT(*found.plastic_length, 1.5 * found.internal_length);
}

TEST_F(ControlledInformedTest, APointThatIsShearedBentAndTurnedStaysNearItsCell) {
  constexpr int kSteps = 40;
  const auto size = [](const Vector7& stress, double length) {
    Vector7 measured = stress;
    measured(k33) = 0.0;
    measured.tail<2>() /= length;
    return measured.norm();
  };
  for (const coupler::InformedUpdate update :
       {coupler::InformedUpdate::frozen, coupler::InformedUpdate::fixed_point}) {
    coupler::InformedMaterial<2> law(coupler::calls_of<2>(pool_, sand_), parameters(update));
    coupler::CellMaterial<2> cell(pool_, sand_, std::nullopt);
    law.allocate(3);
    cell.allocate(3);
    // One that is sheared, bent and turned at once; one sheared, then bent; one sheared, then turned.
    std::array<double, 3> worst{};
    for (int step = 1; step <= kSteps; ++step) {
      std::vector<Increment<2>> increments(3);
      const bool second_half = 2 * step > kSteps;
      for (std::size_t p = 0; p < 3; ++p) {
        if (p == 0 || !second_half) increments[p].displacement_gradient << 4e-4, 2e-4, 2e-4, -4e-4;
        if (p == 0 || (p == 1 && second_half)) increments[p].curvature << 6e-4 / diameter_, -3e-4 / diameter_;
        if (p == 0 || (p == 2 && second_half)) increments[p].micro_rotation = 4e-4;
      }
      std::vector<Response<2>> informed(3), direct(3);
      law.evaluate(increments, informed);
      law.commit();
      cell.evaluate(increments, direct);
      cell.commit();
      if (10 * step <= kSteps) continue;  // friction starts from a guess
      for (std::size_t p = 0; p < 3; ++p) {
        ASSERT_EQ(informed[p].quality, Quality::good) << informed[p].message;
        worst[p] = std::max(worst[p], size(informed[p].stress - direct[p].stress, moduli_.internal_length) /
                                          size(direct[p].stress, moduli_.internal_length));
      }
    }
    std::cout << "[figure] " << (update == coupler::InformedUpdate::frozen ? "frozen" : "fixed point")
              << ": largest difference of law and cell over the stress: sheared, bent and turned " << worst[0]
              << ", sheared then bent " << worst[1] << ", sheared then turned " << worst[2] << '\n';
    // The ellipsoid between the limits is an assumption, and the network is softer while it shears than at rest.
    EXPECT_LT(worst[0], 0.3);
    EXPECT_LT(worst[1], 0.2);
    EXPECT_LT(worst[2], 0.33);
  }
}

}  // namespace
}  // namespace polargrain::testing
