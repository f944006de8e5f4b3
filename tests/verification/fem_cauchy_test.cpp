// SPDX-License-Identifier: GPL-2.0-or-later
// The classical continuum is the Cosserat continuum without coupling: same displacements, symmetric stress.
#include <gtest/gtest.h>

#include <iostream>

#include "fem/material/elastic.hpp"
#include "fem/material/local_material.hpp"
#include "fem/mesh/rectangle.hpp"
#include "fem/solver/solver.hpp"

using namespace polargrain;
using namespace polargrain::fem;

namespace {

/// A block between rough plates, sheared and pressed: nothing is homogeneous.
std::unique_ptr<Solver<2>> solved_block(const std::string& element, Continuum continuum,
                                        double cosserat_modulus, double internal_length,
                                        double poisson_ratio = 0.3) {
  const TimeTable zero = TimeTable::constant(0.0);
  Problem<2> problem;
  problem.mesh = rectangle({{1.0, 2.0}, {4, 8}}, element);
  problem.continuum = continuum;
  problem.materials["all"] = std::make_shared<LocalMaterial<ElasticLaw<2>>>(ElasticLaw<2>(
      {2 * (1 + poisson_ratio), poisson_ratio, cosserat_modulus, internal_length, Vector7::Zero()}));
  problem.prescribed = {{"bottom", Dof::u1, zero, {}},
                        {"bottom", Dof::u2, zero, {}},
                        {"top", Dof::u1, TimeTable::ramp(0.02), {}},
                        {"top", Dof::u2, TimeTable::ramp(-0.01), {}}};
  auto solver = std::make_unique<Solver<2>>(std::move(problem), SolverOptions{});
  EXPECT_TRUE(solver->equilibrate().converged);
  EXPECT_TRUE(solver->advance(1.0).converged);
  return solver;
}

/// Largest difference of a displacement over the largest displacement.
double difference_of_cauchy(const Solver<2>& one, const Solver<2>& other) {
  double largest = 0.0;
  double scale = 0.0;
  const Eigen::VectorXd& a = one.state().displacement;
  const Eigen::VectorXd& b = other.state().displacement;
  for (Eigen::Index entry = 0; entry < a.size(); ++entry) {
    if (entry % 3 == 2) continue;
    largest = std::max(largest, std::abs(a(entry) - b(entry)));
    scale = std::max(scale, std::abs(a(entry)));
  }
  return largest / scale;
}

class CauchyElement : public ::testing::TestWithParam<std::string> {};

TEST_P(CauchyElement, cauchy_is_cosserat_without_coupling) {
  const auto cauchy = solved_block(GetParam(), Continuum::cauchy, 0.5, 0.2);
  const auto uncoupled = solved_block(GetParam(), Continuum::cosserat, 1e-9, 0.2);
  const auto coupled = solved_block(GetParam(), Continuum::cosserat, 0.5, 0.2);
  std::cout << "[figure] cauchy against Gc = 1e-9 G, " << GetParam() << ": "
            << difference_of_cauchy(*cauchy, *uncoupled) << "; Gc = 0.5 G differs by "
            << difference_of_cauchy(*cauchy, *coupled) << '\n';
  EXPECT_LT(difference_of_cauchy(*cauchy, *uncoupled), 1e-8);  // proportional to Gc
  EXPECT_GT(difference_of_cauchy(*cauchy, *coupled), 1e-4);    // so the comparison can fail
}

TEST_P(CauchyElement, cauchy_stress_is_symmetric_and_knows_no_couples) {
  const auto cauchy = solved_block(GetParam(), Continuum::cauchy, 0.5, 0.2);
  for (const Response<2>& response : cauchy->state().responses) {
    EXPECT_NEAR(response.stress(k12), response.stress(k21), 1e-16);
    EXPECT_EQ(response.stress(kCurvature1), 0.0);
  }
  // No unknown rotations: 2 per node less the given ones.
  EXPECT_EQ(cauchy->state().displacement(2), 0.0);
}

INSTANTIATE_TEST_SUITE_P(Elements, CauchyElement, ::testing::ValuesIn(element_names<2>()));

TEST(mean_dilatation, keeps_q4_from_locking_near_incompressibility) {
  // The work done on a block of nu = 0.4999 against fine Q8R: locking would show as a multiple.
  const double reference = solved_block("Q8R", Continuum::cauchy, 0.5, 0.2, 0.4999)->state().external_work;
  const double q4 = solved_block("Q4", Continuum::cauchy, 0.5, 0.2, 0.4999)->state().external_work;
  std::cout << "[figure] Q4 over Q8R work at nu = 0.4999: " << q4 / reference << '\n';
  EXPECT_NEAR(q4 / reference, 1.0, 0.1);
}

}  // namespace
