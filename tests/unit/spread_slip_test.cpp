// SPDX-License-Identifier: GPL-2.0-or-later
// Slips that are spread: a softening column against its closed form, tangents against differences, restarts.
#include "fem/spread/spread_slip.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <memory>

#include "common/error.hpp"
#include "common/memory_archive.hpp"
#include "fem/material/local_material.hpp"
#include "fem/material/rotation.hpp"
#include "fem/material/slip_driven_cone.hpp"
#include "fem/material/slip_driven_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/discretisation.hpp"
#include "fem/solver/solver.hpp"
#include "tests/support/spread_column.hpp"

namespace polargrain::testing::spread_column {
namespace {

TEST(spread_slip, column_has_the_thickness_and_the_stress_of_the_closed_form_on_each_mesh) {
  // 20 to 80 elements over 20 d; slip lies on one or two nodes, so the closed form, with one, is a little thinner.
  for (const int elements : {20, 40, 80}) {
    Solver<2> solver(softening_column(elements), {});
    ASSERT_TRUE(solver.equilibrate().converged);
    constexpr int kSteps = 60;
    int iterations = 0;
    for (int step = 1; step <= kSteps; ++step) {
      const double displacement = step * 0.8e-3;
      const StepReport report = solver.advance(displacement);
      ASSERT_TRUE(report.converged) << step << " " << report.message;
      iterations += report.iterations;
      // The step across the onset, where the whole column is about to slip, is cut. Behind it the set of slipping nodes is found.
      if (step > 5) {
        EXPECT_LE(report.iterations, 8) << step;
      }
      if (step % 20 != 0) continue;
      const ClosedForm exact = ClosedForm::at(displacement);
      const double stress = solver.reaction("top")(0) / (kHeight / elements);
      EXPECT_NEAR(stress, exact.stress(), 0.002 * kPeak) << elements;
      EXPECT_NEAR(width_of(solver), exact.width(), 0.08 * exact.width()) << elements;
    }
    EXPECT_LE(iterations, 8 * kSteps);
  }
}

TEST(spread_slip, column_of_a_law_known_by_its_answers_is_that_of_the_law) {
  // The law yields by its own strain, which has (T - s)/G more slip: up to 0.3 % of what softens it.
  for (const int elements : {20, 40}) {
    Solver<2> solver(softening_column(elements, kWidth, 0.5 * kHeight, answers_of), {});
    ASSERT_TRUE(solver.equilibrate().converged);
    for (int step = 1; step <= 60; ++step) {
      const double displacement = step * 0.8e-3;
      const StepReport report = solver.advance(displacement);
      ASSERT_TRUE(report.converged) << step << " " << report.message;
      if (step % 20 != 0) continue;
      const ClosedForm exact = ClosedForm::at(displacement);
      EXPECT_NEAR(solver.reaction("top")(0) / (kHeight / elements), exact.stress(), 0.003 * kPeak)
          << elements;
      EXPECT_NEAR(width_of(solver), exact.width(), 0.08 * exact.width()) << elements;
    }
  }
}

// A length far below the spread leaves the couple stress nothing to carry; skew stress is elastic.
TEST(spread_slip, column_with_micro_rotations_of_a_short_length_is_the_classical_one) {
  Solver<2> solver(softening_column(40, kWidth, 0.5 * kHeight, cone_of_short_length, Continuum::cosserat),
                   {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 60; ++step) ASSERT_TRUE(solver.advance(step * 0.8e-3).converged);
  const ClosedForm exact = ClosedForm::at(60 * 0.8e-3);
  EXPECT_NEAR(solver.reaction("top")(0) / (kHeight / 40), exact.stress(), 0.002 * kPeak);
  EXPECT_NEAR(width_of(solver), exact.width(), 0.08 * exact.width());
}

TEST(spread_slip, column_of_a_wider_spread_is_as_much_thicker) {
  Solver<2> solver(softening_column(40, 2.0 * kWidth), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 60; ++step) ASSERT_TRUE(solver.advance(step * 0.8e-3).converged);
  ClosedForm exact;
  exact.length *= 2.0;
  EXPECT_NEAR(width_of(solver), exact.width(), 0.08 * exact.width());
}

TEST(spread_slip, ends_can_hold_the_slip) {
  Problem<2> problem = softening_column(80);
  for (const char* field : kSpreadFields)
    for (const char* end : {"bottom", "top"})
      problem.prescribed_fields.push_back({field, end, TimeTable::constant(0.0)});
  Solver<2> solver(std::move(problem), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 60; ++step) ASSERT_TRUE(solver.advance(step * 0.8e-3).converged);
  const ClosedForm exact = ClosedForm::at(60 * 0.8e-3, true);
  EXPECT_NEAR(solver.reaction("top")(0) / (kHeight / 80), exact.stress(), 0.002 * kPeak);
  EXPECT_NEAR(width_of(solver), exact.width(), 0.08 * exact.width());
  EXPECT_EQ(slips_of(solver).begin()->second, 0.0);
}

TEST(spread_slip, end_is_a_mirror) {
  Solver<2> solver(softening_column(80, kWidth, 0.0), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 60; ++step) ASSERT_TRUE(solver.advance(step * 0.4e-3).converged);
  const std::map<double, double> slips = slips_of(solver);
  ClosedForm twice;
  twice.half_height = kHeight;
  const double exact = 0.5 * twice.width();
  auto above = slips.begin();
  while (above->second > 0.5 * slips.begin()->second) ++above;
  EXPECT_NEAR(above->first, exact, 0.08 * exact + kHeight / 80);
}

/// Friction, dilatancy and cohesion that change with the slip.
template <int dim>
ElastoplasticParameters<dim> sand(double begin, double end) {
  ElastoplasticParameters<dim> parameters;
  parameters.elastic.young_modulus = 20e6;
  parameters.elastic.poisson_ratio = 0.3;
  parameters.elastic.cosserat_shear_modulus = 5e6;
  parameters.elastic.internal_length = 0.01;
  for (int i = 0; i < dim; ++i) parameters.elastic.initial_stress(Cosserat<dim>::stress_place(i, i)) = -1e5;
  if constexpr (dim == 2) parameters.elastic.initial_stress(k33) = -1e5;
  parameters.cone = {PiecewiseLinear::ramp(begin, end, 0.3), PiecewiseLinear::ramp(0.4, 0.1, 0.3),
                     PiecewiseLinear::ramp(2e3, 1e3, 0.3)};
  return parameters;
}

/// An increment with a strain; in the plane eps_33 is passed over.
template <int dim>
Increment<dim> increment_of(const typename Cosserat<dim>::Vector& strain) {
  Increment<dim> increment;
  if constexpr (dim == 2) {
    increment.displacement_gradient << strain(k11), strain(k21), strain(k12), strain(k22);
    increment.curvature = strain.template tail<2>();
  } else {
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) {
        increment.displacement_gradient(j, i) = strain(Cosserat<3>::stress_place(i, j));
        increment.curvature(j, i) = strain(Cosserat<3>::couple_place(i, j));
      }
  }
  return increment;
}

template <int dim>
void check_law_against_differences() {
  using Vector = typename Cosserat<dim>::Vector;
  SlipDrivenCone<dim> law(sand<dim>(1.2, 0.6));
  law.allocate(1);
  const auto at = [&](const Vector& strain, double slip) {
    Increment<dim> increment = increment_of<dim>(strain);
    Response<dim> response;
    law.set_slips(std::span(&slip, 1));
    law.evaluate(std::span(&increment, 1), std::span(&response, 1));
    EXPECT_EQ(response.quality, Quality::good) << response.message;
    return std::pair(response, law.slip_answers()[0]);
  };
  std::srand(7);
  for (int sample = 0; sample < 20; ++sample) {
    const Vector strain = 5e-3 * Vector::Random();
    const double slip = 2e-4;
    const auto [response, answer] = at(strain, slip);
    const double step = 1e-6;
    Vector way = Vector::Random();
    if constexpr (dim == 2) way(k33) = 0.0;
    const auto [ahead, answer_ahead] = at(strain + step * way, slip);
    const auto [behind, answer_behind] = at(strain - step * way, slip);
    EXPECT_LT((response.tangent * way - (ahead.stress - behind.stress) / (2.0 * step)).norm(),
              1e-5 * (response.tangent * way).norm());
    EXPECT_NEAR(answer.drive_by_strain.dot(way), (answer_ahead.drive - answer_behind.drive) / (2.0 * step),
                1e-5 * answer.drive_by_strain.norm());
    const auto [more, answer_more] = at(strain, slip + step);
    const auto [less, answer_less] = at(strain, slip - step);
    EXPECT_LT((answer.stress_by_slip - (more.stress - less.stress) / (2.0 * step)).norm(),
              1e-5 * answer.stress_by_slip.norm());
    EXPECT_NEAR(answer.drive_by_slip, (answer_more.drive - answer_less.drive) / (2.0 * step),
                1e-5 * std::abs(answer.drive_by_slip));
  }
}

TEST(spread_slip, derivatives_of_the_law_are_those_of_differences) {
  check_law_against_differences<2>();
  check_law_against_differences<3>();
}

TEST(spread_slip, law_at_the_slip_of_the_local_law_has_its_stress) {
  const ElastoplasticParameters<2> parameters = sand<2>(0.8, 1.2);
  const ElastoplasticLaw<2> local(parameters);
  SlipDrivenCone<2> law(parameters);
  law.allocate(1);
  ElastoplasticState<2> state = local.initial_state(), trial;
  std::srand(3);
  for (int step = 0; step < 20; ++step) {
    Increment<2> increment =
        increment_of<2>(Vector7(Vector7(1e-3, -2e-3, 0.0, 1e-3, 0.0, 0.01, 0.0) + 1e-3 * Vector7::Random()));
    const Response<2> expected = local.integrate(state, increment, trial);
    const double slip = trial.gamma_p - state.gamma_p;
    state = trial;
    Response<2> found;
    law.set_slips(std::span(&slip, 1));
    law.evaluate(std::span(&increment, 1), std::span(&found, 1));
    law.commit();
    EXPECT_LT((found.stress - expected.stress).norm(), 1e-9 * expected.stress.norm());
    if (slip > 0.0) {
      EXPECT_NEAR(law.slip_answers()[0].drive, 0.0, 1e-7 * law.slip_answers()[0].scale);
    }
  }
  EXPECT_GT(state.gamma_p, 0.01);
}

TEST(spread_slip, slip_beyond_the_deviator_uses_it_up) {
  const ElastoplasticParameters<2> parameters = sand<2>(0.8, 1.2);
  SlipDrivenCone<2> law(parameters);
  law.allocate(1);
  Increment<2> nothing;
  Response<2> response;
  law.evaluate(std::span(&nothing, 1), std::span(&response, 1));
  EXPECT_LT((response.tangent - elastic_stiffness(parameters.elastic)).norm(),
            1e-9 * response.tangent.norm());
  Vector7 strain = Vector7::Zero();
  strain(k11) = 1e-3, strain(k22) = -1e-3;
  const Increment<2> increment = increment_of<2>(strain);
  const double slip = 2e-3;  // q would be 3 G 1e-3 * 2 / sqrt(3) without it
  law.set_slips(std::span(&slip, 1));
  law.evaluate(std::span(&increment, 1), std::span(&response, 1));
  EXPECT_EQ(response.quality, Quality::good);
  const double mean = response.stress.head<3>().mean();
  EXPECT_LT((response.stress.head<3>() - Eigen::Vector3d::Constant(mean)).norm(), 1e-9 * std::abs(mean));
  EXPECT_LT(law.slip_answers()[0].drive, 0.0);
}

/// A block of distorted elements between smooth plates.
Problem<2> block(std::shared_ptr<Material<2>> material) {
  Problem<2> problem;
  problem.mesh = rectangle({{0.1, 0.1}, {3, 3}});
  for (const Element<2>& element : problem.mesh.elements)
    for (const int node : element.nodes) {
      Eigen::Vector2d& place = problem.mesh.nodes[static_cast<std::size_t>(node)];
      const bool inside = place.minCoeff() > 1e-6 && place.maxCoeff() < 0.1 - 1e-6;
      if (inside && place(0) < 0.06 && place(1) < 0.06 && place(0) > 0.03 && place(1) > 0.03)
        place += Eigen::Vector2d(4e-3, -2e-3);
    }
  problem.materials["all"] = std::move(material);
  problem.prescribed = {{"bottom", Dof::u2, TimeTable::constant(0.0), {}},
                        {"bottom_left", Dof::u1, TimeTable::constant(0.0), {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.01, 1.0), {}}};
  for (const char* side : {"left", "right"})
    problem.boundary_loads.push_back({side, TimeTable::constant(1e5)});
  return problem;
}

class SpreadHardening : public ::testing::TestWithParam<Deformation> {};
INSTANTIATE_TEST_SUITE_P(Deformations, SpreadHardening,
                         ::testing::Values(Deformation::small, Deformation::large));

TEST_P(SpreadHardening, OfAUniformBlockIsThatOfTheLocalLaw) {
  const ElastoplasticParameters<2> parameters = sand<2>(0.8, 1.2);
  for (Law (*law)(const ElastoplasticParameters<2>&) : {cone, answers_of}) {
    Problem<2> spread = block(law(parameters)), alone = block(local(parameters));
    spread.deformation = alone.deformation = GetParam();
    add_spread_slip(spread, {kWidth});
    Solver<2> with(std::move(spread), {});
    Solver<2> without(std::move(alone), {});
    for (Solver<2>* solver : {&with, &without}) ASSERT_TRUE(solver->equilibrate().converged);
    for (int step = 1; step <= 20; ++step) {
      for (Solver<2>* solver : {&with, &without}) {
        const StepReport report = solver->advance(0.05 * step);
        ASSERT_TRUE(report.converged) << report.message;
        EXPECT_EQ(report.cuts, 0);
        EXPECT_LE(report.iterations, 8);
      }
      // Apart but for the overstress: 0.01 of the strength times the growth of slip in a step, 0.006.
      EXPECT_NEAR(with.reaction("top")(1) / without.reaction("top")(1), 1.0, 3e-4);
    }
    EXPECT_GT(with.state().displacement(with.problem().places().start(0)), 0.05);
  }
}

// The middle one of three steps turns the body besides; the last one is the same to the turned material.
TEST(spread_slip, laws_turn_with_the_material) {
  constexpr double kAngle = 0.7;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(kAngle).toRotationMatrix();
  const Eigen::Matrix2d stretches[] = {Eigen::Matrix2d{{6e-3, 2e-3}, {2e-3, -9e-3}},
                                       Eigen::Matrix2d{{3e-3, -4e-3}, {-4e-3, -2e-3}},
                                       Eigen::Matrix2d{{1e-3, 5e-3}, {5e-3, -1e-3}}};
  for (Law (*law)(const ElastoplasticParameters<2>&) : {cone, answers_of}) {
    Response<2> responses[2];
    SlipAnswer<2> answers[2];
    for (const bool turned : {false, true}) {
      const Law made = law(sand<2>(1.2, 0.6));
      auto& driven = dynamic_cast<SlipDriven<2>&>(*made);
      made->allocate(1);
      Increment<2> increment;
      increment.configuration = Configuration::start;
      made->evaluate(std::span(&increment, 1), std::span(&responses[turned], 1));
      made->commit();
      for (int step = 0; step < 3; ++step) {
        const bool turns = turned && step == 1;
        Eigen::Matrix2d stretch = stretches[step];
        if (turned && step == 2) stretch = (turn * stretch * turn.transpose()).eval();
        increment.displacement_gradient = stretch;
        if (turns)
          increment.displacement_gradient =
              turn * (Eigen::Matrix2d::Identity() + stretch) - Eigen::Matrix2d::Identity();
        increment.micro_rotation = turns ? kAngle : 0.0;
        const double slip = 1e-3;
        driven.set_slips(std::span(&slip, 1));
        made->evaluate(std::span(&increment, 1), std::span(&responses[turned], 1));
        answers[turned] = driven.slip_answers()[0];
        made->commit();
      }
    }
    const double stress = responses[0].stress.norm();
    EXPECT_GT(stress, 1e4);
    EXPECT_LT((responses[1].stress - rotated(responses[0].stress, kAngle)).norm(), 1e-12 * stress);
    EXPECT_LT((responses[1].tangent - rotated(responses[0].tangent, kAngle)).norm(),
              1e-10 * responses[0].tangent.norm());
    EXPECT_NEAR(answers[1].drive, answers[0].drive, 1e-12 * stress);
    EXPECT_GT(std::abs(answers[0].drive), 1e-3 * stress);
    EXPECT_LT((answers[1].drive_by_strain - rotated(answers[0].drive_by_strain, kAngle)).norm(),
              1e-10 * answers[0].drive_by_strain.norm());
    EXPECT_LT((answers[1].stress_by_slip - rotated(answers[0].stress_by_slip, kAngle)).norm(),
              1e-10 * answers[0].stress_by_slip.norm());
  }
}

template <int dim>
void check_answers_against_differences() {
  using Vector = typename Cosserat<dim>::Vector;
  const auto place = [](int i, int j) { return Cosserat<dim>::stress_place(i, j); };
  SlipDrivenMaterial<dim> law(
      std::make_shared<LocalMaterial<ElastoplasticLaw<dim>>>(ElastoplasticLaw<dim>(sand<dim>(1.2, 0.6))));
  law.allocate(1);
  const auto at = [&](const Vector& strain, double slip) {
    const Increment<dim> increment = increment_of<dim>(strain);
    Response<dim> response;
    law.set_slips(std::span(&slip, 1));
    law.evaluate(std::span(&increment, 1), std::span(&response, 1));
    return std::pair(response, law.slip_answers()[0]);
  };
  const Response<dim> rest = at(Vector::Zero(), 0.0).first;
  EXPECT_NEAR(law.slip_stiffness(), 3.0 * 20e6 / 2.6, 1e-8 * rest.tangent.norm());
  Vector strain = Vector::Zero();
  strain(place(0, 0)) = 6e-3, strain(place(1, 1)) = -9e-3, strain(place(0, 1)) = strain(place(1, 0)) = 2e-3;
  (void)at(strain, 1e-3);
  law.commit();
  std::srand(7);
  constexpr double kStep = 1e-7;
  for (int sample = 0; sample < 10; ++sample) {
    Vector way = Vector::Random();
    if constexpr (dim == 2) way(k33) = 0.0;
    const auto [response, answer] = at(strain, 2e-4);
    const auto [ahead, answer_ahead] = at(strain + kStep * way, 2e-4);
    const auto [behind, answer_behind] = at(strain - kStep * way, 2e-4);
    EXPECT_LT((response.tangent * way - (ahead.stress - behind.stress) / (2.0 * kStep)).norm(),
              1e-4 * (response.tangent * way).norm());
    EXPECT_NEAR(answer.drive_by_strain.dot(way), (answer_ahead.drive - answer_behind.drive) / (2.0 * kStep),
                1e-4 * answer.drive_by_strain.norm());
    const auto [more, answer_more] = at(strain, 2e-4 + kStep);
    EXPECT_NEAR(answer.drive_by_slip, (answer_more.drive - answer.drive) / kStep,
                1e-5 * std::abs(answer.drive_by_slip));
    EXPECT_LT((answer.stress_by_slip - (more.stress - response.stress) / kStep).norm(),
              1e-5 * answer.stress_by_slip.norm());
  }
  EXPECT_EQ(law.field_names().back(), "drive");
}

TEST(spread_slip, derivatives_of_a_law_known_by_its_answers_are_those_of_differences) {
  check_answers_against_differences<2>();
  check_answers_against_differences<3>();
}

TEST(spread_slip, tangent_is_that_of_differences) {
  const auto material = std::make_shared<SlipDrivenCone<2>>(sand<2>(1.2, 0.6));
  Problem<2> problem = block(material);
  const auto spread = add_spread_slip(problem, {kWidth});
  const FieldPlaces<2> places = problem.places();
  const Discretisation<2> discretisation(problem.mesh, problem.continuum, places.size() - places.mechanics());
  material->allocate(discretisation.points());
  std::vector<Response<2>> responses(discretisation.points());
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(places.size());
  const auto forces = [&](const Eigen::VectorXd& nodal) {
    const NodalStep step{0.0, 1.0, start, nodal};
    spread->prepare(step);
    material->evaluate(discretisation.increments(nodal), responses);
    NodalForces contributed{start, start};
    EXPECT_EQ(spread->evaluate(step, contributed), "");
    return Eigen::VectorXd(discretisation.internal_forces(responses) + contributed.internal);
  };
  (void)forces(start);
  spread->learn(discretisation, responses);
  std::srand(5);
  Eigen::VectorXd nodal = 3e-4 * Eigen::VectorXd::Random(places.size());
  nodal.tail(places.size() - places.start(0)) *= 10.0;  // slips and overstresses, of both signs
  const Eigen::VectorXd way = Eigen::VectorXd::Random(places.size());
  (void)forces(nodal);
  Eigen::VectorXd linear = discretisation.linearised_forces({responses}, way);
  for (std::size_t e = 0; e < spread->elements(); ++e)
    linear(spread->entries(e)) += spread->tangent(e) * Eigen::VectorXd(way(spread->entries(e)));
  const double step = 1e-8;
  const Eigen::VectorXd differences =
      (forces(nodal + step * way) - forces(nodal - step * way)) / (2.0 * step);
  for (const auto& [from, to] : {std::pair{Eigen::Index(0), places.mechanics()},
                                 {places.start(0), places.start(1)},
                                 {places.start(1), places.size()}})
    EXPECT_LT((linear - differences).segment(from, to - from).norm(),
              1e-5 * linear.segment(from, to - from).norm());
}

TEST(spread_slip, tangent_is_symmetric_where_flow_is_associated) {
  ElastoplasticParameters<2> parameters = sand<2>(0.6, 0.6);
  parameters.cone = {0.6, 0.6, PiecewiseLinear::ramp(2e3, 1e3, 0.3)};
  const auto material = std::make_shared<SlipDrivenCone<2>>(parameters);
  Problem<2> problem = block(material);
  const auto spread = add_spread_slip(problem, {kWidth});
  const Discretisation<2> discretisation(problem.mesh, problem.continuum, 0);
  material->allocate(discretisation.points());
  std::vector<Response<2>> responses(discretisation.points());
  std::srand(5);
  const Eigen::VectorXd nodal = 3e-4 * Eigen::VectorXd::Random(problem.places().size());
  const Eigen::VectorXd start = Eigen::VectorXd::Zero(nodal.size());
  const NodalStep step{0.0, 1.0, start, nodal};
  spread->prepare(step);
  material->evaluate(discretisation.increments(nodal), responses);
  spread->learn(discretisation, responses);
  NodalForces contributed{start, start};
  ASSERT_EQ(spread->evaluate(step, contributed), "");
  const Eigen::MatrixXd tangent = spread->tangent(4);
  EXPECT_LT((tangent - tangent.transpose()).norm(), 1e-12 * tangent.norm());
}

TEST(spread_slip, goes_on_from_an_archive_to_the_same_bits) {
  for (Law (*law)(const ElastoplasticParameters<2>&) : {cone, answers_of}) {
    const auto made = [&] { return softening_column(20, kWidth, 0.5 * kHeight, law); };
    Solver<2> through(made(), {});
    ASSERT_TRUE(through.equilibrate().converged);
    for (int step = 1; step <= 10; ++step) ASSERT_TRUE(through.advance(step * 0.8e-3).converged);
    MemoryArchive archive;
    through.save(archive);
    Solver<2> restored(made(), {});
    restored.restore(archive);
    for (Solver<2>* solver : {&through, &restored})
      for (int step = 11; step <= 15; ++step) ASSERT_TRUE(solver->advance(step * 0.8e-3).converged);
    EXPECT_EQ(through.state().displacement, restored.state().displacement);
    EXPECT_EQ(through.state().contributed, restored.state().contributed);
  }
}

TEST(spread_slip, slip_goes_on_neither_in_unloading_nor_in_reloading_below_strength) {
  Solver<2> solver(softening_column(20), {});
  ASSERT_TRUE(solver.equilibrate().converged);
  for (int step = 1; step <= 10; ++step) ASSERT_TRUE(solver.advance(step * 0.8e-3).converged);
  const Eigen::Index first = solver.problem().places().start(0), last = solver.problem().places().start(1);
  const Eigen::VectorXd slips = solver.state().displacement.segment(first, last - first);
  const double stress = solver.reaction("top")(0);
  for (const double displacement : {7.7e-3, 7.9e-3}) {
    ASSERT_TRUE(solver.advance(displacement).converged);
    EXPECT_LT((solver.state().displacement.segment(first, last - first) - slips).norm(), 1e-9 * slips.norm());
  }
  // 0.1 mm short of where it was, over 0.2 m with G = 40 MPa / 2.6.
  EXPECT_NEAR(solver.reaction("top")(0), stress - 0.01 * 0.1e-3 / 0.2 * 40e6 / 2.6, 1e-6 * stress);
}

TEST(spread_slip, faults_are_named) {
  Problem<2> problem = softening_column(20);
  problem.lifetimes["weak"] = {};
  const std::vector<std::string> messages = problem.contributions.front()->faults(problem);
  ASSERT_EQ(messages.size(), 1U);
  EXPECT_NE(messages[0].find("comes or goes"), std::string::npos);
  Problem<2> local =
      block(std::make_shared<LocalMaterial<ElastoplasticLaw<2>>>(ElastoplasticLaw<2>(sand<2>(0.8, 1.2))));
  EXPECT_THROW(add_spread_slip(local, {kWidth}), RunError);
  ElastoplasticParameters<2> others = sand<2>(0.8, 1.2);
  others.weights = {0.375, 0.125, 0.25};
  EXPECT_THROW(SlipDrivenCone<2>{others}, RunError);
}

}  // namespace
}  // namespace polargrain::testing::spread_column
